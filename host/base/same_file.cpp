#include "base/same_file.h"

#include <fmt/format.h>
#include <sys/stat.h>

#include "wrinkle/error.h"

namespace wrinkle {

void refuse_to_replace(const std::filesystem::path& output, std::span<const std::filesystem::path> inputs) {
    struct stat there {};
    if (::stat(output.c_str(), &there) != 0) return;
    for (const auto& input : inputs) {
        struct stat read {};
        if (::stat(input.c_str(), &read) != 0 || read.st_dev != there.st_dev || read.st_ino != there.st_ino) continue;
        throw Error(fmt::format("cannot write {}: it is {}, which is read; write to another name or folder",
                                output.string(), input == output ? "an input" : "the input " + input.string()));
    }
}

}  // namespace wrinkle
