#include <fmt/format.h>

#include <algorithm>

#include "plan/geometry_text.h"
#include "plan/light_pictures.h"
#include "plan/relight_text.h"

namespace wrinkle {

std::vector<LitTerm> lit_terms(const Emitter& emitter) {
    const bool table = has_light_table(emitter);
    const auto with_table = [&](const std::string& lights, bool diffuse, bool specular) {
        if (!table || !(diffuse || specular)) return lights;
        return fmt::format(
            "wr_add({}, wr_light_of_table(light_table, light_tile, valid, &lit_point, lighting->f0, {}, {}))", lights,
            diffuse ? 1 : 0, specular ? 1 : 0);
    };
    const bool mirrors = mirrors_sky(emitter), apart = specular_apart(emitter);
    const auto with_gloss = [](const std::string& light) {
        return fmt::format("wr_add({}, {})", light, kMirroredSkies);
    };
    if (emitter.scene.lighting.relight != Relight::ratio) {
        const std::string lit = fmt::format("wr_light_surface(&lit_point, lighting, lights{})",
                                            table ? ", light_table, light_tile, valid" : "");
        return {{"lit", mirrors ? with_gloss(lit) : lit}};
    }
    const std::string around = "wr_multiply3(faint, wr_sky(lighting, {n}, base))",
                      sent_on = fmt::format("wr_multiply3(albedo, {})", around),
                      sky = sky_is_sent_on(emitter) ? sent_on : around;
    std::vector<LitTerm> terms{{"lit_sky", mirrors && !apart ? with_gloss(sky) : sky}};
    if (mirrors && apart) terms.push_back({"lit_gloss", kMirroredSkies});
    if (relights_metal(emitter)) terms.push_back({"lit_metal", kMirroredByMetal});
    const std::size_t last = shared_numbers(emitter), alone = count_read_apart(emitter),
                      own = pictures_of(emitter.scene.lighting).size();
    for (std::size_t k = alone > 0 ? 1 : 0; k <= last + alone; ++k) {  // no picture shows lights of a table
        const std::string given = fmt::format("wr_light_group({}, &lit_point, lighting, lights)", k);
        const bool has_picture = k >= 1 && k <= own;
        terms.push_back(
            {lit_name(k), with_table(has_picture ? fmt::format("wr_fma({}, bounce_{}, {})", sent_on, k, given) : given,
                                     k == 0, k == (apart ? last : 0))});
    }
    return terms;
}

std::string LitTerm::of(const std::string& n, const std::string& roughness) const {
    return fmt::format(fmt::runtime(call), fmt::arg("n", n), fmt::arg("roughness", roughness));
}

namespace {

constexpr double kLight = 75;  // expected operations, of one normal and one light

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

/// Text that sets all terms, of `lit_point` as it is.
std::string values_text(const std::vector<LitTerm>& terms, const std::string& n, const std::string& roughness) {
    std::string text;
    for (const LitTerm& term : terms) text += fmt::format("        {} = {};\n", term.value, term.of(n, roughness));
    return text;
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
        section.body += "        around = wr_select(valid, sky_on_base, wr_zero3());\n";
    }
    const std::string now = roughness_now(section, terms, end, lights_of_pixel(emitter));
    if (!end.at_taps) section.body += lit_point_text("n", now) + values_text(terms, "n", now);
    section.body += lit_point_text("base", "roughness");
    for (const LitTerm& term : terms) {
        const std::string old = old_name(term.value);
        section.body += fmt::format("        {} = {};\n", old, term.of("base", "roughness"));
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
        if (!end.at_taps) text += lit_point_text("n", now) + values_text(terms, "n", now);
        text += "        lit = wr_select(valid, lit, wr_zero3());\n";
        if (lighting.leave) {
            emitter.need("leave in [lighting]", {"beauty.r", "beauty.g", "beauty.b"});
            text += left_picture_text(emitter, section);
        }
        return section;
    }
    emitter.need("relight = \"ratio\"", {"beauty.r", "beauty.g", "beauty.b"});
    section.operations += 60 + (end.summed ? 0 : kLight * lights);
    if (end.summed) {
        for (const LitTerm& term : terms) section.reads.insert({term.value, old_name(term.value)});
    } else {
        if (!end.at_taps) {
            for (const LitTerm& term : terms)
                if (term.value != "lit") text += fmt::format("        wr_vec3 {};\n", term.value);
            text += lit_point_text("n", now) + values_text(terms, "n", now);
        }
        text += lit_point_text("base", "roughness");
        for (const LitTerm& term : terms)
            text += fmt::format("        wr_vec3 {} = {};\n", old_name(term.value), term.of("base", "roughness"));
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
