#pragma once

#include "io/texture_file.h"
#include "tests/reference/scene_textures.h"

namespace wrinkle::reference {

/// Calls `visit` with every texture of a scene, as load_bump takes it.
template <class Visit>
void for_each_texture(const Scene& scene, const Visit& visit) {
    for (const Layer& layer : scene.layers) {
        std::visit(
            [&](const auto& bump) {
                if constexpr (requires { visit(bump.texture); })
                    if (!bump.texture.file.empty()) visit(bump.texture);
                if constexpr (requires { bump.planes; })
                    for (const auto& plane : bump.planes)
                        if (const auto* use = plane ? std::get_if<TextureUse>(&plane->content) : nullptr) visit(*use);
                if constexpr (requires { bump.textures; })
                    for (TextureUse use : bump.textures) {
                        use.unit = SlopeUnit::metre;
                        visit(use);
                    }
            },
            layer.bump);
        if (layer.mask.texture) visit(TextureUse{.file = layer.mask.texture->file});
    }
}

/// Every texture that a scene names.
inline Images images_of(const Scene& scene) {
    Images images;
    for_each_texture(scene, [&](const TextureUse& use) {
        wrinkle::Image image = load_bump(use);
        images[use.file.string()] = {image.width, image.height, image.channels, std::move(image.texels)};
    });
    return images;
}

}  // namespace wrinkle::reference
