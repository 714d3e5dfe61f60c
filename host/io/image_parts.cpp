#include "io/image_parts.h"

#include <fmt/format.h>
#include <algorithm>
#include <set>

#include "base/names.h"
#include "io/metadata_data.h"
#include "io/views.h"
#include "io/writer_names.h"
#include "wrinkle/error.h"

namespace wrinkle::io {
namespace {

/// Whether a name is that of a component, so that its layer has to come from elsewhere.
bool is_component(const std::string& channel) {
    static const std::set<std::string> words{"red", "green", "blue", "alpha"};
    return channel.size() == 1 || words.contains(lower(channel));
}

/// The channel's name with its layer's. Some writers of multi-part files put the layer's name into the part's: channels
/// X, Y, Z of part "N" mean N.X, N.Y, N.Z. The picture's channels keep their plain names; the picture is the part
/// called rgba or rgb, or the first part unless its name is that of another layer ("N" with R, G, B).
std::string full_name(const std::string& channel, const std::string& layer, bool first) {
    if (layer.empty() || !is_component(channel)) return channel;
    const auto plain = plain_layer_name(layer.substr(layer.rfind('.') + 1));
    const auto role = role_of_layer(plain);
    const bool picture = plain == "rgba" || plain == "rgb" || (first && (role.empty() || role == "beauty"));
    return picture ? channel : layer + "." + channel;
}

/// Rows that are compressed together.
int block_rows(const OIIO::ImageSpec& spec) {
    if (spec.tile_width > 0) return spec.tile_height;
    const std::string compression{spec.get_string_attribute("compression")};
    if (compression == "zip" || compression == "pxr24") return 16;
    if (compression.starts_with("dwab")) return 256;
    if (compression == "piz" || compression.starts_with("b44") || compression.starts_with("dwaa")) return 32;
    return 1;
}

Part geometry(const OIIO::ImageSpec& spec) {
    const int rows = block_rows(spec);
    return {spec.x - spec.full_x,
            spec.y - spec.full_y,
            spec.width,
            spec.height,
            spec.x,
            spec.y,
            spec.nchannels,
            spec.tile_width > 0 ? spec.tile_height : 0,
            rows,
            static_cast<double>(spec.pixel_bytes(true)) * spec.width * rows};
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

/// The name of a compression that keeps only some digits of 32-bit floats.
std::string lossy_compression(const OIIO::ImageSpec& spec) {
    const std::string name{spec.get_string_attribute("compression")};
    return name == "pxr24" || name.starts_with("dwa") ? name.substr(0, 5) : "";
}

}  // namespace

ImageParts list_parts(OIIO::ImageInput& input, const std::filesystem::path& file, const FrameExtent& extent) {
    std::vector<OIIO::ImageSpec> specs;
    for (int part = 0; input.seek_subimage(part, 0); ++part) specs.push_back(input.spec());
    input.geterror();  // forgets that the loop sought a part beyond the last
    const Views views = find_views(specs, extent.view, file);
    ImageParts result;
    result.views = views.names;
    result.view = views.chosen;
    std::set<std::string> taken;
    bool deep = false;
    Size display;
    int left = 0, top = 0, right = 0, bottom = 0;  // of the frame, seen from the display window's first pixel
    for (std::size_t p = 0; p < specs.size(); ++p) {
        const auto& spec = specs[p];
        const int part = static_cast<int>(p);
        result.parts.push_back(geometry(spec));
        if (spec.deep) {
            deep = true;
            continue;
        }
        const std::string part_name = spec.get_string_attribute("oiio:subimagename");
        const auto layer = specs.size() > 1 ? views.without_view(p, part_name) : "";
        bool of_view = spec.nchannels == 0;
        for (int i = 0; i < spec.nchannels; ++i) {
            const auto format = spec.channelformat(i);
            const auto& stored_name = spec.channelnames[static_cast<std::size_t>(i)];
            auto name = stored_name;
            if (!views.take(p, name)) continue;
            of_view = true;
            if (result.channels.empty()) {
                display = {static_cast<std::uint32_t>(spec.full_width), static_cast<std::uint32_t>(spec.full_height)};
                right = spec.full_width, bottom = spec.full_height;
            }
            check(spec, display, part, file);
            if (extent.overscan) {
                left = std::min(left, spec.x - spec.full_x), top = std::min(top, spec.y - spec.full_y);
                right = std::max(right, spec.x - spec.full_x + spec.width);
                bottom = std::max(bottom, spec.y - spec.full_y + spec.height);
            }
            name = full_name(name, layer, result.channels.empty() || result.channels.front().part == part);
            if (taken.contains(name)) name = fmt::format("{}.{}", part_name.empty() ? "part" : part_name, name);
            if (!taken.insert(name).second) continue;
            result.channels.push_back({name, stored_name, part, i, format == OIIO::TypeUInt32, format == OIIO::TypeHalf,
                                       lossy_compression(spec)});
        }
        // The other eye's part has a camera and a manifest of its own.
        if (of_view) add_attributes(result.metadata.data().list, spec.extra_attribs);
    }
    if (result.channels.empty()) {
        throw Error(fmt::format(
            "{}: {}", file.string(),
            deep ? "a deep image; flatten it first, a G-buffer has one sample per pixel" : "has no channels"));
    }
    constexpr int longest_side = 1 << 17;
    if (right - left > longest_side || bottom - top > longest_side)
        throw Error(fmt::format("{}: data windows of {}x{} pixels; the header is damaged", file.string(), right - left,
                                bottom - top));
    result.size = {static_cast<std::uint32_t>(right - left), static_cast<std::uint32_t>(bottom - top)};
    result.window = {left, top, display};
    for (auto& part : result.parts) part.x -= left, part.y -= top;
    return result;
}

}  // namespace wrinkle::io
