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
#include "io/front_objects.h"
#include "io/glance.h"
#include "io/image_open.h"
#include "io/image_parts.h"
#include "io/packed_normals.h"
#include "io/plane_errors.h"
#include "io/turn_v.h"
#include "io/vector_planes.h"
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

}  // namespace

struct GBufferReader::Impl {
    std::filesystem::path path;
    io::ImageParts image;
    std::vector<std::string> channels, beauty_channels;
    std::map<std::string, const io::ChannelPlace*, std::less<>> places;
    RoleMap roles;
    bool packed_normals = false;
    std::optional<Mat4> view;  // that turns camera-space normals
    std::optional<io::ObjectStorage> objects;
    CryptomatteManifest cryptomatte;
    std::optional<io::FrontObjects> fronts;
    std::unique_ptr<io::BandReader> reader;
    std::unique_ptr<GBufferReader> beauty;  // another file, whose picture it is
    std::uint32_t beauty_scale = 1;
    std::map<std::string, io::VectorPlanes, std::less<>> vectors;
    bool overscan = false;

    bool is_elsewhere(std::string_view plane) const {
        return beauty && (plane.starts_with("beauty.") ||
                          (plane.starts_with(file_channel) && !places.contains(plane.substr(file_channel.size()))));
    }
    const io::VectorPlanes* vectors_of(std::string_view plane) const {
        const auto found = vectors.find(plane.substr(0, plane.rfind('.')));
        return found == vectors.end() ? nullptr : &found->second;
    }
    io::BandReader& reader_of(std::string_view plane) const {
        if (is_elsewhere(plane)) return *beauty->impl_->reader;
        const io::VectorPlanes* const added = vectors_of(plane);
        return added && added->reader() ? *added->reader() : *reader;
    }

    const io::ChannelPlace* place(std::string_view plane) const {
        if (is_elsewhere(plane)) return beauty->impl_->place(plane);
        if (const io::VectorPlanes* const added = vectors_of(plane))
            return &added->place(static_cast<std::size_t>(plane.back() - 'x'));
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
        for (const auto& [channel, found] : places)
            if (io::is_alpha_beside(channel, red->second) && !found->whole_numbers) return found;
        return nullptr;
    }

    std::vector<std::uint32_t> glance_rows() const { return io::glance_rows(image.parts, image.size.height); }
    void open(const GBufferSource& source);
    void take_beauty(const GBufferSource& source);
    bool sample_packed_normals(NormalKind kind) const;
    io::ObjectStorage sample_objects() const;
    void finish_normals(std::span<const std::string> planes, std::span<float* const> out, std::size_t count) const;
    void finish_vectors(std::span<const std::string> planes, std::span<float* const> out, std::size_t count) const;
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
    const std::array<io::ChannelPlace, 3> axes{*place(normal_planes[0]), *place(normal_planes[1]),
                                               *place(normal_planes[2])};
    return io::are_packed(*reader, axes, glance_rows(), image.size.width);
}

void GBufferReader::Impl::open(const GBufferSource& source) {
    io::OpenImage opened(path);
    overscan = source.overscan;
    image = io::list_parts(opened.input(), path, {source.view, source.overscan});
    for (const auto& place : image.channels) {
        channels.push_back(place.name);
        places[place.name] = &place;
    }
    roles = detect(path, channels, source, image.metadata);
    reader = std::make_unique<io::BandReader>(std::move(opened), image);
    if (roles.cryptomatte_ranks > 0) cryptomatte = CryptomatteManifest(image.metadata, roles.cryptomatte_layer, path);
    fronts.emplace(roles);
    packed_normals = sample_packed_normals(source.normals);
    if (!source.beauty_file.empty()) take_beauty(source);
}

