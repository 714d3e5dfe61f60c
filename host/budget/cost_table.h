#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "wrinkle/device.h"
#include "wrinkle/precision.h"
#include "wrinkle/scene.h"

namespace wrinkle {

/// What a variant of a layer was measured to cost and to err by.
struct VariantCost {
    double ns = 0;            ///< a pixel, for one of a layer's units (CostKind, scene/layer_kind.h)
    double p99 = 0, max = 0;  ///< degrees, against double
};

/// What a kind of layer was measured to cost and to miss of the areas that pixels show, by some number of [filter]
/// taps.
struct TapsCost {
    double ns = 0;  ///< a pixel of a pass with this layer alone
    double median = 0,
           p99 = 0;  ///< degrees, against the mean over each pixel's area (measure_area, tools/area_error.h)
};

/// What the table files positions and screen derivatives under.
inline const std::string kGeometryKind = "geometry";

/// Measured costs and errors of one device.
struct DeviceCosts {
    std::string device_class;  ///< "cpu, 16 lanes"
    std::string device, driver;
    std::map<std::string, std::map<Precision, VariantCost>> kinds;
    std::map<std::string, std::map<int, TapsCost>> areas;  ///< by kind and number of taps

    /// Nothing where it was not measured.
    std::optional<VariantCost> find(const std::string& kind, Precision precision) const;
    /// Of the largest number of taps that was measured and is at most `taps`; nothing where none was.
    std::optional<std::pair<int, TapsCost>> find_taps(const std::string& kind, int taps) const;
};

/// "cpu, 16 lanes": what devices have in common that cost about the same.
std::string device_class(const DeviceInfo& info);

/// The tables that come with wrinkle, of every device that was measured (kernels/precision.json).
std::vector<DeviceCosts> shipped_costs();

/// The table that comes with wrinkle for a device, overlaid with what `wrinkle tune` measured on this very
/// device. Devices of a class that was not measured take the nearest one's. Throws Error where a table is damaged.
DeviceCosts costs_of(const DeviceInfo& info);

/// Where `wrinkle tune` keeps its measurements; empty: no cache folder.
std::filesystem::path user_costs_file();

/// Tables of a file; none where there is no such file. Throws Error, naming the file, where it is damaged.
std::vector<DeviceCosts> read_costs(const std::filesystem::path& file);
/// Writes them; the file is seen complete or not at all.
void write_costs(const std::filesystem::path& file, const std::vector<DeviceCosts>& tables);

}  // namespace wrinkle
