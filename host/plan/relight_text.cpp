#include "plan/relight_text.h"

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

/// Text that adds to `change` what lights make of `rest` whose shadows are read off the picture, and the sky of what is
/// left. Declares `reached`, the share of their light that reaches a pixel.
std::string read_shadows_text(const Emitter& emitter) {
    const std::size_t alone = count_read_apart(emitter), before = shared_numbers(emitter);
    std::string text, given;
    const auto add_lamp = [&](const std::string& lit, const std::string& share) {
        text += fmt::format(
            "        lamps = wr_min(wr_scale(old_{0}, {1}), rest);\n"
            "        rest = wr_sub(rest, lamps);\n"
            "        change = wr_add(change, wr_relight_change(lamps, {0}, old_{0}, lighting->max_ratio));\n",
            lit, share);
    };
    if (alone == 0) {
        text =
            "        wr_real reached = wr_visibility(rest, sky, old_lit, lighting->shadow);\n"
            "        wr_vec3 lamps;\n";
        add_lamp("lit", "reached");
    } else {
        for (std::size_t k = 0; k < alone; ++k) given += (k ? ", " : "") + old_name(lit_name(before + 1 + k));
        text = fmt::format(
            "        const wr_vec3 given[{0}] = {{{1}}};\n"
            "        wr_vec3 lamps;\n"
            "        wr_real reached_by[{0}];\n"
            "        wr_real reached = wr_visibilities(rest, sky, given, {0}, lighting->shadow, reached_by);\n",
            alone, given);
        for (std::size_t k = 0; k < alone; ++k) add_lamp(lit_name(before + 1 + k), fmt::format("reached_by[{}]", k));
    }
    return text +
           "        change = wr_add(change, wr_relight_change(rest, lit_sky, old_lit_sky, lighting->max_ratio));\n";
}

/// Text that takes lights' changes from metal, which mirrors what is around it: where its own picture tells of that,
/// metal changes by it, else it stays as it is.
std::string metal_change_text(Emitter& emitter, Section& section) {
    const bool relit = relights_metal(emitter);
    std::string text;
    if (relit)
        text += fmt::format(
            "        wr_vec3 metal_change = wr_relight_change({}, lit_metal, old_lit_metal,\n"
            "            lighting->max_ratio);\n",
            emitter.has("emission.r") ? "wr_max(wr_sub(beauty, emission), wr_zero3())" : "beauty");
    if (emitter.has("metallic")) {
        section.inputs.insert("metallic");
        return text + "        wr_real metal = wr_mask_channel(wr_load(in_metallic, at.in));\n" +
               (relit ? "        change = wr_fma(metal_change, metal, wr_scale(change, 1 - metal));\n"
                      : "        change = wr_scale(change, 1 - metal);\n");
    }
    if (!section.inputs.contains("albedo.r")) return "";
    return text +
           fmt::format(
               "        change = wr_select(fmax(fmax(albedo.x, albedo.y), albedo.z) > WR_METAL_ALBEDO, change, {});\n",
               relit ? "metal_change" : "wr_zero3()");
}

/// Text that declares `left`: 1 where the picture is to stay as it is.
std::string left_text(Emitter& emitter, Section& section) {
    const MaskPlace place{"leave in [lighting]", "leave in [lighting]",
                          [](const Scene& scene) -> const Mask& { return scene.lighting.leave.value(); }};
    const bool invert = place.mask(emitter.scene).invert;
    return fmt::format("        wr_real left;\n        {{\n{}        left = {};\n        }}\n",
                       mask_of_planes(emitter, place, section), invert ? "1 - m" : "m");
}

}  // namespace

bool specular_apart(const Emitter& emitter) {
    return emitter.scene.lighting.relight == Relight::ratio && has_part(emitter, "specular");
}

bool sky_is_sent_on(const Emitter& emitter) {
    return sums_light(emitter) || (mirrors_sky(emitter) && !specular_apart(emitter));
}

std::size_t shared_numbers(const Emitter& emitter) {
    return pictures_of(emitter.scene.lighting).size() + (specular_apart(emitter) ? 1 : 0);
}

std::size_t count_read_apart(const Emitter& emitter) {
    return lights_read_apart(emitter.scene.lighting, specular_apart(emitter)).size();
}

std::string left_picture_text(Emitter& emitter, Section& section) {
    return left_text(emitter, section) + load_text(section, "beauty", {"beauty.r", "beauty.g", "beauty.b"}) +
           "        lit = wr_add(wr_scale(lit, 1 - left), wr_scale(beauty, left));\n";
}

std::string relight_text(Emitter& emitter, Section& section) {
    const std::vector<std::string> pictures = pictures_of(emitter.scene.lighting);
    const auto sent_on = [all = sky_is_sent_on(emitter)](const std::string& sky) {
        return all ? sky : fmt::format("wr_multiply3(albedo, {})", sky);
    };
    std::string text = load_text(section, "beauty", {"beauty.r", "beauty.g", "beauty.b"}) +
                       fmt::format("        wr_vec3 rest = beauty, change = wr_zero3(), sky = {}, sky_now = {};\n",
                                   sent_on("old_lit_sky"), sent_on("lit_sky"));
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
    const bool apart = specular_apart(emitter);
    const bool read = emitter.scene.lighting.shadows == Shadows::read;
    text += "        rest = wr_max(rest, wr_zero3());\n";
    if (apart) text += mirrored_text(emitter, section, pictures);
    if (read)
        text += read_shadows_text(emitter);
    else
        text +=
            "        lit = wr_add(lit, sky_now);\n"
            "        change = wr_add(change, wr_relight_change(rest, lit, wr_add(old_lit, sky), "
            "lighting->max_ratio));\n";
    if (apart) text += shine_text(emitter, section, lit_name(pictures.size() + 1));
    text += metal_change_text(emitter, section);
    if (has_part(emitter, "transmission"))
        text += part_text(emitter, section, "transmission", "through") +
                fmt::format("        change = wr_beside_part(change, through, {});\n",
                            emitter.has("emission.r") ? "wr_sub(beauty, emission)" : "beauty");
    if (emitter.scene.lighting.leave)
        text += left_text(emitter, section) + "        change = wr_scale(change, 1 - left);\n";
    return text +
           "        lit = wr_select(valid, wr_max(wr_add(beauty, change), wr_min(beauty, wr_zero3())), beauty);\n";
}

}  // namespace wrinkle
