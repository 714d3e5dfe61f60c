#pragma once

#include <algorithm>
#include <optional>

#include "tests/reference/frame.h"
#include "tests/reference/texcoord.h"

namespace wrinkle::reference {

/// A layer's mask on a frame: the product of all that it names, or one minus that.
template <class T>
class SceneMask {
public:
    SceneMask(const Mask& mask, bool footprint, const Frame<T>& frame, SceneTextures<T>& textures)
        : mask_(mask), footprint_(footprint) {
        if (!mask.object.empty()) object_ = frame.plane("object");
        if (mask.channel) channel_ = frame.plane("channel:" + *mask.channel);
        if (mask.texture) texture_ = textures.values(mask.texture->file.string());
    }

    /// Nothing when it has a texture and the UV plane has no derivative here.
    std::optional<T> at(std::size_t i, const Surfel<T>& s) const {
        T m = 1;
        if (!mask_.object.empty())
            m *= std::ranges::any_of(mask_.object, [&](double k) { return object_[i] == static_cast<float>(k); })
                     ? T(1)
                     : T(0);
        if (!mask_.cryptomatte.empty()) {
            T covered = 0;
            for (const std::string& name : mask_.cryptomatte) covered += s.coverage(name);
            m *= coverage_of_bumps(covered, s.front, mask_.cryptomatte, mask_.invert);
        }
        if (mask_.channel) m *= saturate(T(channel_[i]));
        if (mask_.texture) {
            const auto st = map_coordinates(mask_.texture->uv, s);
            if (!st) return std::nullopt;
            m *= sample(*texture_.pyramid, 0, st->st, texture_.lod(st->d, footprint_), texture_.wrap);
        }
        return mask_.invert ? 1 - m : m;
    }

private:
    Mask mask_;
    bool footprint_;
    std::span<const float> object_, channel_;
    LayerTexture<T> texture_;
};

}  // namespace wrinkle::reference
