#include <fmt/format.h>

#include "layers/kinds.h"
#include "run/pass_impl.h"
#include "wrinkle/error.h"

namespace wrinkle {

void check_device_depth(DeviceDepth device_depth, const Camera& camera, Size size) {
    if (device_depth == DeviceDepth::none) return;
    const auto& z = camera.proj[2];
    const CameraKind kind = camera_kind(camera, size);
    if (kind == CameraKind::general) {
        const auto& w = camera.proj[3];
        throw Error(fmt::format(
            "a device depth needs a projection whose fourth row is 0, 0, -1, 0 (perspective; the view looks "
            "along -z, so turn the signs of the view's and the projection's z of left-handed engines) or "
            "0, 0, 0, 1 (parallel); found {}, {}, {}, {}",
            w[0], w[1], w[2], w[3]));
    }
    const bool useful = kind == CameraKind::pinhole ? z[3] != 0 : kind == CameraKind::parallel && z[2] != 0;
    if (!useful || z[0] != 0 || z[1] != 0)
        throw Error(
            fmt::format("a device depth needs a perspective or parallel projection whose third row is 0, 0, a, b; "
                        "found {}, {}, {}, {}",
                        z[0], z[1], z[2], z[3]));
    const bool reversed = kind == CameraKind::pinhole ? z[3] > 0 : z[2] > 0;
    if (device_depth == DeviceDepth::minus_one_to_one && reversed)
        throw Error("the projection is reversed; its device depth must be zero_to_one, as glClipControl sets it");
}

bool same_shape(const Frame& a, const Frame& b) {
    return a.size == b.size && a.planes == b.planes && a.ray_depth == b.ray_depth && a.cryptomatte == b.cryptomatte &&
           a.beauty_scale == b.beauty_scale && a.formats == b.formats && a.device_depth == b.device_depth &&
           camera_kind(a.camera, a.size) == camera_kind(b.camera, b.size);
}

Plan plan_for(const Scene& scene, const Frame& frame, const PlanOptions& options) {
    if (frame.size.width == 0 || frame.size.height == 0) throw Error("the frame has no pixels");
    if (frame.beauty_scale == 0 || frame.size.width % frame.beauty_scale != 0 ||
        frame.size.height % frame.beauty_scale != 0)
        throw Error(
            fmt::format("the frame has {} x {} pixels, which are no whole pixels of a beauty that has one for "
                        "{} along each side",
                        frame.size.width, frame.size.height, frame.beauty_scale));
    check_device_depth(frame.device_depth, frame.camera, frame.size);
    if (frame.ray_depth && frame.device_depth != DeviceDepth::none)
        throw Error("the depth of a frame is that of a depth buffer, or the distance along rays; not both");
    Available available{.planes = frame.planes,
                        .camera = camera_kind(frame.camera, frame.size),
                        .ray_depth = frame.ray_depth,
                        .beauty_scale = static_cast<std::uint16_t>(frame.beauty_scale),
                        .cryptomatte = frame.cryptomatte,
                        .formats = frame.formats,
                        .device_depth = frame.device_depth};
    for (const Layer& layer : scene.layers)
        if (const LayerKind& kind = kind_of(layer_kinds(), layer); kind.look) kind.look(layer, available);
    return make_plan(scene, available, options);
}

}  // namespace wrinkle
