#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "scene/layer_kind.h"

namespace wrinkle::scene {

/// What a command says of a scene beside its file.
struct SceneOptions {
    std::vector<std::string> set{};  ///< values that replace the file's: "layer.cobbles.scale = 0.02"
    std::optional<int> frame{};      ///< fills the places for a number that names of textures, tables and volumes have
};

struct SceneFile {
    Scene scene;
    std::string text;                                  ///< as it was read: values replaced, comments gone
    std::vector<std::filesystem::path> files{};        ///< textures, tables, volumes and kernels
    std::vector<std::filesystem::path> kept_files{};   ///< the frame, first, and what else is read with every frame
    std::vector<std::filesystem::path> frame_files{};  ///< names of those that hold a place for a frame's number
};

/// Loads a scene as wrinkle::load_scene does. Throws Error for what `options` set as well.
SceneFile load_scene_file(LayerKinds kinds, const std::filesystem::path& file, const SceneOptions& options = {});

}  // namespace wrinkle::scene
