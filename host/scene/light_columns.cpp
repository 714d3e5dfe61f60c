#include "scene/light_columns.h"

#include <algorithm>

#include "scene/column_values.h"
#include "scene/light_rules.h"

namespace wrinkle::scene {
namespace {

using Row = Light;

std::string range_of(double value, std::optional<double>& out) {
    double range = 0;
    std::string problem = number(value, range, positive);
    if (problem.empty()) out = range;
    return problem;
}

std::string angle(double value, double& radians) {
    std::string problem = number(value, value, degrees);
    if (problem.empty()) radians = to_radians(value);
    return problem;
}

constexpr std::pair<const char*, LightKind> kinds[] = {{"point", LightKind::point},
                                                       {"spot", LightKind::spot},
                                                       {"sphere", LightKind::sphere},
                                                       {"disc", LightKind::disc},
                                                       {"rectangle", LightKind::rectangle}};

std::string kind_of(std::string_view field, LightKind& out) {
    for (const auto& [name, kind] : kinds)
        if (field == name) return out = kind, std::string{};
    return "must be one of \"point\", \"spot\", \"sphere\", \"disc\", \"rectangle\"; suns and skies are [[light]] of "
           "the scene";
}

std::string name_of(LightKind kind) {
    const auto* const row = std::ranges::find(kinds, kind, &std::pair<const char*, LightKind>::second);
    return row == std::end(kinds) ? "" : row->first;
}

#define ANGLE(NAME, MEMBER)                                                                                    \
    {                                                                                                          \
        NAME, NAME, 0, Field::number, [](std::string_view f, Light& l) { return angle(parsed(f), l.MEMBER); }, \
            [](double value, Light& l) { return angle(value, l.MEMBER); },                                     \
            [](const Light& l) { return number_held(to_degrees(l.MEMBER), degrees); },                         \
            [](const Light& l) { return fmt::format("{}", to_degrees(l.MEMBER)); }                             \
    }

// The columns of the position come first: they are the ones that have to be there.
constexpr Column<Light> columns[] = {
    VECTOR("x", "y", "z", "position", position, any_number, any_number),
    {"kind", "kind", 0, Field::name, [](std::string_view f, Light& l) { return kind_of(f, l.kind); }, nullptr,
     [](const Light& l) {
         LightKind ignored{};
         return kind_of(name_of(l.kind), ignored);
     },
     [](const Light& l) { return name_of(l.kind); }},
    VECTOR("r", "g", "b", "color", color, not_negative, not_negative),
    NUMBER("intensity", intensity, not_negative),
    {"range", "range", 0, Field::number, [](std::string_view f, Light& l) { return range_of(parsed(f), l.range); },
     // Arrays of numbers cannot leave a field empty, so NaN stands for no range there.
     [](double value, Light& l) { return std::isnan(value) ? std::string{} : range_of(value, l.range); },
     [](const Light& l) { return number_held(l.range.value_or(1), positive); },
     [](const Light& l) { return l.range ? fmt::format("{}", *l.range) : std::string{}; }},
    VECTOR("direction_x", "direction_y", "direction_z", "direction", direction, any_number, any_number),
    ANGLE("inner_angle", inner_angle),
    ANGLE("outer_angle", outer_angle),
    NUMBER("radius", radius, not_negative),
    RANGED("width", "size", 2, size[0], not_negative, not_negative),
    RANGED("height", "size", 2, size[1], not_negative, not_negative),
    VECTOR("up_x", "up_y", "up_z", "up", up, any_number, any_number),
};

void check_together(const Light& light, const Wrong& wrong) {
    if (!light.picture.empty() || !light.diffuse.empty() || !light.specular.empty())
        wrong({}, "a light of a table has no picture of its own; make it a [[light]] of the scene");
    const bool round = light.kind == LightKind::disc || light.kind == LightKind::sphere;
    if (!round && light.radius > 0) wrong({"radius"}, "is of a disc or a sphere; give the column kind");
    if (light.kind != LightKind::rectangle && (light.size[0] > 0 || light.size[1] > 0))
        wrong({"width", "height"}, "are of a rectangle; give the column kind");
    check_light(light, [&](std::initializer_list<const char*> keys, const std::string& text) {
        const std::string_view first = *keys.begin();
        if (first == "size")
            wrong({"width", "height"}, text);
        else if (first == "direction")
            wrong({"direction_x", "direction_y", "direction_z"}, text);
        else if (first == "up")
            wrong({"up_x", "up_y", "up_z"}, text);
        else
            wrong(keys, text);
    });
}

}  // namespace

RowKind<Light> light_rows() {
    return {.name = "light",
            .columns = columns,
            .required = 3,
            .bytes = 900,  // a row, what kernels get of it, and the bins that it lies in
            .begin = [](Light& light, std::uint32_t) { light.kind = LightKind::point; },
            .together = check_together};
}

}  // namespace wrinkle::scene
