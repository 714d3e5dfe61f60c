#include "wrinkle/resources.h"

#include <fmt/format.h>

#include <bit>
#include <cmath>

#include "base/imath.h"
#include "io/cryptomatte.h"
#include "io/object_ids.h"
#include "resources/frame_constants.h"
#include "wrinkle/error.h"

namespace wrinkle {

namespace {

template <class Struct>
std::vector<double> numbers_in(const Struct& from) {
    const auto numbers = std::bit_cast<std::array<double, sizeof(Struct) / sizeof(double)>>(from);
    return {numbers.begin(), numbers.end()};
}

void check_matrix(const char* name, const Mat4& matrix) {
    for (std::size_t i = 0; i < 4; ++i)
        for (std::size_t k = 0; k < 4; ++k)
            if (!std::isfinite(matrix[i][k]))
                throw Error(fmt::format("camera: {} holds {} in row {}, column {}; expected finite numbers", name,
                                        matrix[i][k], i + 1, k + 1));
}

void check_numbers(const char* name, std::span<const double> numbers) {
    for (const double number : numbers)
        if (!std::isfinite(number))
            throw Error(fmt::format("projector: {} holds {}; expected finite numbers", name, number));
}

void check_axes(const Projector& row) {
    if (parallel(to_imath(row.axis_x), to_imath(row.axis_y)))
        throw Error("projector: axis_x and axis_y are zero or parallel; expected two directions to project along");
}

std::uint32_t object_hash(const std::string& name) {
    return name.starts_with('#') ? CryptomatteManifest().id(name) : cryptomatte_hash(name);
}

}  // namespace

Vec3 eye_of(const Camera& camera) {
    check_matrix("view", camera.view);
    const Mat4 to_world = inverse(camera.view);
    return {to_world[0][3], to_world[1][3], to_world[2][3]};
}

std::vector<double> camera_numbers(const Camera& camera, Size size) {
    if (size.width == 0 || size.height == 0)
        throw Error(fmt::format("camera: the frame is {} x {} pixels; expected one at least", size.width, size.height));
    check_matrix("view", camera.view);
    check_matrix("proj", camera.proj);
    return numbers_in(camera_constants(camera, size));
}

std::vector<double> projector_numbers(const Projector& row, const ProjectedImage& image, const Vec3& eye,
                                      double scale) {
    check_numbers("center", row.center);
    check_numbers("axis_x", row.axis_x);
    check_numbers("axis_y", row.axis_y);
    check_numbers("half_size", row.half_size);
    check_numbers("falloff", row.falloff);
    check_numbers("angle_fade", row.angle_fade);
    check_numbers("repeat", row.repeat);
    check_numbers("scale", std::array{scale, row.scale});
    check_numbers("opacity", std::array{row.opacity});
    check_numbers("eye", eye);
    check_axes(row);
    wr_projector out = projector_constants(row, image, scale, eye);
    if (row.object) {
        check_numbers("object", std::array{*row.object});
        out.mask = 1;
        out.object = io::object_label(*row.object);
    } else if (!row.cryptomatte.empty()) {
        const std::uint32_t hash = object_hash(row.cryptomatte);
        out.mask = 2;
        out.object = hash >> 16;
        out.object_low = hash & 0xffff;
    }
    return numbers_in(out);
}

}  // namespace wrinkle
