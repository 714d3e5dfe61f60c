#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "base/vec.h"
#include "scene/kinds.h"
#include "scene/light_columns.h"
#include "scene/light_extent.h"
#include "scene/light_json.h"
#include "scene/light_rules.h"
#include "scene/readers.h"
#include "scene/row_reader.h"
#include "wrinkle/error.h"

namespace wrinkle::scene {
namespace {

void read_color(Table& table, Light& light) {
    table.read("color", light.color, not_negative);
    table.read("intensity", light.intensity, not_negative);
}

/// Whether there is one is compiled in; lights without come and go.
void read_pictures(Table& table, Light& light) {
    const auto read = [&](const char* key, std::string& name) {
        if (!table.visits() || !name.empty()) table.read(key, name);
    };
    read("picture", light.picture), read("diffuse", light.diffuse), read("specular", light.specular);
    if (!light.picture.empty() && !(light.diffuse.empty() && light.specular.empty()))
        table.complain(light.diffuse.empty() ? "specular" : "diffuse",
                       "is a part of what picture shows; name picture, or diffuse and specular");
}

void read_position(Table& table, Light& light) {
    table.require("position");
    table.read("position", light.position);
}

void read_direction(Table& table, Light& light) {
    table.require("direction");
    table.read("direction", light.direction);
    light.direction = normalize(light.direction);
}

/// Whether there is one is not compiled in: lights come and go.
void read_range(Table& table, Light& light) {
    double range = light.range.value_or(1);
    if ((!table.visits() || light.range) && table.read("range", range, positive)) light.range = range;
}

void read_sky_picture(Table& table, Light& light) {
    for (const char* key : {"zenith", "horizon", "ground"})
        if (table.has(key)) table.complain(key, "has no effect beside texture, which shows all of the sky");
    table.read_degrees("rotation", light.rotation);
    if (table.visits()) {
        for (Vec3 numbers : *light.harmonics) table.read("texture", numbers);
    } else if (table.read_file("texture", light.texture)) {
        try {
            light.harmonics = load_sky(light.texture);
        } catch (const Error& error) { table.complain("texture", fmt::format("cannot be used:\n{}", error.what())); }
    }
}

void read_sky(Table& table, Light& light) {
    light.kind = LightKind::sky;
    if (table.read("up", light.up) && light.up == Vec3{})
        table.complain("up", "must not be zero; it is where the zenith is");
    light.up = normalize(light.up);
    table.read("intensity", light.intensity, not_negative);
    table.read("highlights", light.highlights, Compiled::no);
    for (const char* key : {"texture", "rotation", "zenith", "horizon", "ground"}) table.know(key);
    if (table.visits() ? light.harmonics.has_value() : table.has("texture")) return read_sky_picture(table, light);
    if (table.has("rotation")) table.complain("rotation", "has no effect without texture, which it turns");
    table.require("zenith");
    table.read("zenith", light.zenith, not_negative);
    light.horizon = table.visits() ? light.horizon : light.zenith;
    table.read("horizon", light.horizon, not_negative);
    table.read("ground", light.ground, not_negative);
}

void read_sun(Table& table, Light& light) {
    light.kind = LightKind::sun;
    read_color(table, light);
    read_pictures(table, light);
    read_direction(table, light);
    table.read_degrees("angle", light.angle, {.low = 0, .high = 170});
}

/// What lights at a place share.
void read_lamp(Table& table, Light& light) {
    read_color(table, light);
    read_pictures(table, light);
    read_position(table, light);
    read_range(table, light);
}

void read_point(Table& table, Light& light) {
    light.kind = LightKind::point;
    read_lamp(table, light);
}

void read_spot(Table& table, Light& light) {
    light.kind = LightKind::spot;
    read_lamp(table, light);
    read_direction(table, light);
    table.read_degrees("inner_angle", light.inner_angle, {.low = 0, .high = 180});
    table.read_degrees("outer_angle", light.outer_angle, {.low = 0, .high = 180});
}

void read_sphere(Table& table, Light& light) {
    light.kind = LightKind::sphere;
    read_lamp(table, light);
    table.require("radius");
    table.read("radius", light.radius, not_negative);
}

void read_disc(Table& table, Light& light) {
    light.kind = LightKind::disc;
    read_lamp(table, light);
    read_direction(table, light);
    table.require("radius");
    table.read("radius", light.radius, not_negative);
}

void read_rectangle(Table& table, Light& light) {
    light.kind = LightKind::rectangle;
    read_lamp(table, light);
    read_direction(table, light);
    table.require("size");
    table.read("size", light.size, not_negative);
    table.require("up");
    table.read("up", light.up);
}

constexpr Kind<Light> kinds[] = {
    {"sun", read_sun},       {"point", read_point}, {"spot", read_spot},          {"sky", read_sky},
    {"sphere", read_sphere}, {"disc", read_disc},   {"rectangle", read_rectangle}};

/// Checks a table of a scene in memory, and says what of it is compiled in.
void visit_light_table(Table& table, const Lighting& lighting) {
    const bool any = lighting.table && !lighting.table->empty();
    table.compiled_in("lights", any);
    if (!any) return;
    try {
        const RowKind<Light> kind = light_rows();
        RowReader<Light> reader(lighting.table_file.string(), kind, TableForm::memory);
        for (const Light& light : *lighting.table) reader.check(light);
        reader.finish();
    } catch (const Error& error) { table.complain("lights", fmt::format("cannot be used:\n{}", error.what())); }
}

void read_light_table(Table& table, Lighting& out) {
    table.compiled_in("lights with an extent", any_extent(out));
    std::string mirrored;
    for (const Light& light : out.lights)
        if (is_mirrored(light)) mirrored += fmt::format("{}, ", quote(light.texture.string()));
    table.compiled_in("skies with highlights", mirrored);
    // Of two or three, kernels see each apart (lights_read_apart).
    const auto unseen = std::ranges::count_if(
        out.lights, [](const Light& l) { return l.kind != LightKind::sky && l.picture.empty() && l.diffuse.empty(); });
    const bool apart = out.shadows == Shadows::read && (unseen == 2 || unseen == 3);
    table.compiled_in("lights whose shadows are read apart", apart ? static_cast<int>(unseen) : 0);
    if (table.visits()) return visit_light_table(table, out);
    if (!table.read_file("lights", out.table_file)) return;
    if (out.relight == Relight::off && !table.is_bad("relight"))
        table.complain("lights",
                       "has no effect while relighting is off; set relight = \"lit\" or \"ratio\", or remove it");
    if (is_json(out.table_file)) return;  // lights beside each [[light]], which are read first
    try {
        out.table = std::make_shared<const std::vector<Light>>(load_lights(out.table_file));
    } catch (const Error& error) { table.complain("lights", fmt::format("cannot be used:\n{}", error.what())); }
}

}  // namespace

void read_light(Table& table, Light& out) {
    if (!table.visits()) out.location = table.location();
    // In the order of LightKind. Kernels read the kind of a light: it is not compiled in.
    const auto held = static_cast<std::size_t>(out.kind);
    if (table.visits() && held >= std::size(kinds))
        table.complain("kind", fmt::format("is number {}, which is none of those there are", held));
    const Kind<Light>* kind = !table.visits()           ? choose_kind<Light>(table, kinds)
                              : held < std::size(kinds) ? &kinds[held]
                                                        : nullptr;
    read_as_kind<Light>(table, kinds, kind, out);
    if (kind == nullptr) return;
    check_light(out, [&](std::initializer_list<const char*> keys, const std::string& text) {
        if (std::ranges::any_of(keys, [&](const char* key) { return table.is_bad(key); })) return;
        const auto* const given = std::ranges::find_if(keys, [&](const char* key) { return table.has(key); });
        if (given == keys.end() && !table.visits()) return;  // it is required, and reported as such
        table.complain(given == keys.end() ? *keys.begin() : *given, text);
    });
}

void read_lighting(Table& table, Lighting& out) {
    table.choose("relight", out.relight, {{"off", Relight::off}, {"lit", Relight::lit}, {"ratio", Relight::ratio}});
    table.choose("shadows", out.shadows,
                 {{"automatic", Shadows::automatic}, {"read", Shadows::read}, {"ignored", Shadows::ignored}});
    table.read("ambient", out.ambient, not_negative);
    table.read("albedo", out.albedo, zero_to_one);
    table.read("roughness", out.roughness, zero_to_one);
    table.read("f0", out.f0, zero_to_one);
    table.read("max_ratio", out.max_ratio, {.low = 1});
    if (auto leave = table.table("leave", "leave of " + table.where(), out.leave.has_value())) {
        Mask mask = out.leave.value_or(Mask{});
        read_leave(*leave, mask);
        out.leave = std::move(mask);
    }
    read_light_table(table, out);
    table.read("exposure", out.exposure, {.low = -64, .high = 64});
    table.finish();
}

}  // namespace wrinkle::scene
