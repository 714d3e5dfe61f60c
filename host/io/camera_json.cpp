#include "io/camera_json.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "base/names.h"
#include "io/camera_check.h"
#include "io/json_file.h"
#include "wrinkle/error.h"

namespace wrinkle::io {
namespace {

using nlohmann::json;

json parse(const std::filesystem::path& file) {
    return read_json_object(file, "a camera file", "{\"width\", \"height\", \"view\", \"proj\"}");
}

Mat4 matrix(const json& camera, const char* key, const std::filesystem::path& file) {
    const auto fail = [&](std::string_view found) {
        throw Error(fmt::format("{}: \"{}\" is {}; expected 4 rows of 4 numbers", file.string(), key, found));
    };
    if (!camera.contains(key)) fail("missing");
    const auto& rows = camera[key];
    if (!rows.is_array() || rows.size() != 4) fail(rows.is_array() ? fmt::format("{} rows", rows.size()) : "no matrix");
    Mat4 result{};
    for (std::size_t i = 0; i < 4; ++i) {
        if (!rows[i].is_array() || rows[i].size() != 4) fail(fmt::format("not 4 numbers in row {}", i));
        for (std::size_t j = 0; j < 4; ++j) {
            if (!rows[i][j].is_number()) fail(fmt::format("no number in row {}, column {}", i, j));
            result[i][j] = rows[i][j].get<double>();
        }
    }
    return result;
}

/// Width and height, when the file has them; one alone is an error. They need not be whole numbers, since a camera fits
/// every frame of the same aspect.
std::optional<std::array<double, 2>> sides(const json& camera, const std::filesystem::path& file) {
    if (!camera.contains("width") && !camera.contains("height")) return std::nullopt;
    const auto side = [&](const char* key) {
        if (!camera.contains(key) || !camera[key].is_number() || !(camera[key].get<double>() >= 1)) {
            throw Error(fmt::format("{}: \"{}\" is missing or not a number of pixels", file.string(), key));
        }
        return camera[key].get<double>();
    };
    return std::array{side("width"), side("height")};
}

void check_aspect(const json& camera, Size frame, const std::filesystem::path& file) {
    const auto found = sides(camera, file);
    if (!found) return;
    const auto [width, height] = *found;
    // A frame's sides are rounded to whole pixels: half a pixel of each is no other aspect.
    if (std::abs(width / height * frame.height - frame.width) <= 0.5 + 0.5 * frame.width / frame.height) return;
    throw Error(fmt::format("{}: the camera is for {}x{} and the frame is {}x{}: another aspect", file.string(), width,
                            height, frame.width, frame.height));
}

}  // namespace

Camera read_camera_json(const std::filesystem::path& file, Size frame_size) {
    const auto value = parse(file);
    const Camera camera = checked_camera({matrix(value, "view", file), matrix(value, "proj", file)}, file.string());
    check_aspect(value, frame_size, file);
    return camera;
}

std::optional<Size> camera_json_size(const std::filesystem::path& file) {
    const auto found = sides(parse(file), file);
    if (!found) return std::nullopt;
    constexpr double most = 1 << 24;
    const auto pixels = [&](double side) { return static_cast<std::uint32_t>(std::min(std::round(side), most)); };
    return Size{pixels((*found)[0]), pixels((*found)[1])};
}

}  // namespace wrinkle::io
