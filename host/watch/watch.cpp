#include "watch/watch.h"

#include <malloc.h>

#include <csignal>
#include <thread>

#include "watch/board.h"
#include "watch/server.h"
#include "watch/session.h"

namespace wrinkle {
namespace {

/// How often files are looked at.
constexpr std::chrono::milliseconds kLook{10};

/// Planes of every evaluation take the memory of those before. glibc would give it back to the system each time, and
/// touching fresh memory costs as much as the kernels.
void keep_freed_memory() {
    constexpr int plane = 32 << 20, kept = 1 << 30;  // bytes: the largest that glibc does not map by itself
    mallopt(M_MMAP_THRESHOLD, plane);
    mallopt(M_TRIM_THRESHOLD, kept);
}

void evaluate_until_stopped(WatchSession& session, WatchBoard& board) {
    while (!board.is_stopped()) {
        for (auto task = board.next(kLook); task; task = board.next({})) (*task)(session);
        session.look_at_files();
        if (session.evaluate()) board.show(session.shown());
    }
}

/// Signals that end a program, kept from all threads that begin from now on, for one to wait for.
class EndSignals {
public:
    EndSignals() {
        sigemptyset(&signals_);
        for (const int signal : {SIGINT, SIGTERM, SIGHUP}) sigaddset(&signals_, signal);
        pthread_sigmask(SIG_BLOCK, &signals_, &before_);
    }
    /// The next one ends the program as it always does.
    ~EndSignals() { pthread_sigmask(SIG_SETMASK, &before_, nullptr); }
    EndSignals(const EndSignals&) = delete;
    EndSignals& operator=(const EndSignals&) = delete;

    void wait() const {
        int signal = 0;
        sigwait(&signals_, &signal);
    }

private:
    sigset_t signals_{}, before_{};
};

/// However watching ends, the threads are told before they are waited for.
struct StopAtEnd {
    WatchBoard& board;
    WatchServer& server;
    ~StopAtEnd() {
        board.stop();
        server.stop();
    }
};

}  // namespace

void watch(const WatchOptions& options) {
    keep_freed_memory();
    std::optional<EndSignals> signals(std::in_place);
    WatchSession session(options.scene, options.frame, options.device);
    WatchBoard board;
    board.show(session.shown());  // that there is nothing yet
    WatchServer server(board, options.port);
    std::jthread evaluating([&] { evaluate_until_stopped(session, board); });
    std::jthread serving([&] { server.serve(); });
    const StopAtEnd stop{board, server};
    if (options.serving) options.serving(server.url());
    signals->wait();
    signals.reset();  // a second Ctrl-C does not wait for a kernel that is being built
}

}  // namespace wrinkle
