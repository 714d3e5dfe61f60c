#pragma once

#include "tests/io/files.h"
#include "tests/run/area_frames.h"

namespace wrinkle::test {

/// The ground of the brute-force tests, as a file.
inline Scene on_ground(const TempFolder& folder, Layer layer) {
    const HostFrame frame = ground(kSize);
    const char* planes[] = {"normal.x", "normal.y", "normal.z", "depth"};
    write_exr(
        folder / "ground.exr", static_cast<int>(kSize.width), static_cast<int>(kSize.height),
        {"N.X", "N.Y", "N.Z", "Z"}, [&](int c, int x, int y) {
            return frame.pixels.at(planes[c])[static_cast<std::size_t>(y) * kSize.width + static_cast<std::size_t>(x)];
        });
    Scene scene = scene_of(std::move(layer));
    scene.gbuffer.file = folder / "ground.exr";
    scene.gbuffer.roles["depth"] = "Z";
    scene.camera.inline_camera = frame.frame.camera;
    return scene;
}

}  // namespace wrinkle::test
