#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "scene/scene_file.h"

/// A scene as the text that its author sees, to be changed without a save, and changed in place.
namespace wrinkle::scene {

/// load_scene_file() of a file that holds `text`, or will.
SceneFile load_scene_text(LayerKinds kinds, const std::string& text, const std::filesystem::path& file,
                          const SceneOptions& options = {});

/// What of a scene says where the frame comes from, [gbuffer] and [camera]: the same text for the same frame.
std::string frame_tables(std::string_view text);

/// A number of a layer, a light, [lighting] or [filter] that stands in a scene's text.
struct SceneNumber {
    std::string id;     ///< "layer.2.uv.scale.0": the place in the file, counted from 0
    std::string group;  ///< whose it is: `layer "cobbles"`
    std::string name;   ///< "uv.scale x"
    std::uint32_t line = 0;
    double value = 0;
    bool whole = false;               ///< it counts something
    std::size_t begin = 0, size = 0;  ///< its bytes in the text
};

/// In the order of the file. Numbers that name objects are left out, and those of matrices.
/// Throws Error for what is no TOML.
std::vector<SceneNumber> numbers_in(std::string_view text);

/// `text` with other values for numbers, by their ids; all else, comments and spaces included, stays as it is. Ids that
/// are not in it are passed over.
std::string with_numbers(std::string text, const std::map<std::string, double>& values);

}  // namespace wrinkle::scene
