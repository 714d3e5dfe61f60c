#include <fmt/format.h>

#include "io/volume.h"
#include "io/volume_file.h"
#include "layers/common.h"
#include "wrinkle/error.h"

namespace wrinkle {

namespace {

constexpr double kLinear = 90, kSmooth = 330, kVector = 110;  // expected operations

const Mat4 kIdentity{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}}};

void read(scene::Table& table, Layer& layer) {
    auto bump = scene::held<VolumeLayer>(layer);
    table.require("volume");
    table.read_file("volume", bump.file);
    table.read("grid", bump.grid);
    table.choose("filter", bump.filter, {{"linear", VolumeFilter::linear}, {"smooth", VolumeFilter::smooth}});
    table.choose("remap", bump.remap,
                 {{"none", Remap::none}, {"ramp", Remap::ramp}, {"smooth", Remap::smooth}, {"wave", Remap::wave}});
    table.read("range", bump.range);
    if (static_cast<float>(bump.range[0]) == static_cast<float>(bump.range[1]))
        table.complain("range", "must be two different numbers");
    table.only_with("range", bump.remap != Remap::none, "remap", "ramp\", \"smooth\" or \"wave");
    table.compiled_in("transform", bump.transform != kIdentity);
    if (table.read_matrix("transform", bump.transform)) {
        const auto& last = bump.transform[3];
        if (last[0] != 0 || last[1] != 0 || last[2] != 0 || last[3] != 1)
            table.complain("transform", "must be affine: its last row is [0, 0, 0, 1]");
        else if (is_singular(bump.transform))
            table.complain("transform", "cannot be inverted: its columns are zero or parallel");
    }
    scene::read_weight(table, layer);
    layer.bump = bump;
}

void look(const Layer& layer, Available& available) {
    const auto& volume = std::get<VolumeLayer>(layer.bump);
    try {
        const VolumeInfo info = volume_info(volume.file, volume.grid);
        available.volumes[{volume.file.string(), volume.grid}] = {info.channels == 3, info.index_from_world};
    } catch (const Error& error) { throw Error(fmt::format("{}: {}", layer_label(layer), error.what())); }
}

/// World to the grid's index space: the file's transform, then the layer's.
Mat4 index_from_world(const Mat4& file, const Layer& layer) {
    return multiply(file, inverse(std::get<VolumeLayer>(layer.bump).transform));
}

/// Kernel text of the 3 x 3 part of that matrix, or of its transpose, times a vector. Where neither the grid nor the
/// layer rotates, products with zeros are left out.
class IndexMatrix {
public:
    IndexMatrix(LayerText& at, const Mat4& file) {
        along_axes_ = std::get<VolumeLayer>(at.layer.bump).transform == kIdentity;
        for (std::size_t i = 0; i < 3; ++i)
            for (std::size_t j = 0; j < 3; ++j) along_axes_ &= i == j || file[i][j] == 0;
        first_ = at.emitter.numbers(at.layer, "transform", [file](const Layer& layer, const auto&) {
            const Mat4 m = index_from_world(file, layer);
            std::vector<double> numbers;
            for (std::size_t i = 0; i < 3; ++i) numbers.insert(numbers.end(), m[i].begin(), m[i].begin() + 3);
            return numbers;
        });
    }

    std::string times(const std::string& v, bool transposed, const std::string& rest = {}) const {
        std::string parts[3];
        for (std::size_t i = 0; i < 3; ++i) {
            parts[i] = rest.empty() ? "" : fmt::format("{}.{}", rest, "xyz"[i]);
            for (std::size_t k = 0; k < 3; ++k) {
                if (along_axes_ && i != k) continue;
                const std::string factor =
                    fmt::format("(wr_real)(numbers[{}])", first_ + (transposed ? 3 * k + i : 3 * i + k));
                parts[i] = parts[i].empty() ? fmt::format("{}.{} * {}", v, "xyz"[k], factor)
                                            : fmt::format("fma({}.{}, {}, {})", v, "xyz"[k], factor, parts[i]);
            }
        }
        return fmt::format("wr_v3({},\n            {},\n            {})", parts[0], parts[1], parts[2]);
    }

private:
    bool along_axes_ = true;
    std::size_t first_ = 0;
};

/// Text that declares the volume `v`, and `lod` where samples are filtered.
std::string volume_text(LayerText& at, const IndexMatrix& matrix, bool smooth) {
    const bool filtered = at.layer.footprint;
    const std::size_t number =
        at.emitter.volume(std::get<VolumeLayer>(at.layer.bump), smooth ? TexelKind::volume_smooth : TexelKind::volume);
    PlannedTexture& planned = at.emitter.plan.textures[number];  // other layers may want it otherwise
    planned.levels |= filtered, planned.products |= filtered && at.tells_spread();
    const std::string declared = fmt::format("        wr_volume v = wr_volume_at(texels, textures, {});\n", number);
    if (!filtered) return declared;
    at.section.reads.insert({"dp_dx", "dp_dy"});
    at.section.operations += 30;
    if (at.over_area()) at.prepared += declared;
    // One point a pixel is the centre of its area, sampled as if areas were not walked at all.
    const bool several = at.over_area() && at.emitter.scene.filter.taps > 1;
    const std::string level =
        fmt::format("{}(v, {},\n            {})", several ? "wr_volume_area_lod" : "wr_volume_lod",
                    matrix.times("dp_dx", false), matrix.times("dp_dy", false));
    return declared + fmt::format("        const wr_real lod = {};\n", at.once("wr_real", "lod", level));
}

