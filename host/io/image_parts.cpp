#include "io/image_parts.h"

#include <fmt/format.h>
#include <algorithm>
#include <set>

#include "io/metadata_data.h"
#include "wrinkle/error.h"

namespace wrinkle::io {
namespace {

/// Writers of multi-part files may leave the layer to the part's name: part "N", channels X, Y, Z. The first part's
/// plain picture keeps its names.
std::string full_name(const std::string& channel, const std::string& part_name, int part, bool several) {
    if (!several || part_name.empty() || channel.size() > 1) return channel;
    const bool picture = part == 0 && std::string_view("RGBA").find(channel) != std::string_view::npos;
    return picture ? channel : part_name + "." + channel;
}

Part geometry(const OIIO::ImageSpec& spec) {
    return {spec.x - spec.full_x,
            spec.y - spec.full_y,
            spec.width,
            spec.height,
            spec.x,
            spec.y,
            spec.tile_width > 0 ? spec.tile_height : 0};
}

void check(const OIIO::ImageSpec& spec, Size size, int part, const std::filesystem::path& file) {
    constexpr int longest_side = 1 << 17;  // beyond it a header is damaged, and memory would run out before rows do
    if (spec.full_width < 1 || spec.full_height < 1 || spec.full_width > longest_side ||
        spec.full_height > longest_side) {
        throw Error(fmt::format("{}: a frame of {}x{} pixels; the header is damaged", file.string(), spec.full_width,
                                spec.full_height));
    }
    if (spec.depth > 1) throw Error(fmt::format("{}: part {} is a volume, not a picture", file.string(), part));
    if (Size{static_cast<std::uint32_t>(spec.full_width), static_cast<std::uint32_t>(spec.full_height)} == size) return;
    throw Error(fmt::format("{}: part {} is {}x{} but the first part is {}x{}; a frame's parts must agree",
                            file.string(), part, spec.full_width, spec.full_height, size.width, size.height));
}

/// OpenImageIO calls V-Ray's cameraTransform, camera to world, "worldtocamera", and would write it as worldToCamera.
/// The file's own name comes back here.
void add_attributes(OIIO::ParamValueList& list, const OIIO::ParamValueList& found) {
    for (const auto& attribute : found) {
        const auto name = attribute.name() == "worldtocamera" ? OIIO::ustring("cameraTransform") : attribute.name();
        if (list.contains(name)) continue;  // the first part's value
        list.attribute(name, attribute.type(), attribute.nvalues(), attribute.data());
    }
}

}  // namespace

ImageParts list_parts(OIIO::ImageInput& input, const std::filesystem::path& file) {
    ImageParts result;
    std::set<std::string> taken;
    bool deep = false;
    const bool several = input.seek_subimage(1, 0);
    for (int part = 0; input.seek_subimage(part, 0); ++part) {
        const auto& spec = input.spec();
        result.parts.push_back(geometry(spec));
        if (spec.deep) {
            deep = true;
            continue;
        }
        if (result.channels.empty()) {
            result.size = {static_cast<std::uint32_t>(spec.full_width), static_cast<std::uint32_t>(spec.full_height)};
        }
        check(spec, result.size, part, file);
        const auto part_name = spec.get_string_attribute("oiio:subimagename").operator std::string();
        for (int i = 0; i < spec.nchannels; ++i) {
            const auto format = spec.channelformat(i);
            const auto& stored_name = spec.channelnames[static_cast<std::size_t>(i)];
            auto name = full_name(stored_name, part_name, part, several);
            if (taken.contains(name)) name = fmt::format("{}.{}", part_name.empty() ? "part" : part_name, name);
            if (!taken.insert(name).second) continue;
            result.channels.push_back(
                {name, stored_name, part, i, format == OIIO::TypeUInt32, format == OIIO::TypeHalf});
        }
        add_attributes(result.metadata.data().list, spec.extra_attribs);
    }
    input.geterror();  // seeking past the last part is no error of ours
    if (result.channels.empty()) {
        throw Error(fmt::format(
            "{}: {}", file.string(),
            deep ? "a deep image; flatten it first, a G-buffer has one sample per pixel" : "has no channels"));
    }
    return result;
}

}  // namespace wrinkle::io
