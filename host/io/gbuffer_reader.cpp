#include "io/gbuffer_reader.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "base/names.h"
#include "base/only_errors.h"
#include "io/band_reader.h"
#include "io/beauty_file.h"
#include "io/channel_names.h"
#include "io/frame_path.h"
#include "io/glance.h"
#include "io/image_open.h"
#include "io/image_parts.h"
#include "io/packed_normals.h"
#include "wrinkle/error.h"

namespace wrinkle {
namespace {

constexpr std::string_view file_channel = "channel:", bits_of_channel = "bits:";
const std::vector<std::string> normal_planes{"normal.x", "normal.y", "normal.z"};

RoleMap detect(const std::filesystem::path& file, std::span<const std::string> channels, const GBufferSource& source,
               const Metadata& header) {
    try {
        return detect_roles(channels, source, header_hints(header));
    } catch (const Error& error) { throw Error(fmt::format("{}: {}", file.string(), error.what())); }
}

/// Texture coordinates that grow downwards become such that grow upwards; so do their derivatives.
void turn_v(std::string_view plane, std::span<float> values) {
    if (plane == "uv.v")
        for (float& value : values) value = 1 - value;
    else if (plane == "duv_dx.v" || plane == "duv_dy.v" || plane.starts_with("dp_dv."))
        for (float& value : values) value = -value;
}

}  // namespace

struct GBufferReader::Impl {
    std::filesystem::path path;
    io::ImageParts image;
    std::vector<std::string> channels;
    std::map<std::string, const io::ChannelPlace*, std::less<>> places;
    RoleMap roles;
    bool packed_normals = false;
    std::optional<Mat4> view;  // that turns camera-space normals
    std::optional<io::ObjectStorage> objects;
    CryptomatteManifest cryptomatte;
    std::unique_ptr<io::BandReader> reader;
    std::unique_ptr<GBufferReader> beauty;  // another file, whose picture it is

    bool is_elsewhere(std::string_view plane) const { return beauty && plane.starts_with("beauty."); }

    const io::ChannelPlace* place(std::string_view plane) const {
        if (is_elsewhere(plane)) return beauty->impl_->place(plane);
        if (plane == "beauty.a") return alpha_of_beauty();
        auto channel = plane;
        if (plane.starts_with(file_channel)) {
            channel.remove_prefix(file_channel.size());
        } else if (plane.starts_with(bits_of_channel)) {
            channel.remove_prefix(bits_of_channel.size());
        } else {
            const auto mapped = roles.channel_of.find(plane);
            if (mapped == roles.channel_of.end()) return nullptr;
            channel = mapped->second;
        }
        const auto found = places.find(channel);
        return found == places.end() ? nullptr : found->second;
    }

    /// The picture's coverage: the alpha beside its colours.
    const io::ChannelPlace* alpha_of_beauty() const {
        const auto red = roles.channel_of.find("beauty.r");
        if (red == roles.channel_of.end()) return nullptr;
        const std::string layer = lower(red->second.substr(0, red->second.rfind('.') + 1));  // "" of a plain "R"
        for (const auto& [channel, found] : places)
            for (const char* name : {"a", "alpha"})
                if (lower(channel) == layer + name && !found->whole_numbers) return found;
        return nullptr;
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
        if (!plane.starts_with("crypto.id")) return;
        if (place.half)
            throw Error(
                fmt::format("{}: cryptomatte channel \"{}\" is 16-bit: its ids are lost; render cryptomattes as "
                            "32-bit float",
                            path.string(), place.name));
        if (!place.lossy.empty())
            throw Error(
                fmt::format("{}: cryptomatte channel \"{}\" is compressed by {}, which keeps some of its digits only: "
                            "its ids are lost; write the file with ZIP, ZIPS, RLE or PIZ",
                            path.string(), place.name, place.lossy));
    }

