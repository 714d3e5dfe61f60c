#include "run/open_frame.h"

#include <fmt/format.h>

#include <algorithm>
#include <span>

#include "io/frame_path.h"
#include "layers/kinds.h"
#include "plan/section.h"
#include "wrinkle/error.h"

namespace wrinkle {

namespace {

/// Hashes of every Cryptomatte name that a scene's masks and decals use, and of those the file lists.
std::map<std::string, std::uint32_t> cryptomatte_hashes(const Scene& scene, const GBufferReader& reader) {
    std::map<std::string, std::uint32_t> hashes;
    for (const std::string& name : reader.cryptomatte().names()) hashes.emplace(name, reader.cryptomatte().id(name));
    if (!reader.has_role("cryptomatte")) return hashes;
    const auto add = [&](const std::string& name, const auto& who) {
        if (name.empty() || hashes.contains(name)) return;
        if (io::is_name_pattern(name)) {
            if (!reader.cryptomatte().names().empty()) return;
            throw Error(
                fmt::format("{}: the Cryptomatte of {} has no list of names, so nothing tells what \"{}\" "
                            "matches; give names in full",
                            who(), reader.path().string(), name));
        }
        try {
            hashes.emplace(name, reader.cryptomatte().id(name));
        } catch (const Error& error) { throw Error(fmt::format("{}: {}", who(), error.what())); }
    };
    for (const Layer& layer : scene.layers) {
        for (const std::string& name : layer.mask.cryptomatte) add(name, [&] { return layer_label(layer); });
        const LayerKind& kind = kind_of(layer_kinds(), layer);
        if (!kind.objects) continue;
        for (const NamedObject& object : kind.objects(layer))
            add(object.cryptomatte, [&] { return layer_label(layer) + ": " + object.place; });
    }
    if (scene.lighting.leave)
        for (const std::string& name : scene.lighting.leave->cryptomatte)
            add(name, [] { return std::string("leave in [lighting]"); });
    return hashes;
}

/// The channels that a layer takes slopes from.
std::vector<std::string> slope_channels(const Layer& layer, std::span<const std::string> channels) {
    if (const auto* const heights = std::get_if<HeightChannelLayer>(&layer.bump)) return {heights->channel};
    const auto* const gradient = std::get_if<GradientLayer>(&layer.bump);
    if (gradient == nullptr || kind_of(layer_kinds(), layer).vectors(layer)) return {};  // they are another file's
    if (!gradient->channels.empty()) return gradient->channels;
    const std::string prefix = (gradient->layer.empty() ? "volume_gradient" : gradient->layer) + ".";
    std::vector<std::string> of_layer;
    for (const std::string& channel : channels)
        if (channel.starts_with(prefix)) of_layer.push_back(channel);
    return of_layer;
}

/// Throws Error where a layer takes slopes from the pixels of a smaller picture: those are repeated, and within each
/// nothing would change.
void refuse_slopes_of_smaller_picture(const Scene& scene, const GBufferReader& reader) {
    if (reader.beauty_scale() == 1) return;
    const auto has = [](const std::vector<std::string>& channels, const std::string& channel) {
        return std::ranges::find(channels, channel) != channels.end();
    };
    for (const Layer& layer : scene.layers)
        for (const std::string& channel : slope_channels(layer, reader.beauty_channels()))
            if (has(reader.beauty_channels(), channel) && !has(reader.channels(), channel))
                throw Error(fmt::format(
                    "{}: the channel \"{}\" is that of {}, which has fewer pixels than the frame {}; render "
                    "it at the frame's size",
                    layer_label(layer), channel, scene.gbuffer.beauty_file.string(), reader.path().string()));
}

}  // namespace

Frame frame_of(const Scene& scene, const GBufferReader& reader, const FrameCamera& camera) {
    if (!reader.normals_are_in_world_space())
        throw Error(fmt::format("{}: its normals ({}) are in camera space, and nobody has turned them",
                                reader.path().string(), reader.roles().channel_of.at("normal.x")));
    refuse_slopes_of_smaller_picture(scene, reader);
    Frame frame{.size = reader.size(), .camera = camera.camera, .planes = {}, .ray_depth = false, .cryptomatte = {}};
    for (const std::string& plane : reader.planes()) frame.planes.insert(plane);
    for (const std::vector<std::string>& channels : {reader.channels(), reader.beauty_channels()})
        for (const std::string& channel : channels) frame.planes.insert("channel:" + channel);
    if (!camera.depth_fits && scene.gbuffer.geometry == Geometry::automatic) frame.planes.erase("depth");
    frame.ray_depth = camera.depth.value_or(reader.roles().depth) == DepthKind::ray;
    if (scene.gbuffer.depth != DepthKind::automatic) frame.ray_depth = scene.gbuffer.depth == DepthKind::ray;
    frame.cryptomatte = cryptomatte_hashes(scene, reader);
    frame.beauty_scale = reader.beauty_scale();
    return frame;
}

GBufferReader open_frame(const Scene& scene, int frame) {
    GBufferReader reader = open_gbuffer(scene.gbuffer, frame);
    for (std::size_t i = 0; i < scene.layers.size(); ++i) {
        const Layer& layer = scene.layers[i];
        const LayerKind& kind = kind_of(layer_kinds(), layer);
        auto source = kind.vectors ? kind.vectors(layer) : std::nullopt;
        if (!source) continue;
        source->file = frame_path(source->file, frame);
        try {
            reader.add_vectors(own_vectors(i), *source);
        } catch (const Error& error) { throw Error(fmt::format("{}: {}", layer_label(layer), error.what())); }
    }
    return reader;
}

FrameCamera camera_of_frame(const Scene& scene, GBufferReader& reader, int frame, CameraCheck check) {
    FrameCamera camera = read_frame_camera(scene.camera, reader, frame);
    if (check == CameraCheck::refuse) check_residual(camera, scene.camera.max_residual, reader);
    reader.turn_normals(camera.camera.view);
    return camera;
}

Frame describe_frame(const Scene& scene, int frame) {
    GBufferReader reader = open_frame(scene, frame);
    return frame_of(scene, reader, camera_of_frame(scene, reader, frame, CameraCheck::none));
}

}  // namespace wrinkle
