#include <fmt/format.h>

#include "plan/layer_text.h"

namespace wrinkle {

namespace {
constexpr double kTriplanar = 40;  // expected operations
}

std::string emit(LayerText& at, const TriplanarLayer& l) {
    const double per_metre = 1 / l.tile;
    const std::size_t origin = at.emitter.origin(
        {.axes = {Vec3{per_metre, 0, 0}, Vec3{0, per_metre, 0}, Vec3{0, 0, per_metre}}, .offset = {}, .period = 1});
    at.section.reads.insert({"p", "n", "dp_dx", "dp_dy"});
    at.section.operations += kTriplanar + 3 * sample_cost(l.texture);
    std::string text = fmt::format(
        "        wr_texture t = wr_texture_at(texels, textures, {});\n"
        "        vec3 q = wr_fma(p, (real)({}), wr_v3(origins + {}));\n"
        "        vec3 w = wr_triplanar_weights(n, {});\n"
        "        vec3 qx = wr_scale(dp_dx, (real)({})), qy = wr_scale(dp_dy, (real)({}));\n",
        at.emitter.texture(l.texture, texel_kind(l.texture)), literal(per_metre), 4 * origin, literal(l.sharpness),
        literal(per_metre), literal(per_metre));
    const struct {
        const char *weight, *s, *t, *name;
    } planes[] = {{"w.x", "z", "y", "slope_x"}, {"w.y", "x", "z", "slope_y"}, {"w.z", "x", "y", "slope_z"}};
    for (const auto& plane : planes)
        text += fmt::format(
            "        vec2 {3} = wr_v2((real)(0), (real)(0));\n"
            "        if (wr_any(active & ({0} > 0)))\n"
            "            {3} = {4}(t, wr_v2(q.{1}, q.{2}), {5});\n",
            plane.weight, plane.s, plane.t, plane.name, sample_function(l.texture),
            at.lod(fmt::format("wr_v2(qx.{}, qx.{})", plane.s, plane.t),
                   fmt::format("wr_v2(qy.{}, qy.{})", plane.s, plane.t)));
    if (l.texture.content == Content::height) text += fmt::format("        m *= {};\n", literal(per_metre));
    return text + at.volume("wr_triplanar_gradient(w, slope_x, slope_y, slope_z)");
}

}  // namespace wrinkle
