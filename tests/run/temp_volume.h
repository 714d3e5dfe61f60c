#pragma once

#include <unistd.h>

#include <filesystem>
#include <string>

#include "io/volume_file.h"

namespace wrinkle::test {

/// A volume in a file, which is deleted after the test.
struct TempVolume {
    std::filesystem::path file =
        std::filesystem::temp_directory_path() / ("wrinkle_volume_" + std::to_string(::getpid()) + ".vdb");
    explicit TempVolume(const DenseVolume& volume) { save_volume(file, volume); }
    ~TempVolume() { std::filesystem::remove(file); }
    TempVolume(const TempVolume&) = delete;
    TempVolume& operator=(const TempVolume&) = delete;
};

}  // namespace wrinkle::test
