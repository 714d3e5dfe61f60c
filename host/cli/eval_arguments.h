#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "wrinkle/functions.h"

namespace wrinkle::cli {

/// "FILE", "NAME=FILE" or "NAME=FILE.exr:LAYER" of --in and --out.
struct EvalFile {
    std::string name;  ///< of a parameter or result; empty: a CSV file with all of them
    std::filesystem::path file;
    std::string layer;
};
EvalFile parse_eval_file(const std::string& text);

/// "1920x1080". Throws CLI::ValidationError.
Size parse_size(const std::string& text);

/// The values of "NAME=VALUE" texts, each by its setting's kind. `size`: the frame of a camera, else what its file
/// says. Throws Error, or CLI::ValidationError where there is no "=",
/// or a number is none.
std::map<std::string, SettingValue> parse_settings(const Function& function, const std::vector<std::string>& texts,
                                                   std::optional<Size> size);

}  // namespace wrinkle::cli
