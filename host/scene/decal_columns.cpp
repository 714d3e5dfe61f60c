#include "scene/decal_columns.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>

#include "base/names.h"
#include "scene/table.h"

namespace wrinkle::scene {
namespace {

constexpr Range degrees{.low = 0, .high = 180};
constexpr double kDegree = std::numbers::pi / 180;

std::string wanted(const Range& range) {
    if (range.low == 0 && range.high == 1) return "a number from 0 to 1";
    if (range.low == 0 && range.high == 180) return "degrees from 0 to 180";
    if (range.low == 0) return range.low_is_allowed ? "0 or a positive number" : "a positive number";
    return "a number within the range of 32-bit floats";
}

std::string number(double value, double& out, const Range& range) {
    const bool above = range.low_is_allowed ? value >= range.low : value > range.low;
    if (!above || !(value <= range.high)) return "must be " + wanted(range);
    if (range.low == 0 && !range.low_is_allowed && value < std::numeric_limits<float>::min())
        return "must be at least 1.2e-38, the smallest 32-bit float";
    out = value;
    return {};
}

/// The number that a field holds; NaN, which is outside of every range, where the field is not a number as a whole.
double parsed(std::string_view field) {
    if (field.front() == '+') field.remove_prefix(1);
    double value = 0;
    const auto [end, failure] = std::from_chars(field.data(), field.data() + field.size(), value);
    const bool sound = failure == std::errc() && end == field.data() + field.size();
    return sound ? value : std::numeric_limits<double>::quiet_NaN();
}

template <std::size_t N>
std::string name(std::string_view field, const char* const (&names)[N], int& out) {
    std::string all;
    for (std::size_t i = 0; i < N; ++i) {
        if (field == names[i]) {
            out = static_cast<int>(i);
            return {};
        }
        all += (i > 0 ? ", " : "") + quote(names[i]);
    }
    return "must be one of " + all;
}

template <class E, std::size_t N>
std::string choice(std::string_view field, const char* const (&names)[N], E& out) {
    int index = 0;
    std::string problem = name(field, names, index);
    if (problem.empty()) out = static_cast<E>(index);
    return problem;
}

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

std::string number_held(double value, const Range& range) { return number(value, value, range); }
std::string any_held(std::uint32_t) { return {}; }

template <class E, std::size_t N>
std::string choice_held(E value, const char* const (&names)[N]) {
    int index = static_cast<int>(value);
    return index >= 0 && index < static_cast<int>(N) ? std::string{} : name("", names, index);
}

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
/// A column of numbers in RANGE; rows that were made in code may have any in HELD.
#define RANGED(NAME, KEY, SIZE, MEMBER, RANGE, HELD)                                             \
    {                                                                                            \
        NAME, KEY, SIZE, Field::number,                                                          \
            [](std::string_view f, Projector& p) { return number(parsed(f), p.MEMBER, RANGE); }, \
            [](double value, Projector& p) { return number(value, p.MEMBER, RANGE); },           \
            [](const Projector& p) { return number_held(p.MEMBER, HELD); },                      \
            [](const Projector& p) { return fmt::format("{}", p.MEMBER); }                       \
    }
#define NUMBER(NAME, MEMBER, RANGE) RANGED(NAME, NAME, 0, MEMBER, RANGE, RANGE)
#define PAIR(X, Y, KEY, MEMBER, RANGE) \
    RANGED(X, KEY, 2, MEMBER[0], RANGE, RANGE), RANGED(Y, KEY, 2, MEMBER[1], RANGE, RANGE)
#define VECTOR(X, Y, Z, KEY, MEMBER, RANGE, HELD)                                         \
    RANGED(X, KEY, 3, MEMBER[0], RANGE, HELD), RANGED(Y, KEY, 3, MEMBER[1], RANGE, HELD), \
        RANGED(Z, KEY, 3, MEMBER[2], RANGE, HELD)
#define CHOICE(NAME, FIELD, MEMBER, NAMES, TAKE)                                                                 \
    {                                                                                                            \
        NAME, NAME, 0, FIELD, [](std::string_view f, Projector& p) { return choice(f, NAMES, p.MEMBER); }, TAKE, \
            [](const Projector& p) { return choice_held(p.MEMBER, NAMES); },                                     \
            [](const Projector& p) { return std::string(NAMES[static_cast<int>(p.MEMBER)]); }                    \
    }
#define ANGLE(NAME, MEMBER) CHECKED(NAME, "angle_fade", 2, MEMBER, angle, cosine, angle_text(MEMBER))

// The columns of the position come first: they are the ones that have to be there.
constexpr DecalColumn columns[] = {
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

}  // namespace

std::span<const DecalColumn> decal_columns() { return columns; }

}  // namespace wrinkle::scene
