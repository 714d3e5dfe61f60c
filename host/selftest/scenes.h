#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "wrinkle/passes.h"

/// Small scenes in code on a small frame in memory, whose right normals and colours stand in answers.txt.
namespace wrinkle::selftest {

/// Of errors, the median, 99% and the largest.
struct Bounds {
    double median = 0, p99 = 0, max = 0;
};

struct CheckedScene {
    std::string name;
    Scene scene;
    Bounds degrees;   ///< of the normals
    Bounds relative;  ///< of the colours to themselves, or at least to 0.01; none where the scene is not lit
};

/// A folder that goes with this object.
class TemporaryFolder {
public:
    TemporaryFolder();
    ~TemporaryFolder();
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;
    const std::filesystem::path& path() const { return path_; }

private:
    std::filesystem::path path_;
};

/// The scenes. Their textures and the volume are written to `folder`, which has to last as long as passes are made.
std::vector<CheckedScene> checked_scenes(const std::filesystem::path& folder);

/// A ball on the ground, 19 x 13 pixels: numbers of pixels that no work-group and no vector divides.
struct CheckedFrame {
    Frame frame;
    std::map<std::string, std::vector<float>> planes;
};
CheckedFrame checked_frame();

}  // namespace wrinkle::selftest
