#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "budget/budget.h"
#include "tools/taps_choice.h"
#include "wrinkle/passes.h"

namespace wrinkle {

/// What became of a frame.
struct FrameReport {
    enum class State { written, skipped, failed };
    int frame = 0;
    State state = State::written;
    double seconds = 0;
    std::string error{};                         ///< why it failed
    std::vector<std::filesystem::path> files{};  ///< that were written
};

struct RenderOptions {
    std::filesystem::path directory = "out";
    std::vector<int> frames;  ///< empty: the scene's file as it is
    /// The scene of a frame, where textures, tables or volumes differ from frame to frame.
    std::function<Scene(int frame)> scene_of_frame;
    std::string device;                         ///< as Device::open takes it
    int lanes = 0;                              ///< pixels a work-item: 1, 4, 8 or 16; 0: the device's choice
    int repeat = 1;                             ///< enqueue the kernels this often, to time them
    Precision precision = Precision::standard;  ///< of everything, where the scene has no error budget
    /// The hash of all that goes into a frame's files, which is written into them; nothing: none is.
    std::function<std::string(int frame)> provenance;
    bool resume = false;      ///< skips frames whose files are there, with their provenance
    bool keep_going = false;  ///< after a frame that failed
    bool strict = false;      ///< frames that are warned of fail
    /// Called after each frame.
    std::function<void(const FrameReport&)> frame_done;
    /// Called with the share of the work done, [0,1].
    std::function<void(double)> progress;
};

/// What `wrinkle run` reports of a run.
struct RenderReport {
    std::uint64_t pixels = 0;
    int layers = 0, frames = 0;  ///< frames that were evaluated
    int skipped = 0;
    std::vector<FrameReport> failed;
    DeviceInfo device;
    bool cache_hit = false;
    double read = 0, upload = 0, build = 0, kernels = 0, check = 0, write = 0;  ///< seconds; phases overlap
    double wall = 0, outside = 0;  ///< seconds; outside: of the wall time, not in reading, kernels or writing
    double kernel_ns_per_pixel = 0;
    std::uint64_t peak_memory = 0;  ///< bytes
    std::vector<std::filesystem::path> files;
    std::vector<std::string> cameras;  ///< a line a frame: origin and residual
    std::string lights;                ///< of those that were fitted to the picture; empty: none were
    std::optional<BudgetReport> budget;
    std::optional<TapsChoice> taps;     ///< of a budget for areas; measured on the first frame, and kept
    std::vector<std::string> warnings;  ///< of frames whose passes hold too little, and masks that no pixel matches
};

/// Runs a scene over its frames: reads bands of rows, evaluates, writes, overlapped. Memory does not grow with the
/// frame. Nothing is written unless a frame succeeds in full. Throws Error.
RenderReport render(const Scene& scene, const RenderOptions& options);

}  // namespace wrinkle
