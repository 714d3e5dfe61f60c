#pragma once

#include <string>
#include <vector>

#include "error.h"
#include "measure.h"
#include "wrinkle/device.h"

namespace wrinkle::bench {

/// One table of decals on the frame of data/gbuffer/courtyard.exr, resampled.
struct DecalRow {
    std::string name;
    std::size_t decals = 0;
    double coverage = 0;        ///< decals that a pixel lies in, on average
    double listed = 0;          ///< entries of the tiles' lists over pairs of a tile and a decal that touch
    double bin_megabytes = 0;   ///< tables, bounds and lists on the device
    Timing pass, bins, camera;  ///< seconds: the whole pass; its binning alone; the host's part for a new camera
    Timing plain, empty, copy;  ///< plain C++ with the same lists; the pass without decals; copying 6 planes
    ErrorStats error;

    double bin_share() const { return bins.median / pass.median; }
    /// Nanoseconds for each decal that a pixel lies in, above the pass without decals.
    double per_decal(const Timing& t, std::size_t pixels) const {
        return (t.median - empty.median) / (coverage * static_cast<double>(pixels)) * 1e9;
    }
};

struct DecalMeasurement {
    Size size{3840, 2160};
    std::vector<std::size_t> counts{1000, 10'000, 100'000};
    double coverage = 8;
    int repetitions = 5;
    int lanes = 0;
    bool replace = false;
    bool plain = true;            ///< plain C++ too
    bool processor_time = false;  ///< time of all cores together, not of the wall: for machines that others use too
};

/// Tables of different sizes that cover as many pixels as often, timed turn by turn with plain C++.
std::vector<DecalRow> measure_decals(const Device& device, const DecalMeasurement& wanted);

}  // namespace wrinkle::bench
