#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "error_stats.h"
#include "measure.h"

namespace wrinkle::bench {

/// One thing measured: how fast, how wrong. A speed is never recorded without its error.
struct Measurement {
    std::string group;    ///< the part of the bench: "function", "scene", "layer"
    std::string name;     ///< "tangent_frame"
    std::string variant;  ///< "standard", "fused", "plain C++"
    int lanes = 0;        ///< pixels a work-item; 0: not a kernel
    std::size_t pixels = 0;
    Timing seconds{};                          ///< of the whole of `pixels`
    double bytes = 0;                          ///< moved per pixel, each plane once
    double operations = 0;                     ///< floating-point operations per pixel; 0: not counted
    bool at_most = false;                      ///< operations are an upper bound: those of a pixel that skips nothing
    std::string unit = "degrees";              ///< of the errors
    ErrorStats error{};                        ///< on regular inputs
    std::map<std::string, ErrorStats> hard{};  ///< by category
    std::map<std::string, double> figures{};   ///< other numbers; their names say the unit
    std::string hash{};                        ///< of the results' bits
    double bound = 0;                          ///< documented error; 0: none
    double memory = 0;                         ///< the most bytes that the process held, above what it held before

    double ns_per_pixel() const { return seconds.median / static_cast<double>(pixels) * 1e9; }
    double gb_per_s() const { return bytes * static_cast<double>(pixels) / seconds.median * 1e-9; }
    bool counted() const { return operations > 0 && !at_most; }
    double gflop_per_s() const { return operations * static_cast<double>(pixels) / seconds.median * 1e-9; }
    /// The same for measurements of the same thing in two runs.
    std::string key() const;
};

/// A promise and how a run kept it: the ratio of two measurements' times per pixel, and the limit it was promised to
/// keep.
struct Bar {
    std::string name{}, verdict{};  ///< "met", "missed", or "not told apart" when the limit lies within the bounds
    double ratio = 0, spread = 0, limit = 0;
    double low = 0, high = 0;       ///< bounds of the ratio's median
    bool at_most = true;            ///< the limit is an upper one; else a lower one
    std::string of{}, to{};         ///< keys of the two measurements: time of `of` / time of `to`
    double of_p99 = 0, to_p99 = 0;  ///< their 99% errors
    std::string unit{};             ///< of these errors
};

/// What nothing on this machine can beat, measured in the same run.
struct Ceilings {
    double copy_gb_s = 0, triad_gb_s = 0, fma_gflop_s = 0;
    double streamed_triad_gb_s = 0;  ///< a triad in C++, with stores that bypass the cache
};

struct Run {
    std::string processor, device, command;
    Rounds rounds;
    Ceilings ceilings;
    std::vector<Measurement> measurements;
    std::vector<Bar> bars{};
};

/// A measurement with the times of a contender, whose name becomes the variant. The caller fills in bytes, errors and
/// the rest. `lanes` 0: not a kernel.
Measurement measured(const std::string& group, const std::string& name, const Contender& contender, int lanes,
                     std::size_t pixels);

nlohmann::json to_json(const Run& run);
/// Throws Error when the file is no run of this program.
Run read_run(const std::string& file);

/// The FNV-1a hash of some bytes, as 16 hex digits.
std::string hash_of(const void* data, std::size_t bytes);

/// The processor's name as the system gives it.
std::string processor_name();

}  // namespace wrinkle::bench
