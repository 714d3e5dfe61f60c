#pragma once

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <string_view>

#include "base/names.h"
#include "scene/row_kind.h"
#include "scene/table.h"

/// What columns of tables of any kind of row are made of. The macros at the end are for a file that says what `Row` is.
namespace wrinkle::scene {

constexpr Range degrees{.low = 0, .high = 180};
constexpr double kDegree = std::numbers::pi / 180;

inline std::string wanted(const Range& range) {
    if (range.low == 0 && range.high == 1) return "a number from 0 to 1";
    if (range.low == 0 && range.high == 180) return "degrees from 0 to 180";
    if (range.low == 0) return range.low_is_allowed ? "0 or a positive number" : "a positive number";
    return "a number within the range of 32-bit floats";
}

inline std::string number(double value, double& out, const Range& range) {
    const bool above = range.low_is_allowed ? value >= range.low : value > range.low;
    if (!above || !(value <= range.high)) return "must be " + wanted(range);
    if (range.low == 0 && !range.low_is_allowed && value < std::numeric_limits<float>::min())
        return "must be at least 1.2e-38, the smallest 32-bit float";
    out = value;
    return {};
}

/// The number that a field holds; NaN, which is outside of every range, where the field is not a number as a whole.
inline double parsed(std::string_view field) {
    if (field.front() == '+') field.remove_prefix(1);
    double value = 0;
    const auto [end, failure] = std::from_chars(field.data(), field.data() + field.size(), value);
    const bool sound = failure == std::errc() && end == field.data() + field.size();
    return sound ? value : std::numeric_limits<double>::quiet_NaN();
}

template <std::size_t N>
inline std::string name(std::string_view field, const char* const (&names)[N], int& out) {
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
inline std::string choice(std::string_view field, const char* const (&names)[N], E& out) {
    int index = 0;
    std::string problem = name(field, names, index);
    if (problem.empty()) out = static_cast<E>(index);
    return problem;
}

inline std::string number_held(double value, const Range& range) { return number(value, value, range); }

template <class E, std::size_t N>
inline std::string choice_held(E value, const char* const (&names)[N]) {
    int index = static_cast<int>(value);
    return index >= 0 && index < static_cast<int>(N) ? std::string{} : name("", names, index);
}

}  // namespace wrinkle::scene

/// A column of numbers in RANGE; rows that were made in code may have any in HELD.
#define RANGED(NAME, KEY, SIZE, MEMBER, RANGE, HELD)                                                                   \
    {                                                                                                                  \
        NAME, KEY, SIZE, Field::number, [](std::string_view f, Row& p) { return number(parsed(f), p.MEMBER, RANGE); }, \
            [](double value, Row& p) { return number(value, p.MEMBER, RANGE); },                                       \
            [](const Row& p) { return number_held(p.MEMBER, HELD); },                                                  \
            [](const Row& p) { return fmt::format("{}", p.MEMBER); }                                                   \
    }
#define NUMBER(NAME, MEMBER, RANGE) RANGED(NAME, NAME, 0, MEMBER, RANGE, RANGE)
#define VECTOR(X, Y, Z, KEY, MEMBER, RANGE, HELD)                                         \
    RANGED(X, KEY, 3, MEMBER[0], RANGE, HELD), RANGED(Y, KEY, 3, MEMBER[1], RANGE, HELD), \
        RANGED(Z, KEY, 3, MEMBER[2], RANGE, HELD)
#define CHOICE(NAME, FIELD, MEMBER, NAMES, TAKE)                                                           \
    {                                                                                                      \
        NAME, NAME, 0, FIELD, [](std::string_view f, Row& p) { return choice(f, NAMES, p.MEMBER); }, TAKE, \
            [](const Row& p) { return choice_held(p.MEMBER, NAMES); },                                     \
            [](const Row& p) { return std::string(NAMES[static_cast<int>(p.MEMBER)]); }                    \
    }
