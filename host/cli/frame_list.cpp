#include "cli/frame_list.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <sstream>

#include "io/frame_path.h"
#include "wrinkle/error.h"

namespace wrinkle::cli {

namespace {

constexpr std::size_t kMostFrames = 1'000'000;

[[noreturn]] void refuse(const std::string& part) {
    throw Error(fmt::format("--frames: \"{}\" is no frame list; write 7, 1-10, 1-100x5, or several with commas", part));
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
        const std::size_t dash = part.find('-'), times = part.find('x');
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
        throw Error(fmt::format("--frames: \"{}\" names frame {} twice", text, *twice));
    return frames;
}

void check_frame_pattern(const Scene& scene, const std::string& frames) {
    const bool pattern = has_frame_pattern(scene.gbuffer.file);
    if (pattern && frames.empty())
        throw Error(fmt::format("{} holds a place for a frame number: give --frames", scene.gbuffer.file.string()));
    if (!pattern && !frames.empty())
        throw Error(
            fmt::format("--frames needs a place for the number in the scene's [gbuffer] file, such as "
                        "frame.####.exr; it is {}",
                        scene.gbuffer.file.string()));
}

}  // namespace wrinkle::cli
