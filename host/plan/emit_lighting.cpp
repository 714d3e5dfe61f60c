#include <fmt/format.h>

#include "plan/geometry_text.h"

namespace wrinkle {

std::string roughness_text(Emitter& emitter, Section& section) {
    if (!emitter.has("roughness")) return "        wr_real roughness = lighting->roughness;\n";
    section.inputs.insert("roughness");
    return "        wr_real roughness = wr_load(in_roughness, at.in);\n";
}

std::string lit_surface_text(Emitter& emitter, Section& section) {
    std::string text = fmt::format("        wr_vec3 v = {};\n", to_viewer_text(emitter));
    if (emitter.has("albedo.r") && emitter.has("albedo.g") && emitter.has("albedo.b")) {
        section.inputs.insert({"albedo.r", "albedo.g", "albedo.b"});
        text +=
            "        wr_vec3 albedo = wr_v3(wr_mask_channel(wr_load(in_albedo_r, at.in)),\n"
            "                            wr_mask_channel(wr_load(in_albedo_g, at.in)),\n"
            "                            wr_mask_channel(wr_load(in_albedo_b, at.in)));  // [0,1]; NaN is 0\n";
    } else {
        text += "        wr_vec3 albedo = wr_v3(lighting->albedo);\n";
    }
    return text + roughness_text(emitter, section);
}

Section emit_lighting(Emitter& emitter, const LightEnd& end) {
    constexpr double kLight = 75;  // expected operations, of one normal and one light
    const Lighting& lighting = emitter.scene.lighting;
    const bool ratio = lighting.relight == Relight::ratio;
    const double lights = static_cast<double>(lighting.lights.size());
    Section section;
    section.title = ratio ? "relight the picture by lit(new) / lit(old)" : "light";
    section.reads = {"valid", "p", "n", "base"};
    section.writes = {"lit"};
    section.operations = 20;
    std::string& text = section.body;
    text = lit_surface_text(emitter, section);
    std::string now = "roughness";
    if (end.at_taps) {
        section.reads.insert("lit");
    } else {
        section.operations += kLight * lights;
        if (end.spread) {
            section.reads.insert("spread");
            now = "wr_widened_roughness(roughness, spread)";
        }
    }
    if (!ratio) {
        if (!end.at_taps)
            text += fmt::format("        lit = wr_light_surface(p, n, base, v, albedo, {}, lighting, lights);\n", now);
        text += "        lit = wr_select(valid, lit, wr_zero3());\n";
        return section;
    }
    emitter.need("relight = \"ratio\"", {"beauty.r", "beauty.g", "beauty.b"});
    section.inputs.insert({"beauty.r", "beauty.g", "beauty.b"});
    section.operations += 20 + kLight * lights;
    text += end.at_taps
                ? "        wr_vec3 old = wr_light_surface(p, base, base, v, albedo, roughness, lighting, lights);\n"
                : fmt::format(
                      "        wr_vec3 old;\n        lit = wr_light_surface(p, n, {}, base, roughness, v, "
                      "albedo, lighting, lights, &old);\n",
                      now);
    // Metal mirrors what is around it, which nobody knows: it stays as it is.
    const bool metal = section.inputs.contains("albedo.r");
    if (metal)
        text +=
            "        const wr_mask changes = valid & (fmax(fmax(albedo.x, albedo.y), albedo.z) > WR_METAL_ALBEDO);\n";
    const struct { char axis, color; } parts[] = {{'x', 'r'}, {'y', 'g'}, {'z', 'b'}};
    for (const auto& part : parts)
        text += fmt::format(
            "        wr_floats raw_{1} = wr_load_floats(in_beauty_{1}, at.in);\n"
            "        wr_mask seen_{1} = wr_finite(raw_{1});\n"
            "        wr_real {1} = wr_to_real(wr_valid_or(raw_{1}, seen_{1}, 0));\n"
            "        lit.{0} = {2} ? {1} * wr_relight_ratio(lit.{0}, old.{0}, lighting->max_ratio) : {1};\n",
            part.axis, part.color, metal ? "changes" : "valid");
    if (emitter.scene.output.marked) {
        section.reads.insert("marked");
        section.writes.insert("marked");
        text += "        marked += (seen_r & seen_g & seen_b) ? (wr_real)(0) : (wr_real)(16);\n";
    }
    return section;
}

}  // namespace wrinkle