/// Text that adds what a filtered sample has averaged away to the covariance.
///   cells         how far the first cell of slopes lies from the voxel of that number
///   slope         factor of the layer's slopes, beside mask and scale
///   right, down   axes of the covariance, for slopes as they are sampled
std::string spread_text(LayerText& at, const char* cells, const char* slope, const std::string& right,
                        const std::string& down) {
    if (!at.layer.footprint || !at.tells_spread()) return {};
    at.section.operations += 90;
    return fmt::format(
        "        if (wr_any(lod > 0)) {{\n"
        "        wr_real steep = m * {}{};\n"
        "        wr_vec3 lost = wr_volume_spread(v, textures, fine, mean,\n"
        "            wr_sub(q, wr_v3({}, {}, {})), lod,\n"
        "            {},\n            {});\n"
        "        finer = wr_fma(lost, steep * steep, finer);\n"
        "        }}\n",
        at.strength(), slope, cells, cells, cells, right, down);
}

constexpr const char *kBetweenVoxels = "(wr_real)(WR_R(0.5))", *kAroundVoxels = "(wr_real)(0)";

/// Text that remaps `s`, and declares `steepness`, what that multiplies gradients by.
std::string remap_text(LayerText& at, Remap remap) {
    const std::size_t range = at.emitter.numbers(at.layer, "range", [](const Layer& layer, const auto&) {
        const auto& range = std::get<VolumeLayer>(layer.bump).range;
        return std::vector(range.begin(), range.end());
    });
    const char* shape = remap == Remap::ramp ? "ramp" : remap == Remap::smooth ? "smoothstep" : "wave";
    const auto applied = fmt::format("wr_shape_{}(s, numbers[{}], numbers[{}])", shape, range, range + 1);
    return fmt::format(
        "        s.gradient = wr_v3((wr_real)(1), (wr_real)(0), (wr_real)(0));\n"
        "        wr_real steepness = {}.gradient.x;\n"
        "        s.gradient = wr_scale(mean, steepness);\n",
        applied);
}

std::string emit(LayerText& at) {
    const auto& l = std::get<VolumeLayer>(at.layer.bump);
    const auto facts = at.emitter.available.volumes.find({l.file.string(), l.grid});
    if (facts == at.emitter.available.volumes.end())
        throw Error(fmt::format("{}: nothing is known of the volume {}", at.who, l.file.string()));
    const bool vectors = facts->second.vectors, smooth = l.filter == VolumeFilter::smooth;
    if (vectors && (smooth || l.remap != Remap::none))
        throw Error(
            fmt::format("{}: {} holds vectors, which are the gradient as they are; \"filter\" and \"remap\" are "
                        "for grids of values",
                        at.who, l.file.string()));
    const Mat4 file = facts->second.index_from_world;
    const IndexMatrix matrix(at, file);
    const std::size_t origin = at.emitter.eye_place(at.layer, [file](const Layer& layer) {
        const Mat4 m = index_from_world(file, layer);
        return EyePlace{
            .axes = {Vec3{m[0][0], m[0][1], m[0][2]}, Vec3{m[1][0], m[1][1], m[1][2]}, Vec3{m[2][0], m[2][1], m[2][2]}},
            .offset = {m[0][3], m[1][3], m[2][3]}};
    });
    at.section.reads.insert("p");
    at.section.operations += vectors ? kVector : smooth ? kSmooth : kLinear;
    std::string text = volume_text(at, matrix, smooth) +
                       fmt::format(
                           "        wr_vec3 start = wr_v3(eye_places + {});  // the eye, in the grid's index space\n"
                           "        wr_vec3 q = {};\n",
                           4 * origin, matrix.times("p", false, "start"));
    const bool filtered = at.layer.footprint;
    const char* where = filtered ? "if (wr_any(lod < 1)) " : "";
    if (vectors) {
        text += fmt::format(
            "        wr_vec3 fine = wr_zero3();\n        {}fine = wr_volume_vector(v, q);\n        wr_vec3 mean = "
            "fine;\n",
            where);
        if (filtered)
            text += "        if (wr_any(lod > 0)) mean = wr_volume_filtered_vector(v, textures, fine, q, lod);\n";
        return text + at.volume("mean") + spread_text(at, kBetweenVoxels, "", "right", "down");
    }
    text += fmt::format("        wr_field s = {{(wr_real)(0), wr_zero3()}};\n        {}s = {}(v, q);\n", where,
                        smooth ? "wr_volume_bspline" : "wr_volume_trilinear");
    if (filtered)
        text += std::string("        wr_vec3 fine = s.gradient;\n") +
                (smooth ? "        if (wr_any(lod > 0)) s = wr_volume_filtered_bspline(v, textures, s, q, lod);\n"
                        : "        if (wr_any(lod > 0)) s = wr_volume_filtered_trilinear(v, textures, s, q, lod);\n");
    const bool remapped = l.remap != Remap::none;
    text += "        wr_vec3 mean = s.gradient;\n" + (remapped ? remap_text(at, l.remap) : "");
    return text + at.volume(matrix.times("s.gradient", true)) +
           spread_text(at, smooth ? kAroundVoxels : kBetweenVoxels, remapped ? " * steepness" : "",
                       matrix.times("right", false), matrix.times("down", false));
}

}  // namespace

const LayerKind& layers::volume() {
    static constexpr LayerKind row{.name = VolumeLayer::kind, .read = read, .emit = emit, .look = look};
    return row;
}

}  // namespace wrinkle
