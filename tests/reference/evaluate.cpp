#include "tests/reference/evaluate.h"

#include "tests/reference/blend.h"
#include "tests/reference/metal.h"
#include "tests/reference/relit.h"
#include "tests/reference/volume_gradient.h"

namespace wrinkle::reference {
namespace {

Combine combine_of(const Layer& layer) {
    const auto* map = std::get_if<NormalMapLayer>(&layer.bump);
    return map ? map->combine : Combine::surface_gradient;
}

Blending blending(Combine combine) {
    return combine == Combine::whiteout ? Blending::whiteout
           : combine == Combine::udn    ? Blending::udn
           : combine == Combine::rnm    ? Blending::rnm
                                        : Blending::linear;
}

bool reads_uv_plane(const Layer& layer) {
    const auto reads = [](const auto& bump) {
        if constexpr (requires { bump.uv.has_value(); })
            return bump.uv && bump.uv->source == UvSource::aov;
        else if constexpr (requires { bump.uv; })
            return bump.uv.source == UvSource::aov;
        else
            return false;
    };
    return std::visit(reads, layer.bump) || (layer.mask.texture && layer.mask.texture->uv.source == UvSource::aov);
}

}  // namespace

template <class T>
SceneEvaluator<T>::SceneEvaluator(const Scene& scene, Size size, const Camera& camera, Planes planes,
                                  const Images& images)
    : scene_(scene), frame_(scene.gbuffer, size, camera, std::move(planes)) {
    SceneTextures<T> textures(images);
    for (const Layer& layer : scene.layers) {
        const auto make = [&](const auto& bump) { return make_layer<T>(bump, layer.footprint, textures); };
        const T sign = layer.blend == Blend::subtract ? T(-1) : T(1);
        const auto shift = [&](const auto& bump) { return make_shift<T>(bump, layer.footprint, textures); };
        const auto* parallax = std::get_if<ParallaxLayer>(&layer.bump);
        layers_.push_back({std::visit(make, layer.bump), std::visit(shift, layer.bump), parallax && parallax->curved,
                           sign * T(layer.scale), SceneMask<T>(layer.mask, layer.footprint, frame_, textures),
                           layer.project, combine_of(layer)});
        uses_uv_ = uses_uv_ || reads_uv_plane(layer);
        if (const auto* map = std::get_if<NormalMapLayer>(&layer.bump))
            uses_vertex_ = uses_vertex_ || uses_vertex_frame(*map, frame_.has_vertex_frame());
    }
}

template <class T>
Evaluated<T> SceneEvaluator<T>::evaluate(std::size_t i) const {
    Evaluated<T> out;
    const Decoded<T> here = frame_.decode(i);
    if (!here.valid) {
        const Vec<T> raw = frame_.raw_normal(i);
        if (finite(raw)) out.normal = raw;
        out.marked = Marked::invalid;
        return out;
    }
    out.valid = true;
    out.position = here.position;
    out.view = here.view;
    out.base_normal = here.normal;
    out.base = out.last = frame_.derivative(i, here.position, here.normal);
    if (here.reflected) out.marked |= Marked::back_facing;

    Surfel<T> s{here.position + frame_.rays().eye(), here.normal, out.base, {}, {}, false, {}, {}};
    if (frame_.has("object")) s.object = frame_.plane("object")[i];
    if (frame_.has("crypto.id0")) s.front = frame_.front(i);
    s.coverage = [&](const std::string& name) { return frame_.coverage(i, name); };
    s.height_slope = [&](const std::string& name) { return frame_.height_slope(i, here, out.base, name); };
    s.vector = [&](const std::array<std::string, 3>& names) -> std::optional<Vec<T>> {
        const Vec<T> v{T(frame_.plane(names[0])[i]), T(frame_.plane(names[1])[i]), T(frame_.plane(names[2])[i])};
        return finite(v) ? std::optional(v) : std::nullopt;
    };
    if (uses_uv_) {
        if (const auto d = frame_.uv_derivative(i, here, out.base)) s.uv = TexCoord<T>{frame_.uv(i), *d};
        if (!s.uv) out.marked |= Marked::no_uv_derivative;
    }
    if (uses_vertex_) {
        s.vertex_planes = true;
        s.vertex = frame_.vertex_frame(i);
        if (!s.vertex) out.marked |= Marked::no_uv_derivative;
    }
    Vec<T> surface, volume;
    const auto finish = [&] {
        out.surface_gradient = surface + surface_gradient_from_volume(s.normal, volume);
        out.normal = resolve(s.normal, out.surface_gradient);
    };
    for (const Entry& layer : layers_) {
        if (!layer.function) {  // a resolve
            finish();
            out.stage_reflected = out.stage_reflected || dot(out.normal, here.view) < 0;
            s.normal = face_viewer(out.normal, here.view);
            s.d = out.last = frame_.derivative(i, out.position, s.normal);
            surface = volume = {};
            continue;
        }
        const std::optional<T> mask = layer.mask.at(i, s);
        if (!mask || *mask == 0) continue;
        if (layer.shift) move(i, layer, layer.scale * *mask, s, out);
        const Contribution<T> c = layer.function(s);
        if (c.marks) out.marked |= Marked::no_uv_derivative;
        if (c.axis) {
            const Vec<T> below = surface + surface_gradient_from_volume(s.normal, volume);
            const Vec<T> other = normalize(*c.axis - c.volume * layer.scale);
            surface = surface + combine_towards(s.normal, below, other, c.share * *mask) - below;
            continue;
        }
        if (layer.combine != Combine::surface_gradient && c.usable) {
            const Vec<T> below = surface + surface_gradient_from_volume(s.normal, volume);
            const Vec<T> both = combine_gradients(blending(layer.combine), s.normal, below, c.surface * layer.scale);
            surface = surface + (both - below) * *mask;
            continue;
        }
        surface = surface + c.surface * (layer.scale * *mask);
        Vec<T>& space = layer.project ? volume : surface;
        space = space + c.volume * (layer.scale * *mask);
    }
    finish();
    return out;
}

/// Lights whose shadows are read each apart: two or three without a picture of what is diffuse; none where what is
/// specular of another has no picture. `specular`: the frame tells what is specular.
std::vector<Light> read_apart(const Lighting& lighting, bool specular) {
    std::vector<Light> apart = lighting.lights;
    std::erase_if(apart,
                  [](const Light& l) { return l.kind == LightKind::sky || !l.picture.empty() || !l.diffuse.empty(); });
    const bool table = lighting.table && !lighting.table->empty();
    const bool half = !specular && std::ranges::any_of(lighting.lights, [](const Light& l) {
        return l.kind != LightKind::sky && l.picture.empty() && !l.diffuse.empty() && l.specular.empty();
    });
    if (lighting.shadows != Shadows::read || table || half || apart.size() < 2 || apart.size() > 3) apart.clear();
    return apart;
}

/// Metal whose object has a picture, times the ratio of what that shows of the bumped direction and of the other.
template <class T>
Vec<T> SceneEvaluator<T>::relit_metal(std::size_t i, const Evaluated<T>& e, Vec<T> beauty) const {
    const Lighting& lighting = scene_.lighting;
    const double object = frame_.has("object") ? frame_.plane("object")[i] : 0;
    for (std::size_t k = 0; lighting.metals && k < lighting.metals->size(); ++k) {
        const MetalPicture& picture = (*lighting.metals)[k];
        if (picture.object != object) continue;
        const Vec<T> now = mirrored_by_metal(picture, e.normal, e.base_normal, e.view),
                     old = mirrored_by_metal(picture, e.base_normal, e.base_normal, e.view);
        const auto times = [&](T Vec<T>::*c) {
            return beauty.*c * relight_ratio(now.*c, old.*c, T(lighting.max_ratio));
        };
        return {times(&Vec<T>::x), times(&Vec<T>::y), times(&Vec<T>::z)};
    }
    return beauty;
}

template <class T>
Vec<T> SceneEvaluator<T>::relit(std::size_t i, const Evaluated<T>& e) const {
    const Lighting& lighting = scene_.lighting;
    const bool ratio = lighting.relight == Relight::ratio;
    const Vec<T> beauty = ratio ? rgb("beauty", i) : Vec<T>{};
    if (lighting.relight == Relight::off || !e.valid) return beauty;
    Surface<T> surface{from_array<T>(lighting.albedo), T(lighting.roughness), T(lighting.f0)};
    if (frame_.has("albedo.r")) surface.albedo = rgb("albedo", i);
    if (frame_.has("roughness")) surface.roughness = frame_.plane("roughness")[i];
    const Vec<T> world = e.position + frame_.rays().eye();
    if (!ratio) return lit(lighting, e.normal, e.base_normal, e.view, world, surface);
    using Part = typename Relit<T>::Part;
    using Shows = typename Relit<T>::Shows;
    const auto shows = [&](const std::string& picture) {
        const auto any = [&](const std::string Light::*lobe) {
            return std::ranges::any_of(lighting.lights, [&](const Light& l) { return l.*lobe == picture; });
        };
        return any(&Light::picture) ? Shows::both : any(&Light::specular) ? Shows::specular : Shows::diffuse;
    };
    const auto facing_of = [&](const std::string& picture) {
        Vec<T> sum;
        for (const Light& l : lighting.lights)
            if (l.picture == picture || l.diffuse == picture || l.specular == picture) sum = sum + facing(l, world);
        return sum.x + sum.y + sum.z;
    };
    const auto part = [&](const std::string& picture) {
        return Part{picture.empty() ? Vec<T>{} : rgb("channel:" + picture, i, "RGB"),
                    lit_by(picture, lighting, e.normal, e.base_normal, e.view, world, surface),
                    lit_by(picture, lighting, e.base_normal, e.base_normal, e.view, world, surface),
                    picture.empty() ? Shows::both : shows(picture), facing_of(picture)};
    };
    const Lighting around = with_faint_light(lighting, world);
    Relit<T> relit{beauty,
                   {},
                   part(""),
                   {{}, sky_light(around, e.normal, e.base_normal), sky_light(around, e.base_normal, e.base_normal)}};
    for (const std::string& picture : pictures(lighting))
        if (!picture.empty()) relit.own.push_back(part(picture));
    if (const auto mirrored = specular(i)) {
        const auto now = lobes_by({}, lighting, e.normal, e.base_normal, e.view, world, surface);
        const auto old = lobes_by({}, lighting, e.base_normal, e.base_normal, e.view, world, surface);
        relit.others.now = now.diffuse, relit.others.old = old.diffuse;
        relit.mirrored = Part{*mirrored, now.specular, old.specular};
    }
    for (const Light& light : read_apart(lighting, relit.mirrored.has_value())) {
        Lighting one = lighting;
        one.lights = {light};
        const auto lobes = [&](const Vec<T>& n) {
            const Lobes<T> both = lobes_by({}, one, n, e.base_normal, e.view, world, surface);
            return relit.mirrored ? both.diffuse : both.diffuse + both.specular;
        };
        relit.alone.push_back({{}, lobes(e.normal), lobes(e.base_normal)});
    }
    const Vec<T> picture = relit.picture(lighting, surface.albedo);
    const Vec<T> a = surface.albedo;
    T metal = frame_.has("albedo.r") && std::max({a.x, a.y, a.z}) <= T(1) / 1000 ? T(1) : T(0);
    if (frame_.has("metallic")) metal = std::clamp(T(frame_.plane("metallic")[i]), T(0), T(1));
    return picture * (1 - metal) + relit_metal(i, e, beauty) * metal;
}

template <class T>
void SceneEvaluator<T>::move(std::size_t i, const Entry& layer, T depth, Surfel<T>& s, Evaluated<T>& out) const {
    const bool parallel = frame_.rays().parallel();
    const T distance = parallel ? std::numeric_limits<T>::infinity() : length(out.position);
    const T nearer = layer.shift(s, out.view, distance, depth);
    const Vec<T> normal = s.normal;
    if (layer.curved && nearer != 0) {
        const ScreenDerivative<T> turning = frame_.normal_derivative(i, frame_.decode(i), out.base);
        if (const auto pixels = screen_vector(s.normal, s.d.dp_dx, s.d.dp_dy, out.view * nearer))
            s.normal = parallax_normal(s.normal, turning.dp_dx, turning.dp_dy, *pixels, out.view);
    }
    out.position = out.position + out.view * nearer;
    s.position = out.position + frame_.rays().eye();
    const ScreenDerivative<T> before = s.d;
    s.d = out.last = frame_.derivative(i, out.position, s.normal);
    if (!s.uv) return;
    const TexDerivative<T> d = s.uv->d;
    const auto step = [&](Vec<T> dp) { return project_to_texture(normal, before.dp_dx, before.dp_dy, d, dp, false); };
    *s.uv = {s.uv->st + step(out.view) * nearer, {step(s.d.dp_dx), step(s.d.dp_dy)}};
}

template <class T>
std::optional<Vec<T>> SceneEvaluator<T>::specular(std::size_t i) const {
    if (frame_.has("specular.r")) return rgb("specular", i);
    if (!frame_.has("specular_direct.r")) return {};
    const Vec<T> light = rgb("specular_direct", i) + rgb("specular_indirect", i), color = rgb("specular_color", i);
    return Vec<T>{light.x * color.x, light.y * color.y, light.z * color.z};
}

template <class T>
Vec<T> SceneEvaluator<T>::rgb(const std::string& layer, std::size_t i, const char* names) const {
    const auto plane = [&](int k) { return T(frame_.plane(layer + "." + names[k])[i]); };
    return {plane(0), plane(1), plane(2)};
}

template class SceneEvaluator<double>;

}  // namespace wrinkle::reference
