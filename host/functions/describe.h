#pragma once

#include <utility>

#include "functions/tables.h"

/// Short names for the rows of the tables.
namespace wrinkle::describe {

inline Parameter number(std::string name, std::string unit, std::string meaning) {
    return {std::move(name), Shape::number, std::move(unit), std::move(meaning)};
}
inline Parameter pair(std::string name, std::string unit, std::string meaning) {
    return {std::move(name), Shape::pair, std::move(unit), std::move(meaning)};
}
inline Parameter vector(std::string name, std::string unit, std::string meaning) {
    return {std::move(name), Shape::vector, std::move(unit), std::move(meaning)};
}
inline Parameter direction(std::string name, std::string meaning) {
    return {std::move(name), Shape::vector, "unit, world", std::move(meaning), true};
}
inline Result result(Parameter parameter, std::vector<ErrorMeasure> measures) {
    return {std::move(parameter), std::move(measures)};
}

/// For functions that take the normal as it is.
inline const Parameter given_normal = vector("n", "about unit, world", "base normal, towards the viewer");
inline const Parameter base_normal = direction("n", "base normal, towards the viewer");
inline const Parameter dp_dx = vector("dp_dx", "metres per pixel, world", "change of the position to the right");
inline const Parameter dp_dy = vector("dp_dy", "metres per pixel, world", "change of the position downwards");
inline const Parameter dst_dx = pair("dst_dx", "per pixel", "change of the texture coordinates to the right");
inline const Parameter dst_dy = pair("dst_dy", "per pixel", "change of the texture coordinates downwards");
inline const Parameter surface_gradient = vector("g", "metres per metre, world", "surface gradient");

}  // namespace wrinkle::describe
