#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

namespace wrinkle {

struct WatchOptions {
    std::filesystem::path scene;
    std::optional<int> frame;
    std::string device;                                   ///< as Device::open takes it
    int port = 0;                                         ///< 0: any that is free
    std::function<void(const std::string& url)> serving;  ///< called when the page can be opened
};

/// Evaluates a scene whenever it or one of its files changes, and serves a page that shows it, until the process is
/// told to end (Ctrl-C). Throws Error.
void watch(const WatchOptions& options);

}  // namespace wrinkle
