#pragma once

#include <string>
#include <utility>

#include "base/input_file.h"
#include "io/volume_grid.h"

/// OpenVDB files read in a process of their own. OpenVDB trusts what it reads: damaged files have made it write past
/// its buffers and allocate without end, which then ends that process and is an error in this one.
namespace wrinkle::io {

/// As read_grid(), by the program limits().volume_reader. It may take memory and time in proportion to the file, and
/// hands over the grid in shared memory. Throws Error, also when it crashes.
std::pair<RawVolume, std::string> read_grid_in_child(const InputFile& file, const std::string& wanted, bool voxels);

/// The first argument of a program that is to do serve_volume() and nothing else.
inline constexpr char kServeVolume[] = "--read-volume";

/// What the child does, as its arguments say. Returns the program's exit status.
int serve_volume(int argc, char** argv);

}  // namespace wrinkle::io
