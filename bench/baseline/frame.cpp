#include "frame.h"

#include "wrinkle/error.h"

namespace wrinkle::baseline {

Frame::Frame(const Scene& scene, Size size, const CameraTerms& camera_in, const PlaneMap& planes)
    : width(static_cast<int>(size.width)), height(static_cast<int>(size.height)), camera(camera_in), planes_(planes) {
    const std::array<const char*, 3> xyz{"x", "y", "z"};
    const std::array<const char*, 2> uv_names{"u", "v"};
    normal = find("normal", xyz);
    position = find("position", xyz);
    dp_du = find("dp_du", xyz);
    dp_dv = find("dp_dv", xyz);
    uv = find("uv", uv_names);
    duv_dx = find("duv_dx", uv_names);
    duv_dy = find("duv_dy", uv_names);
    depth = find("depth");
    object = find("object");
    for (int rank = 0;; ++rank) {
        const Plane id = find("crypto.id" + std::to_string(rank));
        const Plane coverage = find("crypto.coverage" + std::to_string(rank));
        if (id == nullptr || coverage == nullptr) break;
        cryptomatte.push_back({id, coverage});
    }

    if (normal[0] == nullptr) throw Error("baseline: the G-buffer has no planes normal.x .y .z");
    ray_distance_ = scene.gbuffer.depth == DepthKind::ray;
    const Geometry geometry = scene.gbuffer.geometry;
    if (geometry == Geometry::position ||
        (geometry == Geometry::automatic && !camera.pinhole && position[0] != nullptr))
        depth = nullptr;
    if (geometry == Geometry::depth && depth == nullptr) throw Error("baseline: the G-buffer has no plane depth");
    if (depth != nullptr && !camera.pinhole) throw Error("baseline: depth needs a pinhole camera; give positions");
    if (depth == nullptr && position[0] == nullptr)
        throw Error("baseline: the G-buffer has neither depth nor position");
}

Frame::Plane Frame::find(const std::string& name) const {
    const auto found = planes_.find(name);
    if (found == planes_.end() || found->second.empty()) return nullptr;
    if (found->second.size() != static_cast<std::size_t>(width) * height)
        throw Error("baseline: plane " + name + " is not of the frame's size");
    return found->second.data();
}

Frame::Plane Frame::channel(const std::string& name) const {
    if (const Plane plane = find("channel:" + name)) return plane;
    if (const Plane plane = find(name)) return plane;
    throw Error("baseline: a mask names the channel " + name + ", which the G-buffer lacks");
}

template <std::size_t N>
std::array<Frame::Plane, N> Frame::find(const std::string& role, const std::array<const char*, N>& suffixes) const {
    std::array<Plane, N> out{};
    for (std::size_t i = 0; i < N; ++i) {
        out[i] = find(role + "." + suffixes[i]);
        if (out[i] == nullptr) return {};
    }
    return out;
}

}  // namespace wrinkle::baseline
