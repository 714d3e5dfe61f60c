#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "wrinkle/scene.h"

namespace wrinkle {

/// The lit picture, the bumped normals, the frame's own picture, or the condition: black 1 and white 1e6, by its
/// logarithm.
enum class PanelPicture { lit, normal, before, condition };

/// One picture of a figure: the scene with some of its layers.
struct Panel {
    std::string caption;
    std::vector<std::string> layers;  ///< their names; they apply in the scene's order
    PanelPicture picture = PanelPicture::lit;
};

/// One scene shown several times side by side, to see what a layer or an option does. In TOML a scene with a [figure]
/// and [[panel]] tables.
struct Figure {
    Scene scene;                             ///< every layer that any panel shows
    std::array<double, 4> crop{0, 0, 1, 1};  ///< what of the frame is shown: left, top, right, bottom, as shares of it
    int columns = 0;                         ///< panels side by side; 0: all
    std::vector<Panel> panels;
};

/// Reads and checks a figure, as load_scene() does a scene. Throws Error.
Figure load_figure(const std::filesystem::path& file);

/// The scene of a panel.
Scene panel_scene(const Figure& figure, const Panel& panel);

}  // namespace wrinkle
