#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "layers/kinds.h"
#include "wrinkle/scene.h"

namespace wrinkle::cli {

/// The frame numbers that a text names, in the order given: "1-10", "1-100x5" or "1-100:5" (every
/// fifth), "3,7,9-12". Throws CLI::ValidationError when it is malformed or names a number twice.
std::vector<int> parse_frames(const std::string& text);

/// The files of the G-buffer whose names may hold a place for a frame number: the frame, and the camera's file if there
/// is one.
std::vector<std::filesystem::path> frame_files(const GBufferSource& gbuffer, const std::optional<CameraSource>& camera);
/// The same of a scene, with its layers' gradients, and with its textures, tables and volumes that do.
std::vector<std::filesystem::path> frame_files(const scene::SceneFile& file);

/// Throws Error when a file needs a frame number and `option` was not given, and when it was given and no file needs
/// one.
void check_frame_pattern(const std::vector<std::filesystem::path>& files, const char* option, bool given);

/// Throws Error when the frames would be written over each other, or a name waits for a number that does not come.
/// `what` says whose name it is.
void check_output_name(const char* what, const std::string& name, const std::vector<int>& frames);

/// Throws Error for the scene of standard input, where one has textures or tables that differ from frame to frame.
void check_can_be_read_again(const std::filesystem::path& scene);

/// Throws Error when files of some frames are missing, and names them.
void check_frames_exist(const std::vector<std::filesystem::path>& files, const std::vector<int>& frames);

}  // namespace wrinkle::cli
