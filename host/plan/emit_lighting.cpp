#include <fmt/format.h>

#include <algorithm>

#include "plan/geometry_text.h"
#include "plan/light_pictures.h"
#include "plan/mask_text.h"

namespace wrinkle {

namespace {

/// Whether planes show a part of the picture: by themselves, or direct and indirect light and the colour both are
/// times.
bool has_part(const Emitter& emitter, const std::string& part) {
    return emitter.has(part + ".r") ||
           (emitter.has(part + "_direct.r") && emitter.has(part + "_indirect.r") && emitter.has(part + "_color.r"));
}

bool specular_apart(const Emitter& emitter) {
    return emitter.scene.lighting.relight == Relight::ratio && has_part(emitter, "specular");
}

/// Whether lit_sky is what surfaces send on of the sky, not the irradiance / pi that falls on them. Surfaces of an edge
/// have albedos of their own, and what is added up is the light that they send on; and what they mirror does not depend
/// on the albedo.
bool sky_is_sent_on(const Emitter& emitter) {
    return sums_light(emitter) || (mirrors_sky(emitter) && !specular_apart(emitter));
}

}  // namespace

std::vector<LitTerm> lit_terms(const Emitter& emitter) {
    const bool table = has_light_table(emitter);
    const auto with_table = [&](const std::string& lights, bool diffuse, bool specular) {
        if (!table || !(diffuse || specular)) return lights;
        return fmt::format(
            "wr_add({}, wr_light_of_table(light_table, light_tile, valid, {{p}}, {{n}}, base, v, albedo, "
            "{{roughness}}, "
            "lighting->f0, {}, {}))",
            lights, diffuse ? 1 : 0, specular ? 1 : 0);
    };
    const bool mirrors = mirrors_sky(emitter), apart = specular_apart(emitter);
    const auto with_gloss = [](const std::string& light) {
        return fmt::format("wr_add({}, {})", light, kMirroredSkies);
    };
    if (emitter.scene.lighting.relight != Relight::ratio) {
        const std::string lit =
            fmt::format("wr_light_surface({{p}}, {{n}}, base, v, albedo, {{roughness}}, lighting, lights{})",
                        table ? ", light_table, light_tile, valid" : "");
        return {{"lit", mirrors ? with_gloss(lit) : lit}};
    }
    const std::string sky =
        sky_is_sent_on(emitter) ? "wr_multiply3(albedo, wr_sky(lighting, {n}, base))" : "wr_sky(lighting, {n}, base)";
    std::vector<LitTerm> terms{{"lit_sky", mirrors && !apart ? with_gloss(sky) : sky}};
    if (mirrors && apart) terms.push_back({"lit_gloss", kMirroredSkies});
    const std::size_t last = pictures_of(emitter.scene.lighting).size() + (apart ? 1 : 0);
    for (std::size_t k = 0; k <= last; ++k)  // no picture shows lights of a table
        terms.push_back(
            {lit_name(k),
             with_table(
                 fmt::format("wr_light_group({}, {{p}}, {{n}}, base, v, albedo, {{roughness}}, lighting, lights)", k),
                 k == 0, k == (apart ? last : 0))});
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

/// Text that declares `part`, which has_part() finds, as `name`.
std::string part_text(Emitter& emitter, Section& section, const std::string& part, const char* name) {
    const auto load = [&](const std::string& plane) {
        return load_text(section, plane, {plane + ".r", plane + ".g", plane + ".b"});
    };
    if (emitter.has(part + ".r")) return load(part) + fmt::format("        wr_vec3 {} = {};\n", name, part);
    return load(part + "_direct") + load(part + "_indirect") + load(part + "_color") +
           fmt::format("        wr_vec3 {0} = wr_multiply3(wr_add({1}_direct, {1}_indirect), {1}_color);\n", name,
                       part);
}

/// Text that takes `mirrored` from `rest`: what the rest of the picture shows as specular.
std::string mirrored_text(Emitter& emitter, Section& section, const std::vector<std::string>& pictures) {
    const std::vector<Light>& lights = emitter.scene.lighting.lights;
    const auto any = [&](std::string Light::*lobe, const std::string& name) {
        return std::ranges::any_of(lights, [&](const Light& light) { return light.*lobe == name; });
    };
    std::string text = part_text(emitter, section, "specular", "mirrored"), whole;
    for (std::size_t k = 1; k <= pictures.size(); ++k) {
        if (any(&Light::picture, pictures[k - 1]))
            whole = whole.empty() ? fmt::format("own_{}", k) : fmt::format("wr_add({}, own_{})", whole, k);
        else if (any(&Light::specular, pictures[k - 1]))
            text += fmt::format("        mirrored = wr_sub(mirrored, own_{});\n", k);
    }
    // Nothing tells how much of a light's whole picture is specular: as much as of all that the pixel shows.
    if (!whole.empty())
        text += fmt::format(
            "        wr_vec3 whole = {};\n        mirrored = wr_beside_part(mirrored, whole, wr_add(rest, whole));\n",
            whole);
    return text +
           "        mirrored = wr_min(wr_max(mirrored, wr_zero3()), rest);\n"
           "        rest = wr_sub(rest, mirrored);\n";
}

/// Text that adds the change of `mirrored`, of which lights give the value called `lit`.
std::string shine_text(const Emitter& emitter, Section& section, const char* lit) {
    const bool read = emitter.scene.lighting.shadows == Shadows::read, gloss = mirrors_sky(emitter);
    const auto change = [](const std::string& of, const std::string& now, const std::string& old) {
        return fmt::format(
            "        change = wr_add(change, wr_relight_change({}, {}, {},\n            lighting->max_ratio));\n", of,
            now, old);
    };
    const std::string old = old_name(lit);
    if (read) {
        const std::string shine = fmt::format("wr_min(wr_scale({}, reached), mirrored)", old);
        // What mirrors all around stays as it is where nothing tells what is there to mirror.
        return change(shine, lit, old) +
               (gloss ? change(fmt::format("wr_sub(mirrored, {})", shine), "lit_gloss", "old_lit_gloss") : "");
    }
    if (gloss)
        return change("mirrored", fmt::format("wr_add({}, lit_gloss)", lit),
                      fmt::format("wr_add({}, old_lit_gloss)", old));
    const bool summed = sums_light(emitter);
    if (summed) section.reads.insert("around");
    return fmt::format("        {} = wr_scale({}, (wr_real)(lighting->f0));\n", summed ? "around" : "wr_vec3 around",
                       summed ? "around" : "old_lit_sky") +
           change("mirrored", fmt::format("wr_add({}, around)", lit), fmt::format("wr_add({}, around)", old));
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
    const bool apart = specular_apart(emitter), sent_on = sky_is_sent_on(emitter);
    const bool read = emitter.scene.lighting.shadows == Shadows::read;
    text += fmt::format("        rest = wr_max(rest, wr_zero3());\n        wr_vec3 sky = {};\n",
                        sent_on ? "old_lit_sky" : "wr_multiply3(albedo, old_lit_sky)");
    if (apart) text += mirrored_text(emitter, section, pictures);
    if (read)
        text +=
            "        wr_real reached = wr_visibility(rest, sky, old_lit, lighting->shadow);\n"
            "        wr_vec3 lamps = wr_min(wr_scale(old_lit, reached), rest);\n"
            "        change = wr_add(change, wr_relight_change(lamps, lit, old_lit, lighting->max_ratio));\n"
            "        change = wr_add(change,\n"
            "            wr_relight_change(wr_sub(rest, lamps), lit_sky, old_lit_sky, lighting->max_ratio));\n";
    else
        text += fmt::format(
            "        lit = wr_add(lit, {});\n"
            "        change = wr_add(change, wr_relight_change(rest, lit, wr_add(old_lit, sky), "
            "lighting->max_ratio));\n",
            sent_on ? "lit_sky" : "wr_multiply3(albedo, lit_sky)");
    if (apart) text += shine_text(emitter, section, lit_name(pictures.size() + 1));
    // Metal mirrors what is around it, which nobody knows: it stays as it is.
    if (emitter.has("metallic")) {
        section.inputs.insert("metallic");
        text += "        change = wr_scale(change, 1 - wr_mask_channel(wr_load(in_metallic, at.in)));\n";
    } else if (section.inputs.contains("albedo.r")) {
        text +=
            "        change = wr_select(fmax(fmax(albedo.x, albedo.y), albedo.z) > WR_METAL_ALBEDO, change, "
            "wr_zero3());\n";
    }
    if (has_part(emitter, "transmission"))
        text += part_text(emitter, section, "transmission", "through") +
                fmt::format("        change = wr_beside_part(change, through, {});\n",
                            emitter.has("emission.r") ? "wr_sub(beauty, emission)" : "beauty");
    if (emitter.scene.lighting.leave)
        text += left_text(emitter, section) + "        change = wr_scale(change, 1 - left);\n";
    return text +
           "        lit = wr_select(valid, wr_max(wr_add(beauty, change), wr_min(beauty, wr_zero3())), beauty);\n";
}

/// Text of the roughness that bumped normals are lit with, where they are lit once a pixel.
std::string roughness_now(Section& section, const std::vector<LitTerm>& terms, const LightEnd& end, double lights) {
    if (end.at_taps) {
        for (const LitTerm& term : terms) section.reads.insert(term.value);
        return "roughness";
    }
    section.operations += kLight * lights;
    if (!end.spread) return "roughness";
    section.reads.insert("spread");
    return "wr_widened_roughness(roughness, spread)";
}

}  // namespace

Section emit_light_terms(Emitter& emitter, const LightEnd& end) {
    const std::vector<LitTerm> terms = lit_terms(emitter);
    Section section;
    section.title = "light with and without bumps, for sums over pixels of the picture";
    section.reads = {"valid", "p", "n", "base"};
    section.summed = true;
    section.operations = kLight * lights_of_pixel(emitter);
    section.body = lit_surface_text(emitter, section);
    if (specular_apart(emitter) && emitter.scene.lighting.shadows != Shadows::read && !mirrors_sky(emitter)) {
        section.writes.insert("around");
        section.body += "        around = wr_select(valid, wr_sky(lighting, base, base), wr_zero3());\n";
    }
    const std::string now = roughness_now(section, terms, end, lights_of_pixel(emitter));
    for (const LitTerm& term : terms) {
        const std::string old = old_name(term.value);
        if (!end.at_taps) section.body += fmt::format("        {} = {};\n", term.value, term.of("p", "n", now));
        section.body += fmt::format("        {} = {};\n", old, term.of("p", "base", "roughness"));
        for (const std::string& name : {term.value, old}) {
            section.writes.insert(name);
            section.body += fmt::format("        {0} = wr_select(valid, {0}, wr_zero3());\n", name);
        }
    }
    emitter.plan.sums_over = emitter.available.beauty_scale;
    return section;
}

Section emit_lighting(Emitter& emitter, const LightEnd& end) {
    const Lighting& lighting = emitter.scene.lighting;
    const bool ratio = lighting.relight == Relight::ratio;
    const double lights = lights_of_pixel(emitter);
    const std::vector<LitTerm> terms = lit_terms(emitter);
    Section section;
    section.title = ratio ? "relight the picture by lit(new) / lit(old)" : "light";
    section.reads = {"valid", "p", "n", "base"};
    section.writes = {"lit"};
    section.operations = 20;
    std::string& text = section.body;
    text = lit_surface_text(emitter, section);
    const std::string now = end.summed ? "" : roughness_now(section, terms, end, lights);
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
    section.operations += 60 + (end.summed ? 0 : kLight * lights);
    for (const LitTerm& term : terms) {
        if (end.summed) {
            section.reads.insert({term.value, old_name(term.value)});
            continue;
        }
        if (!end.at_taps && term.value != "lit") text += fmt::format("        wr_vec3 {};\n", term.value);
        if (!end.at_taps) text += fmt::format("        {} = {};\n", term.value, term.of("p", "n", now));
        text += fmt::format("        wr_vec3 {} = {};\n", old_name(term.value), term.of("p", "base", "roughness"));
    }
    text += relight_text(emitter, section);
    emitter.plan.specular_apart = specular_apart(emitter);
    if (emitter.scene.output.marked) {
        section.reads.insert("marked");
        section.writes.insert("marked");
        text += "        marked += beauty_seen ? (wr_real)(0) : (wr_real)(16);\n";
    }
    return section;
}

}  // namespace wrinkle