    std::vector<std::uint32_t> glance_rows() const { return io::glance_rows(image.parts, image.size.height); }
    void open(const GBufferSource& source);
    void take_beauty(const GBufferSource& source);
    bool sample_packed_normals(NormalKind kind) const;
    io::ObjectStorage sample_objects() const;
    void finish_normals(std::span<const std::string> planes, std::span<float* const> out, std::size_t count) const;
};

io::ObjectStorage GBufferReader::Impl::sample_objects() const {
    const auto* object = place("object");
    if (object == nullptr) return io::ObjectStorage::single;
    if (object->whole_numbers) return io::ObjectStorage::whole;
    std::vector<float> sample;
    for (const std::uint32_t row : glance_rows()) {
        sample.resize(sample.size() + image.size.width);
        const io::WantedChannel wanted{*object, sample.data() + sample.size() - image.size.width};
        reader->read(row, row + 1, {&wanted, 1});
    }
    return io::object_storage(sample);
}

bool GBufferReader::Impl::sample_packed_normals(NormalKind kind) const {
    if (kind == NormalKind::packed) return true;
    if (!roles.has_role("normal") || kind == NormalKind::sign) return false;
    const std::size_t width = image.size.width;
    std::vector<float> planes[3];
    for (const std::uint32_t row : glance_rows()) {  // the first one nearly always decides
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

void GBufferReader::Impl::open(const GBufferSource& source) {
    io::OpenImage opened(path);
    image = io::list_parts(opened.input(), path, {source.view, source.overscan});
    for (const auto& place : image.channels) {
        channels.push_back(place.name);
        places[place.name] = &place;
    }
    roles = detect(path, channels, source, image.metadata);
    reader = std::make_unique<io::BandReader>(std::move(opened), image);
    if (roles.cryptomatte_ranks > 0) cryptomatte = CryptomatteManifest(image.metadata, roles.cryptomatte_layer, path);
    packed_normals = sample_packed_normals(source.normals);
    if (!source.beauty_file.empty()) take_beauty(source);
}

void GBufferReader::Impl::take_beauty(const GBufferSource& source) {
    GBufferSource other{.file = source.beauty_file, .roles = {}, .view = source.view, .overscan = source.overscan};
    if (!source.beauty_layer.empty()) other.roles["beauty"] = source.beauty_layer;
    beauty = std::make_unique<GBufferReader>(source.beauty_file, other);
    if (source.beauty_layer.empty()) io::require_one_beauty(beauty->channels(), source.beauty_file.string());
    const FrameWindow& theirs = beauty->window();
    if (beauty->size() != image.size || theirs.x != image.window.x || theirs.y != image.window.y)
        throw Error(fmt::format("{}: the beauty has {}x{} pixels; {} has {}x{}", source.beauty_file.string(),
                                beauty->size().width, beauty->size().height, path.string(), image.size.width,
                                image.size.height));
    for (const char* plane : {"beauty.r", "beauty.g", "beauty.b"}) {
        if (!beauty->has_plane(plane)) beauty->impl_->fail_missing(plane);
        roles.channel_of[plane] = beauty->roles().channel_of.find(plane)->second;
    }
}

GBufferReader::GBufferReader(std::filesystem::path file, const GBufferSource& source)
    : impl_(std::make_unique<Impl>()) {
    impl_->path = std::move(file);
    only_errors(impl_->path.c_str(), [&] { impl_->open(source); });
}

GBufferReader open_gbuffer(const GBufferSource& source, int frame) {
    GBufferSource of_frame = source;
    if (!source.beauty_file.empty()) of_frame.beauty_file = frame_path(source.beauty_file, frame);
    return GBufferReader(frame_path(source.file, frame), of_frame);
}

GBufferReader::~GBufferReader() = default;
GBufferReader::GBufferReader(GBufferReader&&) noexcept = default;
GBufferReader& GBufferReader::operator=(GBufferReader&&) noexcept = default;

const std::filesystem::path& GBufferReader::path() const { return impl_->path; }
Size GBufferReader::size() const { return impl_->image.size; }
const FrameWindow& GBufferReader::window() const { return impl_->image.window; }
int GBufferReader::parts() const { return static_cast<int>(impl_->image.parts.size()); }
const std::vector<std::string>& GBufferReader::channels() const { return impl_->channels; }
const RoleMap& GBufferReader::roles() const { return impl_->roles; }
bool GBufferReader::packed_normals() const { return impl_->packed_normals; }
const std::vector<std::string>& GBufferReader::views() const { return impl_->image.views; }
const std::string& GBufferReader::view() const { return impl_->image.view; }
bool GBufferReader::normals_are_in_world_space() const {
    return !impl_->roles.camera_space_normals || impl_->view.has_value();
}
void GBufferReader::turn_normals(const Mat4& view) { impl_->view = view; }
double GBufferReader::pixel_aspect() const {
    const double aspect = metadata().number("PixelAspectRatio").value_or(1);
    return aspect > 0 && std::isfinite(aspect) ? aspect : 1;
}
ChannelType GBufferReader::channel_type(std::string_view channel) const {
    const auto& place = *impl_->places.at(std::string(channel));
    return place.whole_numbers ? ChannelType::whole : place.half ? ChannelType::half : ChannelType::single;
}
std::uint32_t GBufferReader::block_rows() const {
    const auto& parts = impl_->image.parts;
    return static_cast<std::uint32_t>(std::ranges::max_element(parts, {}, &io::Part::block_rows)->block_rows);
}
std::uint32_t GBufferReader::blocks_at_a_glance(std::uint32_t most) const {
    return io::blocks_at_a_glance(impl_->image.parts, most);
}
std::vector<std::uint32_t> GBufferReader::glance_rows() const { return impl_->glance_rows(); }
io::ObjectStorage GBufferReader::object_storage() const {
    if (!impl_->objects) impl_->objects = impl_->sample_objects();
    return *impl_->objects;
}
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
    std::vector<io::WantedChannel> wanted, elsewhere;
    for (std::size_t i = 0; i < planes.size(); ++i)
        (impl_->is_elsewhere(planes[i]) ? elsewhere : wanted)
            .push_back(
                {*impl_->place(planes[i]), out[i], planes[i] == "object" || planes[i].starts_with(bits_of_channel)});
    impl_->reader->read(row_begin, row_end, wanted);
    if (!elsewhere.empty()) impl_->beauty->impl_->reader->read(row_begin, row_end, elsewhere);
    const std::size_t count = std::size_t{row_end - row_begin} * size().width;
    impl_->finish_normals(planes, out, count);
    for (std::size_t i = 0; i < planes.size(); ++i) {
        const std::span<float> values(out[i], count);
        if (planes[i] == "object") io::label_objects(values, object_storage());
        if (impl_->roles.v_down) turn_v(planes[i], values);
    }
}

void GBufferReader::Impl::finish_normals(std::span<const std::string> planes, std::span<float* const> out,
                                         std::size_t count) const {
    const bool turned = roles.camera_space_normals && view;
    if (!packed_normals && !turned) return;
    std::span<float> axes[3];
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto found = std::ranges::find(planes, normal_planes[axis]);
        if (found != planes.end()) axes[axis] = {out[static_cast<std::size_t>(found - planes.begin())], count};
    }
    const auto given = std::ranges::count_if(axes, [](const auto& axis) { return axis.data() != nullptr; });
    if (given != 0 && given != 3) {
        throw Error(fmt::format("{}: packed normals can only be read as x, y and z together", path.string()));
    }
    if (given == 3 && packed_normals) io::unpack_normals(axes[0], axes[1], axes[2]);
    if (given == 3 && turned) io::turn_normals(*view, axes[0], axes[1], axes[2]);
}

}  // namespace wrinkle
