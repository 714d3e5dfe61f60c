#include "resources/frame_constants.h"

#include <algorithm>
#include <cmath>

#include "base/vec.h"
#include "io/object_ids.h"
#include "plan/light_pictures.h"
#include "resources/light_constants.h"

namespace wrinkle {

namespace {

static_assert(sizeof(wr_camera) == 76 * sizeof(double) && sizeof(wr_light) == 16 * sizeof(double) &&
                  sizeof(wr_projector) == 32 * sizeof(double) && sizeof(wr_lighting) == 35 * sizeof(double),
              "layout.h: members other than WR_SCALAR, or padding");

void put(double (&to)[3], const Vec3& from) { std::copy(from.begin(), from.end(), to); }

template <std::size_t n>
void put_low(double (&to)[n], const double (&from)[n]) {
    for (std::size_t k = 0; k < n; ++k) to[k] = from[k] - static_cast<double>(static_cast<float>(from[k]));
}

Vec3 scaled(const Vec3& a, double s) { return {a[0] * s, a[1] * s, a[2] * s}; }

/// Screen (x right, y down, pixels; depth as NDC z) to NDC.
Mat4 ndc_from_screen(Size size) {
    Mat4 m{};
    m[0] = {2.0 / size.width, 0, 0, -1};
    m[1] = {0, -2.0 / size.height, 0, 1};
    m[2][2] = m[3][3] = 1;
    return m;
}

Vec3 eye_of(const Mat4& to_world) { return {to_world[0][3], to_world[1][3], to_world[2][3]}; }

}  // namespace

void split_constants(wr_camera& frame) {
    put_low(frame.d0_low, frame.d0), put_low(frame.dx_low, frame.dx), put_low(frame.dy_low, frame.dy);
    put_low(frame.c0_low, frame.c0), put_low(frame.c1_low, frame.c1), put_low(frame.c2_low, frame.c2);
    put_low(frame.c3_low, frame.c3), put_low(frame.w_low, frame.w);
    frame.depth_offset_low = frame.depth_offset - static_cast<float>(frame.depth_offset);
}

wr_camera camera_constants(const Camera& camera, Size size) {
    const Mat4 to_world = inverse(camera.view);
    const Vec3 eye = eye_of(to_world);
    wr_camera frame{};
    frame.width = size.width;
    frame.height = size.height;
    for (std::size_t k = 0; k < 3; ++k) {
        frame.eye_high[k] = static_cast<float>(eye[k]);
        frame.eye_low[k] = eye[k] - frame.eye_high[k];
        frame.forward[k] = -to_world[k][2];
    }
    put(frame.forward, normalize({frame.forward[0], frame.forward[1], frame.forward[2]}));
    if (const auto rays = pinhole_rays(camera, size)) {
        put(frame.d0, rays->d0);
        put(frame.dx, rays->dx);
        put(frame.dy, rays->dy);
        put(frame.dx_cross_d0, cross(rays->dx, rays->d0));
        put(frame.dx_cross_dy, cross(rays->dx, rays->dy));
        put(frame.dy_cross_d0, cross(rays->dy, rays->d0));
        put(frame.dy_cross_dx, cross(rays->dy, rays->dx));
        frame.depth_scale = camera.proj[2][3], frame.depth_offset = camera.proj[2][2];
    }
    const Mat4 inverse_vps = multiply(inverse(multiply(camera.proj, camera.view)), ndc_from_screen(size));
    double(*const columns[])[3] = {&frame.c0, &frame.c1, &frame.c2, &frame.c3};
    for (std::size_t i = 0; i < 4; ++i) {
        frame.w[i] = inverse_vps[3][i];
        for (std::size_t k = 0; k < 3; ++k) (*columns[i])[k] = inverse_vps[k][i] - eye[k] * frame.w[i];
    }
    // The rays of a parallel projection have no eye, but one direction: `forward`, which leads from one view depth to
    // that 1 deeper. In a sheared projection it is not parallel to the camera's axis. Pixel (x, y) shows the point
    // d0 + x dx + y dy at view depth 0.
    if (frame.w[0] == 0 && frame.w[1] == 0 && frame.w[2] == 0) {
        const Vec3 axis{frame.forward[0], frame.forward[1], frame.forward[2]},
            ray{frame.c2[0], frame.c2[1], frame.c2[2]};
        const Vec3 forward = scaled(ray, 1 / dot(ray, axis));
        put(frame.forward, forward);
        const auto flat = [&](const double(&c)[3]) {
            const Vec3 v = scaled({c[0], c[1], c[2]}, 1 / frame.w[3]);
            return subtract(v, scaled(forward, dot(v, axis)));
        };
        put(frame.d0, flat(frame.c3));
        put(frame.dx, flat(frame.c0));
        put(frame.dy, flat(frame.c1));
        frame.depth_scale = -camera.proj[3][3] / camera.proj[2][2];
        frame.depth_offset = -camera.proj[2][3] / camera.proj[3][3];
    }
    split_constants(frame);
    return frame;
}

wr_projector projector_constants(const Projector& row, const ProjectedImage& image, double scale, const Vec3& eye) {
    wr_projector out{};
    put(out.center, subtract(row.center, eye));
    // Below this a half size has no reciprocal in float: such a decal covers no pixel, so it contributes nothing.
    constexpr double kLeast = 1e-36;
    if (!(std::min({row.half_size[0], row.half_size[1], row.half_size[2]}) > kLeast)) return out;
    const Vec3 x = normalize(row.axis_x);
    const Vec3 y = normalize(subtract(row.axis_y, scaled(x, dot(x, row.axis_y))));
    put(out.to_box_x, scaled(x, 1 / row.half_size[0]));
    put(out.to_box_y, scaled(y, 1 / row.half_size[1]));
    put(out.to_box_z, scaled(cross(x, y), 1 / row.half_size[2]));
    scale *= row.scale;
    for (std::size_t k = 0; k < 2; ++k) {
        const double repeat = row.wrap == Wrap::repeat ? row.repeat[k] : 1;
        out.repeat[k] = repeat;
        out.strength[k] = image.height ? scale / 2 * repeat : scale * row.half_size[k];
    }
    for (std::size_t k = 0; k < 3; ++k) out.falloff[k] = row.falloff[k] > 0 ? 1 / row.falloff[k] : 0;
    const double slope = 1 / std::max(row.angle_fade[1] - row.angle_fade[0], 1e-6);  // equal angles: as good as a step
    out.fade_slope = slope * row.half_size[2];
    out.fade_zero = slope * row.angle_fade[0];
    out.two_sided = row.two_sided ? 1 : 0;
    out.shape = static_cast<double>(row.shape);
    out.per_size = row.shape == ProjectorShape::cone && image.height ? 1 : 0;
    out.texture = image.texture;
    out.tile = row.wrap == Wrap::repeat ? 1 : 0;
    out.opacity = row.opacity;
    out.replace = row.mode == ProjectorMode::replace ? 1 : 0;
    return out;
}

/// Row `index` of a planned table, with its mask.
wr_projector masked_projector(const PlannedDecals& table, std::size_t index, double scale, const Vec3& eye) {
    const Projector& row = (*table.rows)[index];
    wr_projector out = projector_constants(row, table.images[index], scale, eye);
    if (row.object) {
        out.mask = 1;
        out.object = io::object_label(*row.object);
    }
    if (!row.cryptomatte.empty()) {
        out.mask = 2;
        out.object = table.hashes[index] >> 16;
        out.object_low = table.hashes[index] & 0xffff;
    }
    return out;
}

FrameConstants frame_constants(const Plan& plan, const NumberSource& source, const Camera& camera, Size size) {
    const Vec3 eye = eye_of(inverse(camera.view));
    const std::vector<Layer>& layers = source.scene.layers;
    FrameConstants out;
    out.frame = camera_constants(camera, size);
    for (const PlannedNumbers& planned : plan.numbers)
        for (const double value : numbers_of(planned, source)) out.numbers.push_back(value);
    for (const PlannedEyePlace& planned : plan.eye_places) {
        const EyePlace origin = planned(source);
        const auto add = [&](double value) {
            out.eye_places.push_back(origin.low ? value - static_cast<float>(value) : value);
        };
        for (std::size_t k = 0; k < 3; ++k) {
            double value = dot(origin.axes[k], eye) + origin.offset[k];
            if (const double period = origin.period[k]; period > 0) value -= period * std::floor(value / period);
            add(value);
        }
        add(origin.fourth);
    }
    for (const PlannedDecal& decal : plan.decals) {
        const Layer& layer = layers.at(decal.layer);
        out.decals.push_back(projector_constants(decal.row(layer), decal.image, signed_scale(layer), eye));
    }
    for (const PlannedDecals& table : plan.tables)
        for (const std::uint32_t row : table.order)
            out.projectors.push_back(masked_projector(table, row, signed_scale(layers.at(table.layer)), eye));
    const Lighting& lighting = source.scene.lighting;
    const std::vector<std::string> pictures = pictures_of(lighting);
    std::copy(lighting.ambient.begin(), lighting.ambient.end(), out.lighting.sky);
    const std::vector<std::size_t> apart = lights_read_apart(lighting, plan.specular_apart);
    const std::size_t shared = pictures.size() + (plan.specular_apart ? 1 : 0);
    for (std::size_t i = 0; i < lighting.lights.size(); ++i) {
        const Light& light = lighting.lights[i];
        if (light.kind == LightKind::sky) {
            add_sky(out.lighting.sky, light);
            continue;
        }
        out.lights.push_back(fill_light(light, eye));
        const auto place = std::ranges::find(apart, i);
        const std::size_t none =
            place == apart.end() ? 0 : shared + 1 + static_cast<std::size_t>(place - apart.begin());
        const LightPictures numbers = picture_numbers(pictures, light, plan.specular_apart, none);
        out.lights.back().diffuse = static_cast<double>(numbers.diffuse);
        out.lights.back().specular = static_cast<double>(numbers.specular);
    }
    if (plan.light_order) {
        out.light_table.reserve(plan.light_order->size());
        for (const std::uint32_t row : *plan.light_order)
            out.light_table.push_back(fill_light(lighting.table->at(row), eye));
    }
    // Without a sky in the scene, the light in shadows is unknown. A pixel of the picture that shows less than half of
    // what the lights would give then counts as in full shadow.
    const bool dark = std::ranges::all_of(out.lighting.sky, [](double k) { return k == 0; });
    out.lighting.shadow = dark ? 0.5 : 0;
    // All that no light explains is then taken to come from all around; wr_faint_light tells how bright that is.
    if (dark && lighting.relight == Relight::ratio) std::fill_n(out.lighting.sky, 3, 1.0);
    put(out.lighting.albedo, lighting.albedo);
    out.lighting.roughness = lighting.roughness;
    out.lighting.f0 = lighting.f0;
    out.lighting.max_ratio = lighting.max_ratio;
    out.lighting.lights = static_cast<double>(out.lights.size());
    return out;
}

}  // namespace wrinkle
