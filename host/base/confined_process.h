#pragma once

namespace wrinkle {

/// Takes from this process what no reader of a file needs: starting programs, sockets, looking into other processes,
/// opening files to write, and changing what folders hold. Such calls fail with EPERM from then on, for all threads
/// that are started later. What is open stays open. Does nothing where the system cannot (seccomp is Linux's, and may
/// be compiled out of it) or on another kind of processor than x86-64 and arm64. Gives whether it did.
bool confine_process();

}  // namespace wrinkle
