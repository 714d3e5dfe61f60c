#include "io/info.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <limits>

#include "io/frame_path.h"
#include "io/gbuffer_reader.h"
#include "wrinkle/error.h"

namespace wrinkle {
namespace {

constexpr std::uint32_t band_rows = 128;
constexpr double background_depth = 1e9;

/// The planes whose range is reported. Of a cryptomatte that is the coverage: ids are bit patterns, not numbers.
std::vector<std::string> measured_planes(const Role& role) {
    if (role.name == "cryptomatte") return {"crypto.coverage0"};
    return role.planes;
}

bool is_valid(const std::string& role, std::span<const float> components) {
    if (!std::ranges::all_of(components, [](float c) { return std::isfinite(c); })) return false;
    if (role == "normal") return std::ranges::any_of(components, [](float c) { return c != 0; });
    if (role == "depth") return components[0] > 0 && components[0] < background_depth;
    return true;
}

std::vector<RoleStats> measure(const GBufferReader& reader) {
    std::vector<RoleStats> stats;
    std::vector<std::string> planes;
    std::vector<std::size_t> counts;  // how many planes each role has
    for (const auto& role : gbuffer_roles()) {
        if (!reader.has_role(role.name)) continue;
        const auto measured = measured_planes(role);
        RoleStats entry{
            role.name, {}, std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity(), 0};
        for (const auto& plane : role.planes) entry.channels.push_back(reader.roles().channel_of.find(plane)->second);
        stats.push_back(std::move(entry));
        planes.insert(planes.end(), measured.begin(), measured.end());
        counts.push_back(measured.size());
    }
    const auto [width, height] = reader.size();
    std::vector<std::vector<float>> values(planes.size(), std::vector<float>(std::size_t{band_rows} * width));
    std::vector<float*> out;
    for (auto& plane : values) out.push_back(plane.data());
    for (std::uint32_t row = 0; row < height; row += band_rows) {
        const auto end = std::min(row + band_rows, height);
        reader.read_rows(row, end, planes, out);
        std::size_t first = 0;
        for (std::size_t r = 0; r < stats.size(); first += counts[r++]) {
            float components[3];
            for (std::size_t i = 0; i < std::size_t{end - row} * width; ++i) {
                for (std::size_t c = 0; c < counts[r]; ++c) components[c] = values[first + c][i];
                const std::span<const float> pixel(components, counts[r]);
                if (!is_valid(stats[r].role, pixel)) {
                    ++stats[r].invalid;
                    continue;
                }
                const auto [low, high] = std::ranges::minmax(pixel);
                stats[r].min = std::min<double>(stats[r].min, low);
                stats[r].max = std::max<double>(stats[r].max, high);
            }
        }
    }
    for (auto& entry : stats) {
        if (entry.min > entry.max) entry.min = entry.max = 0;
    }
    return stats;
}

/// Looks for a camera when none was named: in a file beside the frame, else in the frame's header.
void find_camera(GBufferInfo& info, const GBufferReader& reader) {
    CameraSource source;
    for (auto beside : {info.file.string() + ".camera.json",
                        std::filesystem::path(info.file).replace_extension().string() + ".camera.json"}) {
        std::error_code code;
        if (std::filesystem::exists(beside, code)) {
            source.file = beside;
            break;
        }
    }
    source.exr = source.file.empty();
    try {
        info.camera = read_frame_camera(source, reader);
    } catch (const Error& error) { info.camera_problem = error.what(); }
}

}  // namespace

GBufferInfo gather_info(const GBufferSource& source, const std::optional<CameraSource>& camera, int frame) {
    GBufferInfo info;
    info.file = frame_path(source.file, frame);
    const GBufferReader reader(info.file, source);
    info.roles = reader.roles();
    info.size = reader.size();
    info.parts = reader.parts();
    info.channels = reader.channels();
    info.packed_normals = reader.packed_normals();
    info.stats = measure(reader);
    info.cryptomatte_names = reader.cryptomatte().names();
    if (camera) {
        info.camera = read_frame_camera(*camera, reader, frame);
    } else {
        find_camera(info, reader);
    }
    return info;
}

}  // namespace wrinkle
