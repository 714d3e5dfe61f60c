#include "scene/decal_columns.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <numbers>

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

std::string number(std::string_view field, double& out, const Range& range) {
    if (field.front() == '+') field.remove_prefix(1);
    double value = 0;
    const auto [end, failure] = std::from_chars(field.data(), field.data() + field.size(), value);
    const bool sound = failure == std::errc() && end == field.data() + field.size() && std::isfinite(value);
    const bool above = range.low_is_allowed ? value >= range.low : value > range.low;
    if (!sound || !above || value > range.high) return "must be " + wanted(range);
    if (range.low == 0 && !range.low_is_allowed && value < std::numeric_limits<float>::min())
        return "must be at least 1.2e-38, the smallest 32-bit float";
    out = value;
    return {};
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

std::string angle(std::string_view field, double& cosine) {
    double value = 0;
    std::string problem = number(field, value, degrees);
    if (problem.empty()) cosine = std::cos(value * kDegree);
    return problem;
}
std::string angle_text(double cosine) { return fmt::format("{:.9g}", std::acos(cosine) / kDegree); }

std::string whole(std::string_view field, std::uint32_t& out) {
    const auto [end, failure] = std::from_chars(field.data(), field.data() + field.size(), out);
    const bool sound = failure == std::errc() && end == field.data() + field.size();
    return sound ? std::string{} : "must be a whole number, 0 or more";
}

#define NUMBER(NAME, MEMBER, RANGE)                                                        \
    {                                                                                      \
        NAME, [](std::string_view f, Projector& p) { return number(f, p.MEMBER, RANGE); }, \
            [](const Projector& p) { return fmt::format("{}", p.MEMBER); }                 \
    }
#define CHOICE(NAME, MEMBER, NAMES)                                                           \
    {                                                                                         \
        NAME, [](std::string_view f, Projector& p) { return choice(f, NAMES, p.MEMBER); },    \
            [](const Projector& p) { return std::string(NAMES[static_cast<int>(p.MEMBER)]); } \
    }

// The columns of the position come first: they are the ones that have to be there.
constexpr DecalColumn columns[] = {
    NUMBER("x", center[0], any_number),
    NUMBER("y", center[1], any_number),
    NUMBER("z", center[2], any_number),
    CHOICE("shape", shape, shapes),
    {"texture", [](std::string_view f, Projector& p) { return whole(f, p.texture); },
     [](const Projector& p) { return fmt::format("{}", p.texture); }},
    NUMBER("s0", region[0], zero_to_one),
    NUMBER("t0", region[1], zero_to_one),
    NUMBER("s1", region[2], zero_to_one),
    NUMBER("t1", region[3], zero_to_one),
    NUMBER("axis_x_x", axis_x[0], any_number),
    NUMBER("axis_x_y", axis_x[1], any_number),
    NUMBER("axis_x_z", axis_x[2], any_number),
    NUMBER("axis_y_x", axis_y[0], any_number),
    NUMBER("axis_y_y", axis_y[1], any_number),
    NUMBER("axis_y_z", axis_y[2], any_number),
    NUMBER("half_x", half_size[0], positive),
    NUMBER("half_y", half_size[1], positive),
    NUMBER("half_z", half_size[2], positive),
    NUMBER("scale", scale, any_number),
    NUMBER("falloff_x", falloff[0], zero_to_one),
    NUMBER("falloff_y", falloff[1], zero_to_one),
    NUMBER("falloff_z", falloff[2], zero_to_one),
    {"angle_full", [](std::string_view f, Projector& p) { return angle(f, p.angle_fade[1]); },
     [](const Projector& p) { return angle_text(p.angle_fade[1]); }},
    {"angle_zero", [](std::string_view f, Projector& p) { return angle(f, p.angle_fade[0]); },
     [](const Projector& p) { return angle_text(p.angle_fade[0]); }},
    CHOICE("two_sided", two_sided, truths),
    CHOICE("wrap", wrap, wraps),
    NUMBER("repeat_s", repeat[0], positive),
    NUMBER("repeat_t", repeat[1], positive),
    CHOICE("mode", mode, modes),
    NUMBER("opacity", opacity, zero_to_one),
    NUMBER("priority", priority, any_number),
    {"object",
     [](std::string_view f, Projector& p) {
         double value = 0;
         std::string problem = number(f, value, any_number);
         if (problem.empty()) p.object = value;
         return problem;
     },
     [](const Projector& p) { return p.object ? fmt::format("{}", *p.object) : std::string{}; }},
    {"cryptomatte",
     [](std::string_view f, Projector& p) {
         p.cryptomatte = f;
         return std::string{};
     },
     [](const Projector& p) { return p.cryptomatte; }},
};

}  // namespace

std::span<const DecalColumn> decal_columns() { return columns; }

}  // namespace wrinkle::scene
