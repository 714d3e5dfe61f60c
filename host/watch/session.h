#pragma once

#include <chrono>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "look/look.h"
#include "scene/scene_text.h"
#include "watch/board.h"
#include "watch/file_stamps.h"

namespace wrinkle {

/// A scene that is watched: its file, numbers that differ from the file's until they are written, layers that are
/// switched off, and the last good image. For one thread.
class [[gnu::visibility("hidden")]] WatchSession {
public:
    /// Throws Error where there is no such file, or no such device. What else is wrong is shown.
    WatchSession(const std::filesystem::path& scene, std::optional<int> frame, const std::string& device);

    /// Sees whether the scene, a texture or the frame changed.
    void look_at_files();
    /// Evaluates where that is due. Whether there is something new to show.
    bool evaluate();
    WatchBoard::Shown shown() const;

    void set_numbers(const std::map<std::string, double>& numbers);
    void switch_off(std::set<std::string> layers);
    void want_condition(bool wanted);
    /// Puts the numbers into the file. Throws Error where that cannot be written, changed meanwhile, or would be no
    /// scene with them.
    void write_numbers();
    /// Numbers of a pixel, as JSON. Throws Error.
    std::string pixel(std::uint32_t x, std::uint32_t y);

private:
    void load();
    std::string state() const;

    const std::filesystem::path path_;
    const std::optional<int> frame_;
    Look look_;
    std::string text_;                       ///< the file's
    std::map<std::string, double> numbers_;  ///< by their ids, in place of the file's
    std::set<std::string> off_;
    bool condition_ = false;

    scene::SceneFile file_;                                 ///< the last one that could be loaded
    std::string frame_tables_;                              ///< of the frame that is open
    std::vector<std::filesystem::path> textures_, frames_;  ///< files
    FileStamps stamps_;
    bool due_ = true, reopen_ = true, unloaded_ = false;
    std::chrono::steady_clock::time_point tried_;

    std::string error_;
    std::vector<std::string> warnings_;  ///< of the last image that took a build
    std::vector<scene::SceneNumber> shown_numbers_;
    std::shared_ptr<const LookImage> image_;
    double seconds_ = 0;
    std::uint64_t version_ = 0;  ///< of what is shown
    bool doubt_ = true;          ///< the frame was opened since its warnings were made
};

}  // namespace wrinkle
