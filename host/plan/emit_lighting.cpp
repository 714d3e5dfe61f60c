#include <fmt/format.h>

#include "plan/geometry_text.h"
#include "plan/light_pictures.h"
#include "plan/mask_text.h"

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

std::vector<LitTerm> lit_terms(const Emitter& emitter) {
    if (emitter.scene.lighting.relight != Relight::ratio)
        return {{"lit", "wr_light_surface({p}, {n}, base, v, albedo, {roughness}, lighting, lights)"}};
    std::vector<LitTerm> terms{{"lit_sky", "wr_sky(lighting, {n}, base)"}};
    const std::size_t pictures = pictures_of(emitter.scene.lighting).size();
    for (std::size_t k = 0; k <= pictures; ++k)
        terms.push_back(
            {lit_name(k),
             fmt::format("wr_light_group({}, {{p}}, {{n}}, base, v, albedo, {{roughness}}, lighting, lights)", k)});
    return terms;
}

std::string LitTerm::of(const std::string& p, const std::string& n, const std::string& roughness) const {
    return fmt::format(fmt::runtime(call), fmt::arg("p", p), fmt::arg("n", n), fmt::arg("roughness", roughness));
}

namespace {

constexpr double kLight = 75;  // expected operations, of one normal and one light

/// Text that loads a picture as a vector, and where it is finite.
std::string load_text(Section& section, const std::string& name, const std::array<std::string, 3>& planes) {
    section.inputs.insert(planes.begin(), planes.end());
    return fmt::format(
        "        wr_mask {0}_seen;\n"
        "        wr_vec3 {0} = wr_picture_of(wr_load_floats({1}, at.in), wr_load_floats({2}, at.in),\n"
        "            wr_load_floats({3}, at.in), &{0}_seen);\n",
        name, identifier(planes[0]), identifier(planes[1]), identifier(planes[2]));
}

/// Text that declares `through`, what a pixel shows through its surface; empty where no pass tells.
std::string through_text(Emitter& emitter, Section& section) {
    const auto load = [&](const char* name) {
        const std::string plane = name;
        return load_text(section, plane, {plane + ".r", plane + ".g", plane + ".b"});
    };
    if (emitter.has("transmission.r")) return load("transmission") + "        wr_vec3 through = transmission;\n";
    for (const char* part : {"transmission_direct.r", "transmission_indirect.r", "transmission_color.r"})
        if (!emitter.has(part)) return {};
    return load("transmission_direct") + load("transmission_indirect") + load("transmission_color") +
           "        wr_vec3 through = wr_multiply3(wr_add(transmission_direct, transmission_indirect), "
           "transmission_color);\n";
}

/// Text that declares `left`: 1 where the picture is to stay as it is.
std::string left_text(Emitter& emitter, Section& section) {
    const MaskPlace place{"leave in [lighting]", "leave in [lighting]",
                          [](const Scene& scene) -> const Mask& { return scene.lighting.leave.value(); }};
    const bool invert = place.mask(emitter.scene).invert;
    return fmt::format("        wr_real left;\n        {{\n{}        left = {};\n        }}\n",
                       mask_of_planes(emitter, place, section), invert ? "1 - m" : "m");
}

/// Text that sets `lit`, which holds what lights without pictures give, to the picture with the bumps.
std::string relight_text(Emitter& emitter, Section& section) {
    const std::vector<std::string> pictures = pictures_of(emitter.scene.lighting);
    std::string text = load_text(section, "beauty", {"beauty.r", "beauty.g", "beauty.b"}) +
                       "        wr_vec3 rest = beauty, change = wr_zero3();\n";
    // A picture of one light that has a hole shows nothing of it there: all is taken for other light.
    for (std::size_t k = 1; k <= pictures.size(); ++k)
        text += load_text(section, fmt::format("own_{}", k), picture_planes(emitter, pictures[k - 1])) +
                fmt::format(
                    "        own_{0} = wr_max(wr_select(own_{0}_seen, own_{0}, wr_zero3()), wr_zero3());\n"
                    "        rest = wr_sub(rest, own_{0});\n"
                    "        change = wr_add(change, wr_relight_change(own_{0}, {1}, old_{1}, lighting->max_ratio));\n",
                    k, lit_name(k));
    if (emitter.has("emission.r"))
        text += load_text(section, "emission", {"emission.r", "emission.g", "emission.b"}) +
                "        emission = wr_max(emission, wr_zero3());\n"
                "        rest = wr_sub(rest, emission);\n";
    text +=
        "        rest = wr_max(rest, wr_zero3());\n"
        "        wr_vec3 sky = wr_v3(albedo.x * old_lit_sky.x, albedo.y * old_lit_sky.y, albedo.z * old_lit_sky.z);\n";
    if (emitter.scene.lighting.shadows == Shadows::read)
        text +=
            "        wr_vec3 lamps = wr_min(wr_scale(old_lit, wr_visibility(rest, sky, old_lit, lighting->shadow)), "
            "rest);\n"
            "        change = wr_add(change, wr_relight_change(lamps, lit, old_lit, lighting->max_ratio));\n"
            "        change = wr_add(change,\n"
            "            wr_relight_change(wr_sub(rest, lamps), lit_sky, old_lit_sky, lighting->max_ratio));\n";
    else
        text +=
            "        lit = wr_add(lit, wr_v3(albedo.x * lit_sky.x, albedo.y * lit_sky.y, albedo.z * lit_sky.z));\n"
            "        change = wr_add(change, wr_relight_change(rest, lit, wr_add(old_lit, sky), "
            "lighting->max_ratio));\n";
    // Metal mirrors what is around it, which nobody knows: it stays as it is.
    if (emitter.has("metallic")) {
        section.inputs.insert("metallic");
        text += "        change = wr_scale(change, 1 - wr_mask_channel(wr_load(in_metallic, at.in)));\n";
    } else if (section.inputs.contains("albedo.r")) {
        text +=
            "        change = wr_select(fmax(fmax(albedo.x, albedo.y), albedo.z) > WR_METAL_ALBEDO, change, "
            "wr_zero3());\n";
    }
    if (const std::string through = through_text(emitter, section); !through.empty())
        text += through + fmt::format("        change = wr_beside_part(change, through, {});\n",
                                      emitter.has("emission.r") ? "wr_sub(beauty, emission)" : "beauty");
    if (emitter.scene.lighting.leave)
        text += left_text(emitter, section) + "        change = wr_scale(change, 1 - left);\n";
    return text +
           "        lit = wr_select(valid, wr_max(wr_add(beauty, change), wr_min(beauty, wr_zero3())), beauty);\n";
}

}  // namespace

