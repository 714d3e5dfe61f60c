#include <fmt/format.h>

#include "plan/geometry_text.h"
#include "plan/light_pictures.h"
#include "plan/section.h"
#include "scene/light_extent.h"

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
    if (has_light_table(emitter))
        text +=
            "        wr_light_table light_table = {light_rows, light_lists, light_entries};\n"
            "        wr_index light_tile = wr_tile_number(wr_to_index(at.x), wr_to_index(at.y) - (int)first_row, "
            "(int)light_supers);\n";
    const Lighting& lighting = emitter.scene.lighting;
    if (lighting.relight == Relight::ratio) {
        text +=
            "        const wr_vec3 faint = wr_faint_light(p, lighting, lights);\n"
            "        const wr_vec3 sky_on_base = wr_multiply3(faint, wr_sky(lighting, base, base));\n";
        for (std::size_t k = 1; k <= pictures_of(lighting).size(); ++k)
            text += fmt::format(
                "        const wr_real bounce_{0} = wr_bounce({0}, p, sky_on_base, lighting, lights);\n", k);
    }
    if (relights_metal(emitter)) text += metal_object_text(emitter, section);
    return text + roughness_text(emitter, section) +
           "        wr_lit_point lit_point = {p, n, base, v, albedo, roughness};\n";
}

std::string lit_point_text(const std::string& n, const std::string& roughness) {
    return fmt::format("        lit_point.n = {}, lit_point.roughness = {};\n", n, roughness);
}

bool has_light_table(const Emitter& emitter) {
    const Lighting& lighting = emitter.scene.lighting;
    return emitter.options.write_normal && lighting.relight != Relight::off && lighting.table &&
           !lighting.table->empty();
}

bool lights_extend(const Emitter& emitter) {
    const Lighting& lighting = emitter.scene.lighting;
    return emitter.options.write_normal && lighting.relight != Relight::off && scene::any_extent(lighting);
}

double lights_of_pixel(const Emitter& emitter) {
    constexpr double kOfTable = 8;
    return static_cast<double>(emitter.scene.lighting.lights.size()) + (has_light_table(emitter) ? kOfTable : 0);
}

}  // namespace wrinkle
