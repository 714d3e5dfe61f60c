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
    bool at_most = false;                      ///< operations are those of a pixel that skips nothing
    std::string unit = "degrees";              ///< of the errors
    ErrorStats error{};                        ///< on regular inputs
    std::map<std::string, ErrorStats> hard{};  ///< by category
    std::map<std::string, double> figures{};   ///< what else there is to say of it, with the unit in the name
    std::string hash{};                        ///< of the results' bits
    double bound = 0;                          ///< documented error; 0: none
    double memory = 0;                         ///< bytes that the process held at most, above what it began with

    double ns_per_pixel() const { return seconds.median / static_cast<double>(pixels) * 1e9; }
    double gb_per_s() const { return bytes * static_cast<double>(pixels) / seconds.median * 1e-9; }
    bool counted() const { return operations > 0 && !at_most; }
    double gflop_per_s() const { return operations * static_cast<double>(pixels) / seconds.median * 1e-9; }
    /// What tells measurements of two runs apart.
    std::string key() const;
};

/// A promise about one run: a ratio of what two measurements cost a pixel, and its limit.
struct Bar {
    std::string name{}, verdict{};  ///< "met", "missed", "not told apart": the limit lies within the bounds
    double ratio = 0, spread = 0, limit = 0;
    double low = 0, high = 0;       ///< bounds of the ratio's median
    bool at_most = true;            ///< else at least
    std::string of{}, to{};         ///< the two, as keys of measurements
    double of_p99 = 0, to_p99 = 0;  ///< errors of the two
    std::string unit{};             ///< of these
};

/// What nothing on this machine can beat, measured in the same run.
struct Ceilings {
    double copy_gb_s = 0, triad_gb_s = 0, fma_gflop_s = 0;
    double streamed_triad_gb_s = 0;  ///< in C++, with stores that go past the cache
};

struct Run {
    std::string processor, device, command;
    Rounds rounds;
    Ceilings ceilings;
    std::vector<Measurement> measurements;
    std::vector<Bar> bars{};
};

/// The contender of a race that took part under its variant's name; bytes, errors and what else there is to say of it
/// are still to be filled in. `lanes` 0: not a kernel.
Measurement measured(const std::string& group, const std::string& name, const Contender& contender, int lanes,
                     std::size_t pixels);

nlohmann::json to_json(const Run& run);
/// Throws Error when the file is no run of this program.
Run read_run(const std::string& file);

/// FNV-1a of the bits of numbers, as 16 hex digits.
std::string hash_of(const void* data, std::size_t bytes);

/// The processor's name as the system gives it.
std::string processor_name();

}  // namespace wrinkle::bench