Section emit_lighting(Emitter& emitter, const LightEnd& end) {
    const Lighting& lighting = emitter.scene.lighting;
    const bool ratio = lighting.relight == Relight::ratio;
    const double lights = static_cast<double>(lighting.lights.size());
    const std::vector<LitTerm> terms = lit_terms(emitter);
    Section section;
    section.title = ratio ? "relight the picture by lit(new) / lit(old)" : "light";
    section.reads = {"valid", "p", "n", "base"};
    section.writes = {"lit"};
    section.operations = 20;
    std::string& text = section.body;
    text = lit_surface_text(emitter, section);
    std::string now = "roughness";
    if (end.at_taps) {
        for (const LitTerm& term : terms) section.reads.insert(term.value);
    } else {
        section.operations += kLight * lights;
        if (end.spread) {
            section.reads.insert("spread");
            now = "wr_widened_roughness(roughness, spread)";
        }
    }
    if (!ratio) {
        if (!end.at_taps) text += fmt::format("        lit = {};\n", terms.front().of("p", "n", now));
        text += "        lit = wr_select(valid, lit, wr_zero3());\n";
        if (lighting.leave) {
            emitter.need("leave in [lighting]", {"beauty.r", "beauty.g", "beauty.b"});
            text += left_text(emitter, section) + load_text(section, "beauty", {"beauty.r", "beauty.g", "beauty.b"}) +
                    "        lit = wr_add(wr_scale(lit, 1 - left), wr_scale(beauty, left));\n";
        }
        return section;
    }
    emitter.need("relight = \"ratio\"", {"beauty.r", "beauty.g", "beauty.b"});
    section.operations += 60 + kLight * lights;
    for (const LitTerm& term : terms) {
        if (!end.at_taps && term.value != "lit") text += fmt::format("        wr_vec3 {};\n", term.value);
        if (!end.at_taps) text += fmt::format("        {} = {};\n", term.value, term.of("p", "n", now));
        text += fmt::format("        wr_vec3 old_{} = {};\n", term.value, term.of("p", "base", "roughness"));
    }
    text += relight_text(emitter, section);
    if (emitter.scene.output.marked) {
        section.reads.insert("marked");
        section.writes.insert("marked");
        text += "        marked += beauty_seen ? (wr_real)(0) : (wr_real)(16);\n";
    }
    return section;
}

}  // namespace wrinkle
