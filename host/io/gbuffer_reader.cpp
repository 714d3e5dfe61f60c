#include "io/gbuffer_reader.h"

#include <fmt/format.h>
#include <algorithm>
#include <map>
#include <utility>

#include "base/names.h"
#include "io/band_reader.h"
#include "io/channel_names.h"
#include "io/image_open.h"
#include "io/image_parts.h"
#include "io/packed_normals.h"
#include "wrinkle/error.h"

namespace wrinkle {
namespace {

constexpr std::string_view file_channel = "channel:";
const std::vector<std::string> normal_planes{"normal.x", "normal.y", "normal.z"};

RoleMap detect(const std::filesystem::path& file, std::span<const std::string> channels, const GBufferSource& source) {
    try {
        auto roles = detect_roles(channels, source.roles);
        if (source.depth != DepthKind::automatic) roles.depth = source.depth;
        return roles;
    } catch (const Error& error) { throw Error(fmt::format("{}: {}", file.string(), error.what())); }
}

}  // namespace

struct GBufferReader::Impl {
    std::filesystem::path path;
    io::ImageParts image;
    std::vector<std::string> channels;
    std::map<std::string, const io::ChannelPlace*, std::less<>> places;
    RoleMap roles;
    bool packed_normals = false;
    CryptomatteManifest cryptomatte;
    std::unique_ptr<io::BandReader> reader;

    const io::ChannelPlace* place(std::string_view plane) const {
        auto channel = plane;
        if (plane.starts_with(file_channel)) {
            channel.remove_prefix(file_channel.size());
        } else {
            const auto mapped = roles.channel_of.find(plane);
            if (mapped == roles.channel_of.end()) return nullptr;
            channel = mapped->second;
        }
        const auto found = places.find(channel);
        return found == places.end() ? nullptr : found->second;
    }

    [[noreturn]] void fail_missing(std::string_view plane) const {
        const auto found = io::describe_channels(channels);
        if (plane.starts_with(file_channel)) {
            plane.remove_prefix(file_channel.size());
            throw Error(fmt::format("{}: no channel \"{}\"; nearest: \"{}\"; channels found: {}", path.string(), plane,
                                    nearest_name(plane, channels), found));
        }
        const auto role = plane.starts_with("crypto.") ? "cryptomatte" : plane.substr(0, plane.find('.'));
        throw Error(
            fmt::format("{}: no channels for the role \"{}\" (plane {}); channels found: {}; name its layer "
                        "with [gbuffer] roles = {{ {} = \"...\" }}",
                        path.string(), role, plane, found, role));
    }

    void check_precision(std::string_view plane, const io::ChannelPlace& place) const {
        if (!place.half || !plane.starts_with("crypto.id")) return;
        throw Error(
            fmt::format("{}: cryptomatte channel \"{}\" is 16-bit: its ids are lost; render cryptomattes as "
                        "32-bit float",
                        path.string(), place.name));
    }