void GBufferReader::Impl::take_beauty(const GBufferSource& source) {
    GBufferSource other{.file = source.beauty_file, .roles = {}, .view = source.view, .overscan = source.overscan};
    if (!source.beauty_layer.empty()) other.roles["beauty"] = source.beauty_layer;
    beauty = std::make_unique<GBufferReader>(source.beauty_file, other);
    if (source.beauty_layer.empty()) io::require_one_beauty(beauty->channels(), source.beauty_file.string());
    beauty_channels = beauty->channels();
    beauty_scale = io::beauty_scale(beauty->impl_->image, source.beauty_file, image, path);
    for (const char* plane : {"beauty.r", "beauty.g", "beauty.b"}) {
        if (!beauty->has_plane(plane)) io::fail_missing_plane(plane, beauty->channels(), beauty->path());
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
std::uint32_t GBufferReader::beauty_scale() const { return impl_->beauty_scale; }
const std::vector<std::string>& GBufferReader::beauty_channels() const { return impl_->beauty_channels; }
int GBufferReader::parts() const { return static_cast<int>(impl_->image.parts.size()); }
const std::vector<std::string>& GBufferReader::channels() const { return impl_->channels; }
const RoleMap& GBufferReader::roles() const { return impl_->roles; }
bool GBufferReader::packed_normals() const { return impl_->packed_normals; }
const std::vector<std::string>& GBufferReader::views() const { return impl_->image.views; }
const std::string& GBufferReader::view() const { return impl_->image.view; }
bool GBufferReader::normals_are_in_world_space() const {
    return !impl_->roles.camera_space_normals || impl_->view.has_value();
}
void GBufferReader::add_vectors(const std::string& name, const io::VectorSource& source) {
    only_errors(impl_->path.c_str(), [&] {
        impl_->vectors.insert_or_assign(name, io::VectorPlanes(source, impl_->image, impl_->path, impl_->overscan));
    });
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
bool GBufferReader::has_plane(std::string_view plane) const {
    return plane == io::kFrontPlane ? !impl_->fronts->needed().empty() : impl_->place(plane) != nullptr;
}

std::vector<std::string> GBufferReader::planes() const {
    std::vector<std::string> result;
    for (const auto& [plane, channel] : impl_->roles.channel_of) result.push_back(plane);
    for (const auto& [name, vectors] : impl_->vectors)
        for (const char* const axis : {".x", ".y", ".z"}) result.push_back(name + axis);
    if (has_plane(io::kFrontPlane)) result.emplace_back(io::kFrontPlane);
    return result;
}

void GBufferReader::require(std::span<const std::string> planes) const {
    for (const auto& plane : planes) {
        if (plane == io::kFrontPlane && has_plane(plane)) continue;  // it is made from others
        const auto* place = impl_->place(plane);
        if (place == nullptr)
            io::fail_missing_plane(plane, impl_->channels, impl_->path, impl_->beauty_channels,
                                   impl_->beauty ? impl_->beauty->path() : impl_->path);
        io::require_whole_ids(plane, *place, impl_->path);
    }
}

void GBufferReader::read_ahead() const {
    impl_->reader->read_ahead();
    if (impl_->beauty) impl_->beauty->read_ahead();
}

void GBufferReader::read_rows(std::uint32_t row_begin, std::uint32_t row_end, std::span<const std::string> planes,
                              std::span<float* const> out) const {
    if (row_begin > row_end || row_end > size().height || planes.size() != out.size())
        throw Error(fmt::format("{}: rows {} to {} of {} planes into {} were asked for; the frame has {} rows",
                                path().string(), row_begin, row_end, planes.size(), out.size(), size().height));
    const std::size_t count = std::size_t{row_end - row_begin} * size().width;
    if (has_plane(io::kFrontPlane) && std::ranges::find(planes, io::kFrontPlane) != planes.end())
        return impl_->fronts->read(planes, out, size().width, count, [&](const auto& names, const auto& into) {
            read_rows(row_begin, row_end, names, into);
        });
    require(planes);
    std::map<io::BandReader*, std::vector<io::WantedChannel>> wanted;
    for (std::size_t i = 0; i < planes.size(); ++i)
        wanted[&impl_->reader_of(planes[i])].push_back(
            {*impl_->place(planes[i]), out[i], planes[i] == "object" || planes[i].starts_with(bits_of_channel)});
    for (const auto& [reader, channels] : wanted) {
        const bool is_beauty = impl_->beauty && reader == impl_->beauty->impl_->reader.get();
        if (is_beauty && impl_->beauty_scale > 1)
            io::read_enlarged(*reader, row_begin, row_end, channels, size().width, impl_->beauty_scale);
        else
            reader->read(row_begin, row_end, channels);
    }
    impl_->finish_normals(planes, out, count);
    impl_->finish_vectors(planes, out, count);
    for (std::size_t i = 0; i < planes.size(); ++i) {
        const std::span<float> values(out[i], count);
        if (planes[i] == "object") io::label_objects(values, object_storage());
        if (impl_->roles.v_down) io::turn_v(planes[i], values);
    }
}

void GBufferReader::Impl::finish_normals(std::span<const std::string> planes, std::span<float* const> out,
                                         std::size_t count) const {
    const bool turned = roles.camera_space_normals && view;
    if (!packed_normals && !turned) return;
    const auto axes = io::vector_memory("normal", planes, out, count, path);
    if (!axes) return;
    const auto& [x, y, z] = *axes;
    if (packed_normals) io::unpack_normals(x, y, z);
    if (turned) io::turn_normals(*view, x, y, z);
}

void GBufferReader::Impl::finish_vectors(std::span<const std::string> planes, std::span<float* const> out,
                                         std::size_t count) const {
    for (const auto& [name, added] : vectors) {
        if (!added.camera_space()) continue;
        const auto axes = io::vector_memory(name, planes, out, count, path);
        if (!axes) continue;
        if (!view) throw Error(fmt::format("{}: {} is in camera space, and nobody has turned it", path.string(), name));
        const auto& [x, y, z] = *axes;
        io::turn_normals(*view, x, y, z);
    }
}

}  // namespace wrinkle
