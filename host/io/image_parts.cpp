#include "io/image_parts.h"

#include <fmt/format.h>
#include <algorithm>
#include <set>

#include "io/metadata_data.h"
#include "wrinkle/error.h"

namespace wrinkle::io {
namespace {

/// Some writers of multi-part files put the layer's name into the part's: part "N" has channels X, Y, Z, and X becomes
/// "N.X" here. R, G, B and A of the first part are the picture and keep their names.
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
    constexpr int longest_side = 1 << 17;  // a larger frame means a damaged header; its rows would not fit into memory
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

/// OpenImageIO renames V-Ray's cameraTransform (camera to world) to "worldtocamera" when it reads, and would write it
/// as worldToCamera. It gets the name back that it has in the file.
void add_attributes(OIIO::ParamValueList& list, const OIIO::ParamValueList& found) {
    for (const auto& attribute : found) {
        const auto name = attribute.name() == "worldtocamera" ? OIIO::ustring("cameraTransform") : attribute.name();
        if (list.contains(name)) continue;  // the first part's value stays
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
    input.geterror();  // forgets that the loop sought a part beyond the last
    if (result.channels.empty()) {
        throw Error(fmt::format(
            "{}: {}", file.string(),
            deep ? "a deep image; flatten it first, a G-buffer has one sample per pixel" : "has no channels"));
    }
    return result;
}

}  // namespace wrinkle::io
