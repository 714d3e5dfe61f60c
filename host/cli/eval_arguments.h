#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "wrinkle/functions.h"

namespace wrinkle::cli {

/// A value of --in or --out: "FILE", "NAME=FILE" or "NAME=FILE.exr:LAYER".
struct EvalFile {
    std::string name;  ///< a parameter or result; empty for a CSV file, which holds all of them
    std::filesystem::path file;
    std::string layer;
};
EvalFile parse_eval_file(const std::string& text);

/// Reads a size such as "1920x1080". Throws CLI::ValidationError.
Size parse_size(const std::string& text);

/// Reads "NAME=VALUE" texts; what VALUE may be depends on the kind of the setting NAME. `size` is the frame's size for
/// camera files; without it, they say it themselves. Throws CLI::ValidationError when a text has no "=" or a malformed
/// number, and Error for everything else.
std::map<std::string, SettingValue> parse_settings(const Function& function, const std::vector<std::string>& texts,
                                                   std::optional<Size> size);

}  // namespace wrinkle::cli
