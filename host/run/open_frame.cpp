#include "run/open_frame.h"

#include <fmt/format.h>

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

}  // namespace

Frame frame_of(const Scene& scene, const GBufferReader& reader, const FrameCamera& camera) {
    if (!reader.normals_are_in_world_space())
        throw Error(fmt::format("{}: its normals ({}) are in camera space, and nobody has turned them",
                                reader.path().string(), reader.roles().channel_of.at("normal.x")));
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
