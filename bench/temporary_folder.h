#pragma once

#include <cstdlib>
#include <filesystem>

#include "wrinkle/error.h"

namespace wrinkle::bench {

/// A folder that is deleted, with all in it, when its object is destroyed.
class TemporaryFolder {
public:
    TemporaryFolder() {
        std::string pattern = (std::filesystem::temp_directory_path() / "wrinkle_bench.XXXXXX").string();
        if (::mkdtemp(pattern.data()) == nullptr) throw Error("cannot make a temporary folder");
        path_ = pattern;
    }
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;
    ~TemporaryFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }

    const std::filesystem::path& path() const { return path_; }

private:
    std::filesystem::path path_;
};

}  // namespace wrinkle::bench
