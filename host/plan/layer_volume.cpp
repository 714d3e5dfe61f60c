#include <fmt/format.h>

#include "plan/layer_text.h"
#include "wrinkle/error.h"

namespace wrinkle {

namespace {

constexpr double kLinear = 90, kSmooth = 330, kVector = 110;  // expected operations

/// a v.x + b v.y + c v.z + rest, without what is zero.
std::string linear(const std::string& v, const std::array<double, 3>& factors, const std::string& rest) {
    std::string text = rest;
    for (std::size_t k = 0; k < 3; ++k)
        if (factors[k] != 0) {
            const std::string part = fmt::format("{}.{}", v, "xyz"[k]),
                              factor = "(wr_real)(" + literal(factors[k]) + ")";
            text = text.empty() ? fmt::format("{} * {}", part, factor)
                                : fmt::format("fma({}, {}, {})", part, factor, text);
        }
    return text.empty() ? "(wr_real)(0)" : text;
}

/// matrix v + rest; columns instead of rows when `transposed`.
std::string transformed(const Mat4& m, const std::string& v, bool transposed, const std::string& rest = {}) {
    std::string parts[3];
    for (std::size_t i = 0; i < 3; ++i) {
        const std::array factors =
            transposed ? std::array{m[0][i], m[1][i], m[2][i]} : std::array{m[i][0], m[i][1], m[i][2]};
        parts[i] = linear(v, factors, rest.empty() ? "" : fmt::format("{}.{}", rest, "xyz"[i]));
    }
    return fmt::format("wr_v3({},\n            {},\n            {})", parts[0], parts[1], parts[2]);
}

}  // namespace

std::string emit(LayerText& at, const VolumeLayer& l) {
    const auto facts = at.emitter.available.volumes.find({l.file.string(), l.grid});
    if (facts == at.emitter.available.volumes.end())
        throw Error(fmt::format("{}: nothing is known of the volume {}", at.who, l.file.string()));
    const bool vectors = facts->second.vectors, smooth = l.filter == VolumeFilter::smooth;
    if (vectors && (smooth || l.remap != Remap::none))
        throw Error(
            fmt::format("{}: {} holds vectors, which are the gradient as they are; \"filter\" and \"remap\" are "
                        "for grids of values",
                        at.who, l.file.string()));
    const Mat4 m = multiply(facts->second.index_from_world, inverse(l.transform));
    const std::size_t origin = at.emitter.origin(
        {.axes = {Vec3{m[0][0], m[0][1], m[0][2]}, Vec3{m[1][0], m[1][1], m[1][2]}, Vec3{m[2][0], m[2][1], m[2][2]}},
         .offset = {m[0][3], m[1][3], m[2][3]}});
    at.section.reads.insert("p");
    at.section.operations += vectors ? kVector : smooth ? kSmooth : kLinear;
    std::string text = fmt::format(
        "        wr_volume v = wr_volume_at(texels, textures, {});\n"
        "        wr_vec3 start = wr_v3(origins + {});  // the eye, in the grid's index space\n"
        "        wr_vec3 q = {};\n",
        at.emitter.volume(l, smooth ? TexelKind::volume_smooth : TexelKind::volume), 4 * origin,
        transformed(m, "p", false, "start"));
    if (vectors) return text + at.volume("wr_volume_vector(v, q)");
    text += fmt::format("        wr_field s = {}(v, q);\n", smooth ? "wr_volume_bspline" : "wr_volume_trilinear");
    if (l.remap != Remap::none)
        text += fmt::format("        s = wr_shape_{}(s, {}, {});\n",
                            l.remap == Remap::ramp     ? "ramp"
                            : l.remap == Remap::smooth ? "smoothstep"
                                                       : "wave",
                            literal(l.range[0]), literal(l.range[1]));
    return text + at.volume(transformed(m, "s.gradient", true));
}

}  // namespace wrinkle
