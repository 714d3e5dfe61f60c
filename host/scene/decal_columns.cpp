#include "scene/decal_columns.h"

#include <algorithm>

#include "base/vec.h"
#include "scene/column_values.h"

namespace wrinkle::scene {
namespace {

using Row = Projector;

constexpr const char* shapes[] = {"box", "sphere", "cone"};
constexpr const char* wraps[] = {"tile", "clamp"};  // in the order of Wrap
constexpr const char* modes[] = {"add", "replace"};
constexpr const char* truths[] = {"no", "yes"};

std::string angle(double value, double& cosine) {
    std::string problem = number(value, value, degrees);
    if (problem.empty()) cosine = std::cos(value * kDegree);
    return problem;
}
std::string cosine(double value) {
    return value >= -1 && value <= 1 ? std::string{} : "must be a cosine, from -1 to 1";
}
std::string angle_text(double cosine) { return fmt::format("{:.9g}", std::acos(cosine) / kDegree); }

std::string whole(double value, std::uint32_t& out) {
    const bool sound = value >= 0 && value <= std::numeric_limits<std::uint32_t>::max() && value == std::floor(value);
    if (sound) out = static_cast<std::uint32_t>(value);
    return sound ? std::string{} : "must be a whole number, 0 or more";
}

std::string any_held(std::uint32_t) { return {}; }

std::string truth(double value, bool& out) {
    if (value == 0 || value == 1) out = value == 1;
    return value == 0 || value == 1 ? std::string{} : "must be 0 or 1, bool, or text: \"no\", \"yes\"";
}

std::string object(double value, std::optional<double>& out) {
    double index = 0;
    std::string problem = number(value, index, any_number);
    if (problem.empty()) out = index;
    return problem;
}

/// A column of numbers: READ(value, member) checks and sets a field's, WRONG(member) checks the one that a row holds.
#define CHECKED(NAME, KEY, SIZE, MEMBER, READ, WRONG, WRITE)                                                      \
    {                                                                                                             \
        NAME, KEY, SIZE, Field::number, [](std::string_view f, Projector& p) { return READ(parsed(f), MEMBER); }, \
            [](double value, Projector& p) { return READ(value, MEMBER); },                                       \
            [](const Projector& p) { return WRONG(MEMBER); }, [](const Projector& p) { return WRITE; }            \
    }
#define PAIR(X, Y, KEY, MEMBER, RANGE) \
    RANGED(X, KEY, 2, MEMBER[0], RANGE, RANGE), RANGED(Y, KEY, 2, MEMBER[1], RANGE, RANGE)
#define ANGLE(NAME, MEMBER) CHECKED(NAME, "angle_fade", 2, MEMBER, angle, cosine, angle_text(MEMBER))

// The columns of the position come first: they are the ones that have to be there.
constexpr Column<Projector> columns[] = {
    VECTOR("x", "y", "z", "center", center, any_number, any_number),
    CHOICE("shape", Field::name, shape, shapes, nullptr),
    CHECKED("texture", "texture", 0, p.texture, whole, any_held, fmt::format("{}", p.texture)),
    RANGED("s0", "region", 4, region[0], zero_to_one, zero_to_one),
    RANGED("t0", "region", 4, region[1], zero_to_one, zero_to_one),
    RANGED("s1", "region", 4, region[2], zero_to_one, zero_to_one),
    RANGED("t1", "region", 4, region[3], zero_to_one, zero_to_one),
    VECTOR("axis_x_x", "axis_x_y", "axis_x_z", "axis_x", axis_x, any_number, any_number),
    VECTOR("axis_y_x", "axis_y_y", "axis_y_z", "axis_y", axis_y, any_number, any_number),
    VECTOR("half_x", "half_y", "half_z", "half_size", half_size, positive, any_number),
    NUMBER("scale", scale, any_number),
    VECTOR("falloff_x", "falloff_y", "falloff_z", "falloff", falloff, zero_to_one, zero_to_one),
    ANGLE("angle_full", p.angle_fade[1]),
    ANGLE("angle_zero", p.angle_fade[0]),
    CHOICE("two_sided", Field::truth, two_sided, truths,
           [](double value, Projector& p) { return truth(value, p.two_sided); }),
    CHOICE("wrap", Field::name, wrap, wraps, nullptr),
    PAIR("repeat_s", "repeat_t", "repeat", repeat, positive),
    CHOICE("mode", Field::name, mode, modes, nullptr),
    NUMBER("opacity", opacity, zero_to_one),
    NUMBER("priority", priority, any_number),
    {"object", "object", 0, Field::number, [](std::string_view f, Projector& p) { return object(parsed(f), p.object); },
     // Arrays of numbers cannot leave a field empty, so NaN stands for any object there.
     [](double value, Projector& p) { return std::isnan(value) ? std::string{} : object(value, p.object); },
     [](const Projector& p) { return number_held(p.object.value_or(0), any_number); },
     [](const Projector& p) { return p.object ? fmt::format("{}", *p.object) : std::string{}; }},
    {"cryptomatte", "cryptomatte", 0, Field::name,
     [](std::string_view f, Projector& p) {
         p.cryptomatte = f;
         return std::string{};
     },
     nullptr,
     [](const Projector& p) {
         const bool control = std::ranges::any_of(p.cryptomatte, [](unsigned char c) { return c < 0x20 || c == 0x7F; });
         return control ? std::string("must be a text without control characters") : std::string{};
     },
     [](const Projector& p) { return p.cryptomatte; }},
};

/// Keys of which one number may stand for every element.
constexpr std::string_view uniform[] = {"half_size", "falloff", "repeat"};

void check_together(const Projector& row, std::size_t textures, const Wrong& wrong) {
    if (row.texture >= textures)
        wrong({"texture"}, fmt::format("is {}; the layer has {} texture{}, counted from 0", row.texture, textures,
                                       textures == 1 ? "" : "s"));
    if (row.region[0] >= row.region[2] || row.region[1] >= row.region[3])
        wrong({"s0", "t0", "s1", "t1"}, "must have s0 below s1, and t0 below t1");
    if (row.angle_fade[0] > row.angle_fade[1])
        wrong({"angle_full", "angle_zero"}, "must be the angle that gets all, then a larger one that gets nothing");
    if (row.object && !row.cryptomatte.empty())
        wrong({"object", "cryptomatte"}, "cannot both be given; leave one empty");
    if (parallel(row.axis_x, row.axis_y))
        wrong({"axis_x_x", "axis_x_y", "axis_x_z", "axis_y_x", "axis_y_y", "axis_y_z"},
              "must be two axes, not parallel, nor zero");
}

}  // namespace

RowKind<Projector> decal_rows(std::size_t textures) {
    return {.name = "decal",
            .columns = columns,
            .required = 3,
            .uniform = uniform,
            .bytes = 1300,  // measured: a row, what kernels get of it, and the bins that it lies in
            .begin = [](Projector& row, std::uint32_t line) { row.line = line; },
            .together = [textures](const Projector& row, const Wrong& wrong) { check_together(row, textures, wrong); }};
}

}  // namespace wrinkle::scene
