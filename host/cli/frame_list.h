#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "wrinkle/scene.h"

namespace wrinkle::cli {

/// "1-10", "1-100x5", "3,7,9-12": every number named, in order, each once. Throws CLI::ValidationError.
std::vector<int> parse_frames(const std::string& text);

/// The files whose names may hold a place for the frame number: the frame's, and its camera's where there is one.
std::vector<std::filesystem::path> frame_files(const GBufferSource& gbuffer, const std::optional<CameraSource>& camera);

/// Throws Error when one of `files` needs a frame number and `option` was not given, or it was and none needs one.
void check_frame_pattern(const std::vector<std::filesystem::path>& files, const char* option, bool given);

/// Throws Error, naming the files, when some of the frames are missing.
void check_frames_exist(const std::vector<std::filesystem::path>& files, const std::vector<int>& frames);

}  // namespace wrinkle::cli
