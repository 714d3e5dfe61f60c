#include <fmt/format.h>
#include <fmt/ranges.h>

#include "layers/common.h"
#include "wrinkle/error.h"

namespace wrinkle {

namespace {

constexpr const char* kDefaultLayer = "volume_gradient";  // as `wrinkle decals` calls it

const GradientLayer& gradient_of(const Layer& layer) { return std::get<GradientLayer>(layer.bump); }

void read(scene::Table& table, Layer& layer) {
    auto bump = scene::held<GradientLayer>(layer);
    table.read_file("file", bump.file, scene::Table::FramePattern::kept);
    table.read("layer", bump.layer);
    table.read("channels", bump.channels);
    table.compiled_in("channels", fmt::format("{}", fmt::join(bump.channels, " ")));
    if (!bump.channels.empty() && bump.channels.size() != 3)
        table.complain("channels", "must name three channels: those of x, y and z");
    else if (!bump.channels.empty() && !bump.layer.empty())
        table.complain("channels", "names channels beside a layer; keep one of them");
    table.choose("space", bump.camera_space, {{"world", false}, {"camera", true}});
    scene::read_project(table, layer);
    scene::read_weight_without_levels(table, layer);
    layer.bump = std::move(bump);
}

io::VectorSource source_of(const GradientLayer& l) {
    return {l.file, l.layer.empty() ? kDefaultLayer : l.layer, l.channels, l.camera_space};
}

/// The frame's own channels are read as they are, where they are in world space.
bool is_of_frame(const GradientLayer& l) { return l.file.empty() && !l.camera_space; }

std::optional<io::VectorSource> vectors(const Layer& layer) {
    const GradientLayer& l = gradient_of(layer);
    return is_of_frame(l) ? std::nullopt : std::optional(source_of(l));
}

std::array<std::string, 3> planes_of(LayerText& at) {
    constexpr std::string_view channel = "channel:";
    const GradientLayer& l = gradient_of(at.layer);
    if (!is_of_frame(l)) {
        const std::string own = own_vectors(at.emitter.index_of(at.layer));
        if (at.emitter.has(own + ".x") && at.emitter.has(own + ".y") && at.emitter.has(own + ".z"))
            return {own + ".x", own + ".y", own + ".z"};
        throw Error(
            fmt::format("{}: its gradients are the planes {}.x, .y and .z, and they are not there", at.who, own));
    }
    std::vector<std::string> channels;
    for (const std::string& plane : at.emitter.available.planes)
        if (plane.starts_with(channel)) channels.push_back(plane.substr(channel.size()));
    try {
        std::array<std::string, 3> planes = io::vector_channels(channels, source_of(l));
        for (std::string& plane : planes) plane.insert(0, channel);
        return planes;
    } catch (const Error& error) { throw Error(fmt::format("{}: the frame has {}", at.who, error.what())); }
}

std::string emit(LayerText& at) {
    const std::array<std::string, 3> planes = planes_of(at);
    std::string text, finite = "active";
    for (std::size_t k = 0; k < planes.size(); ++k) {
        at.section.inputs.insert(planes[k]);
        text +=
            fmt::format("        wr_floats {}_read = wr_load_floats({}, at.in);\n", "xyz"[k], identifier(planes[k]));
        finite += fmt::format(" & wr_finite({}_read)", "xyz"[k]);
    }
    at.section.reads.insert("marked");
    at.section.writes.insert("marked");
    at.section.operations += 15;
    return text +
           fmt::format(
               "        wr_mask sound = {};\n"
               "        wr_real low_bits = marked - 8 * wr_floor(marked / 8);\n"
               "        marked += (active & !sound & (low_bits < 4)) ? (wr_real)(4) : (wr_real)(0);\n"
               "        wr_vec3 read = wr_v3(wr_to_real(wr_valid_or(x_read, sound, 0)),\n"
               "            wr_to_real(wr_valid_or(y_read, sound, 0)), wr_to_real(wr_valid_or(z_read, sound, 0)));\n",
               finite) +
           at.volume("read");
}

}  // namespace

const LayerKind& layers::gradient() {
    static constexpr LayerKind row{
        .name = GradientLayer::kind, .read = read, .emit = emit, .once_a_pixel = true, .vectors = vectors};
    return row;
}

}  // namespace wrinkle
