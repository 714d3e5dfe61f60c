#include "io/info.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <limits>

#include "io/background.h"
#include "io/frame_path.h"
#include "io/gbuffer_reader.h"
#include "io/light_pictures.h"
#include "wrinkle/error.h"

namespace wrinkle {
namespace {

/// The planes whose range is reported. Of a cryptomatte that is the coverage: ids are bit patterns, not numbers.
std::vector<std::string> measured_planes(const Role& role) {
    if (role.name == "cryptomatte") return {"crypto.coverage0"};
    return role.planes;
}

bool is_valid(const std::string& role, std::span<const float> components) {
    if (!std::ranges::all_of(components, [](float c) { return std::isfinite(c); })) return false;
    if (role == "normal") return std::ranges::any_of(components, [](float c) { return c != 0; });
    if (role == "depth") return components[0] > 0 && components[0] < kBackgroundDepth;
    return true;
}

/// The rows that are measured at a time: those that are compressed together.
std::uint32_t rows_of_a_band(const GBufferReader& reader) {
    constexpr std::uint32_t fewest = 16, most = 256;
    return std::clamp(reader.block_rows(), fewest, most);
}

/// The first rows of the bands that are measured: all of them, or as many, spread evenly, as take no longer than a
/// blink.
std::vector<std::uint32_t> measured_bands(const GBufferReader& reader) {
    const std::uint32_t height = reader.size().height, rows = rows_of_a_band(reader);
    const std::uint32_t bands = (height + rows - 1) / rows, blocks = (rows - 1) / reader.block_rows() + 1;
    const std::uint32_t wanted = std::max(reader.blocks_at_a_glance(bands * blocks) / blocks, 1u);
    std::vector<std::uint32_t> first;
    for (std::uint32_t i = 0; i < wanted; ++i) {
        const std::uint32_t middle = (2 * i + 1) * height / (2 * wanted);  // a row that others glance at
        first.push_back(wanted == bands ? i * rows : middle - middle % rows);
    }
    return first;
}

std::vector<RoleStats> measure(const GBufferReader& reader, std::uint64_t& measured) {
    std::vector<RoleStats> stats;
    std::vector<std::string> planes;
    std::vector<std::size_t> counts;  // how many planes each role has
    for (const auto& role : gbuffer_roles()) {
        if (!reader.has_role(role.name)) continue;
        const auto measured = measured_planes(role);
        RoleStats entry{
            role.name, {}, std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity(), 0, 0};
        for (const auto& plane : role.planes) entry.channels.push_back(reader.roles().channel_of.find(plane)->second);
        stats.push_back(std::move(entry));
        planes.insert(planes.end(), measured.begin(), measured.end());
        counts.push_back(measured.size());
    }
    const auto [width, height] = reader.size();
    const bool whole_objects = reader.object_storage() != io::ObjectStorage::single;
    const std::uint32_t band_rows = rows_of_a_band(reader);
    std::vector<std::vector<float>> values(planes.size(), std::vector<float>(std::size_t{band_rows} * width));
    std::vector<float*> out;
    for (auto& plane : values) out.push_back(plane.data());
    for (const std::uint32_t row : measured_bands(reader)) {
        const auto end = std::min(row + band_rows, height);
        reader.read_rows(row, end, planes, out);
        measured += std::uint64_t{end - row} * width;
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
                if (stats[r].role == "object") {
                    stats[r].mixed += whole_objects ? 0 : io::is_mixed_object(components[0]);
                    if (whole_objects) components[0] = static_cast<float>(io::object_number(components[0]));
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

}  // namespace

GBufferInfo gather_info(const GBufferSource& source, const std::optional<CameraSource>& camera, int frame) {
    GBufferInfo info;
    info.file = frame_path(source.file, frame);
    const GBufferReader reader = open_gbuffer(source, frame);
    info.roles = reader.roles();
    info.size = reader.size();
    info.parts = reader.parts();
    info.channels = reader.channels();
    for (const auto& channel : info.channels) info.types.push_back(reader.channel_type(channel));
    info.views = reader.views();
    info.view = reader.view();
    info.packed_normals = reader.packed_normals();
    info.uv_digits = io::uv_digits(reader);
    info.objects = reader.object_storage();
    info.stats = measure(reader, info.measured);
    info.cryptomatte_names = reader.cryptomatte().names();
    try {
        if (const std::string id = "crypto.id0"; reader.has_plane(id)) reader.require({&id, 1});
    } catch (const Error& error) { info.cryptomatte_problem = error.what(); }
    info.light_pictures = io::light_pictures(info.channels);
    const CameraSource wanted = camera.value_or(CameraSource{});
    try {
        info.camera = read_frame_camera(wanted, reader, frame);
        check_residual(*info.camera, wanted.max_residual, reader);
    } catch (const Error& error) {
        if (camera && !info.camera) throw;
        info.camera_problem = error.what();
    }
    return info;
}

}  // namespace wrinkle