    bool sample_packed_normals() const;
};

bool GBufferReader::Impl::sample_packed_normals() const {
    // Only Unreal is known to pack normals. Of other known writers, normals within [0,1] are a coincidence.
    if (!roles.has_role("normal") || (roles.writer != Writer::unreal && roles.writer != Writer::plain)) return false;
    const std::size_t width = image.size.width;
    std::vector<float> planes[3];
    for (const std::uint32_t tenth : {5u, 3u, 7u, 1u, 9u}) {  // the first row nearly always decides; each costs a block
        const auto row = tenth * image.size.height / 10;
        std::vector<io::WantedChannel> wanted;
        std::span<const float> read[3];
        for (std::size_t axis = 0; axis < 3; ++axis) {
            planes[axis].resize(planes[axis].size() + width);
            read[axis] = std::span(planes[axis]).last(width);
            wanted.push_back({*place(normal_planes[axis]), planes[axis].data() + planes[axis].size() - width});
        }
        try {
            reader->read(row, row + 1, wanted);
        } catch (const Error&) { return false; }  // left to the reading of all rows, which tells the first damaged one
        if (io::cannot_be_packed(read[0], read[1], read[2])) return false;
    }
    return io::looks_packed(planes[0], planes[1], planes[2]);
}

GBufferReader::GBufferReader(std::filesystem::path file, const GBufferSource& source)
    : impl_(std::make_unique<Impl>()) {
    io::OpenImage opened(file);
    impl_->path = std::move(file);
    impl_->image = io::list_parts(opened.input(), impl_->path);
    for (const auto& place : impl_->image.channels) {
        impl_->channels.push_back(place.name);
        impl_->places[place.name] = &place;
    }
    impl_->roles = detect(impl_->path, impl_->channels, source);
    impl_->reader = std::make_unique<io::BandReader>(std::move(opened), impl_->image.size, impl_->image.parts);
    if (impl_->roles.cryptomatte_ranks > 0) {
        impl_->cryptomatte = CryptomatteManifest(metadata(), impl_->roles.cryptomatte_layer, impl_->path);
    }
    impl_->packed_normals = impl_->sample_packed_normals();
}

GBufferReader::~GBufferReader() = default;
GBufferReader::GBufferReader(GBufferReader&&) noexcept = default;
GBufferReader& GBufferReader::operator=(GBufferReader&&) noexcept = default;

const std::filesystem::path& GBufferReader::path() const { return impl_->path; }
Size GBufferReader::size() const { return impl_->image.size; }
int GBufferReader::parts() const { return static_cast<int>(impl_->image.parts.size()); }
const std::vector<std::string>& GBufferReader::channels() const { return impl_->channels; }
const RoleMap& GBufferReader::roles() const { return impl_->roles; }
bool GBufferReader::packed_normals() const { return impl_->packed_normals; }
const Metadata& GBufferReader::metadata() const { return impl_->image.metadata; }
const CryptomatteManifest& GBufferReader::cryptomatte() const { return impl_->cryptomatte; }
bool GBufferReader::has_plane(std::string_view plane) const { return impl_->place(plane) != nullptr; }

std::vector<std::string> GBufferReader::planes() const {
    std::vector<std::string> result;
    for (const auto& [plane, channel] : impl_->roles.channel_of) result.push_back(plane);
    return result;
}

void GBufferReader::require(std::span<const std::string> planes) const {
    for (const auto& plane : planes) {
        const auto* place = impl_->place(plane);
        if (place == nullptr) impl_->fail_missing(plane);
        impl_->check_precision(plane, *place);
    }
}

void GBufferReader::read_rows(std::uint32_t row_begin, std::uint32_t row_end, std::span<const std::string> planes,
                              std::span<float* const> out) const {
    if (row_begin > row_end || row_end > size().height || planes.size() != out.size()) {
        throw Error(fmt::format("{}: rows {} to {} of {} planes into {} were asked for; the frame has {} rows",
                                path().string(), row_begin, row_end, planes.size(), out.size(), size().height));
    }
    require(planes);
    std::vector<io::WantedChannel> wanted;
    for (std::size_t i = 0; i < planes.size(); ++i) wanted.push_back({*impl_->place(planes[i]), out[i]});
    impl_->reader->read(row_begin, row_end, wanted);
    if (!impl_->packed_normals) return;

    const std::size_t count = std::size_t{row_end - row_begin} * size().width;
    std::span<float> axes[3];
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto found = std::ranges::find(planes, normal_planes[axis]);
        if (found != planes.end()) axes[axis] = {out[static_cast<std::size_t>(found - planes.begin())], count};
    }
    const auto given = std::ranges::count_if(axes, [](const auto& axis) { return !axis.empty(); });
    if (given != 0 && given != 3 && count != 0) {
        throw Error(fmt::format("{}: packed normals can only be read as x, y and z together", path().string()));
    }
    if (given == 3) io::unpack_normals(axes[0], axes[1], axes[2]);
}

}  // namespace wrinkle
