#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "wrinkle/scene.h"

namespace wrinkle {

/// What the files of a frame are called: normal.exr, lit.png ..., with the frame's number before the extension in a
/// sequence; or as [output] name says.
class OutputNames {
public:
    OutputNames(const Scene& scene, std::filesystem::path directory, std::optional<int> frame);

    /// Whether one EXR file holds all channels.
    bool is_single() const { return single_; }
    bool is_lit() const { return lit_; }
    /// Whether there is a PNG of a picture: "normal", "lit" or "before".
    bool wants(const std::string& picture) const;

    std::filesystem::path exr(const std::string& picture) const { return path(single_ ? name_ : pattern_, picture); }
    std::filesystem::path png(const std::string& picture) const { return path(pattern_, picture, ".png"); }

    /// All files of the frame.
    std::vector<std::filesystem::path> all() const;

private:
    std::filesystem::path path(const std::string& name, const std::string& picture, const char* extension = "") const;

    std::filesystem::path directory_;
    std::optional<int> frame_;
    std::string name_, pattern_;
    bool single_ = false, lit_ = false, ratio_ = false;
    std::vector<std::string> pictures_;
};

}  // namespace wrinkle
