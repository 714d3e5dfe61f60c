#include "cli/frame_list.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <sstream>

#include "base/names.h"
#include "io/frame_path.h"
#include "scene/files.h"
#include "wrinkle/error.h"

namespace wrinkle::cli {

namespace {

constexpr std::size_t kMostFrames = 1'000'000;

[[noreturn]] void refuse(const std::string& part) {
    throw CLI::ValidationError(
        "--frames", fmt::format("\"{}\" is no frame list; write 7, 1-10, 1-100x5, or several with commas", part));
}

int number(const std::string& text, const std::string& part) {
    int value = 0;
    const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (failure != std::errc() || end != text.data() + text.size() || value < 0) refuse(part);
    return value;
}

}  // namespace

std::vector<int> parse_frames(const std::string& text) {
    std::vector<int> frames;
    std::istringstream parts(text);
    for (std::string part; std::getline(parts, part, ',');) {
        const std::size_t dash = part.find('-'), times = part.find_first_of("x:");
        if (dash == std::string::npos) {
            frames.push_back(number(part, part));
            continue;
        }
        const int first = number(part.substr(0, dash), part);
        const int last = number(part.substr(dash + 1, times == std::string::npos ? times : times - dash - 1), part);
        const int step = times == std::string::npos ? 1 : number(part.substr(times + 1), part);
        if (step == 0 || last < first) refuse(part);
        if (static_cast<std::size_t>((last - first) / step) >= kMostFrames) refuse(part);
        for (long frame = first; frame <= last; frame += step) frames.push_back(static_cast<int>(frame));
    }
    if (frames.empty()) refuse(text);
    std::vector<int> sorted = frames;
    std::ranges::sort(sorted);
    if (const auto twice = std::ranges::adjacent_find(sorted); twice != sorted.end())
        throw CLI::ValidationError("--frames", fmt::format("\"{}\" names frame {} twice", text, *twice));
    return frames;
}

std::vector<std::filesystem::path> frame_files(const GBufferSource& gbuffer,
                                               const std::optional<CameraSource>& camera) {
    std::vector<std::filesystem::path> files{gbuffer.file};
    if (!gbuffer.beauty_file.empty()) files.push_back(gbuffer.beauty_file);
    if (camera && !camera->file.empty()) files.push_back(camera->file);
    return files;
}

std::vector<std::filesystem::path> frame_files(const scene::SceneFile& file) {
    auto files = file.kept_files;
    files.insert(files.end(), file.frame_files.begin(), file.frame_files.end());
    return files;
}

void check_output_name(const char* what, const std::string& name, const std::vector<int>& frames) {
    if (has_frame_place(name) && frames.empty())
        throw Error(fmt::format("{} {} holds a place for a frame number: give --frames", what, quote(name)));
    if (!name.empty() && !has_frame_place(name) && frames.size() > 1)
        throw Error(fmt::format(
            "{} {} needs a place for the number, as {} frames would replace each other; name it such as bump.####.exr",
            what, quote(name), frames.size()));
}

void check_frame_pattern(const std::vector<std::filesystem::path>& files, const char* option, bool given) {
    const auto pattern = std::ranges::find_if(files, has_frame_pattern);
    if (pattern != files.end() && !given)
        throw Error(fmt::format("{} holds a place for a frame number: give {}", pattern->string(), option));
    if (pattern == files.end() && given)
        throw Error(
            fmt::format("{} needs a place for the number in the frame's file name, such as frame.####.exr; it "
                        "is {}",
                        option, files.front().string()));
}

void check_can_be_read_again(const std::filesystem::path& scene) {
    if (scene == "-")
        throw Error(
            "a scene whose textures or tables differ from frame to frame is read again for each; give a file in place "
            "of standard input");
}

void check_frames_exist(const std::vector<std::filesystem::path>& files, const std::vector<int>& frames) {
    constexpr std::size_t most_named = 5;
    std::vector<std::string> missing;
    for (const int frame : frames)
        for (const std::filesystem::path& file : files) {
            if (const auto path = frame_path(file, frame); !scene::why_not_readable(path, false, "").empty())
                missing.push_back(path.string());
        }
    if (missing.empty()) return;
    const std::size_t named = std::min(missing.size(), most_named);
    throw Error(fmt::format("no such file: {}{}; nothing was evaluated",
                            fmt::join(missing.begin(), missing.begin() + static_cast<std::ptrdiff_t>(named), ", "),
                            missing.size() > named ? fmt::format(" and {} more", missing.size() - named) : ""));
}

}  // namespace wrinkle::cli
