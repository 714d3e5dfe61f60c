#pragma once

#include <memory>
#include <string>

#include "watch/board.h"

namespace wrinkle {

/// Serves the page of a board on 127.0.0.1: the page, what is shown, its pictures and pixels, and takes numbers and
/// switches from it. No files.
class [[gnu::visibility("hidden")]] WatchServer {
public:
    /// `port` 0: any that is free. Throws Error where it cannot be had.
    WatchServer(WatchBoard & board, int port);
    ~WatchServer();

    int port() const;
    std::string url() const;

    /// Serves until stop() is called, by another thread.
    void serve();
    void stop();

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

/// What tells where a request comes from.
struct RequestOrigin {
    std::string method, host;  ///< "GET"; the header Host
    std::string origin;        ///< the header Origin; empty: none
    std::string fetch_site;    ///< the header Sec-Fetch-Site; empty: none
};

/// Why a request is refused; empty: it is not. Pages of other sites shall neither read nor change anything: not by a
/// name of theirs that leads to 127.0.0.1 (DNS rebinding), which the header Host tells, nor by requests that browsers
/// send for them without asking.
std::string why_refused(const RequestOrigin& request, int port);

}  // namespace wrinkle
