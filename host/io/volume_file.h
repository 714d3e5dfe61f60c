#pragma once

#include <filesystem>

#include "io/volume.h"

namespace wrinkle {

/// Reads a grid of an OpenVDB (.vdb) or NanoVDB (.nvdb) file: float, double or 3-vectors of them; level set or fog;
/// also when it is stored as half or quantised. With an empty name the file must hold exactly one such grid. Throws
/// Error for a file that is no volume or of a newer version, for a grid that is not there, of another type or empty,
/// for voxels that are not finite, and for a transform that is not affine or cannot be inverted.
Volume load_volume(const std::filesystem::path& file, const std::string& grid);

/// The same without the voxels, which are not even read from an OpenVDB file.
VolumeInfo volume_info(const std::filesystem::path& file, const std::string& grid);

/// A box of voxels to write.
struct DenseVolume {
    std::string grid = "density";
    std::array<int, 3> first{}, size{};
    int channels = 1;           ///< 1, or 3 for vectors
    std::vector<float> values;  ///< x fastest, then y, z; the channels of a voxel side by side
    float background = 0;
    bool level_set = false;  ///< values of at least the background's magnitude lie outside of the narrow band
    bool half = false;       ///< store 16 bits a number
    Mat4 world_from_index{};
};

/// Throws Error unless a volume of so many channels can be written under this name: .vdb, or .nvdb for one channel.
void check_volume_name(const std::filesystem::path& file, int channels);

/// Writes an OpenVDB or, for the extension .nvdb, a NanoVDB file, pruned and compressed, all or nothing. Throws Error
/// for another extension, a folder that is not there or not writable, and a full disk.
void save_volume(const std::filesystem::path& file, const DenseVolume& volume);

}  // namespace wrinkle
