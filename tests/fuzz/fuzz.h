#pragma once

#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>

#include "wrinkle/error.h"

/// Begins a harness. The test that reads the kept corpus again has them all in one program, and gives each its name.
#ifndef WRINKLE_HARNESS
#define WRINKLE_HARNESS(name) extern "C" int LLVMFuzzerTestOneInput
#endif

/// What the harnesses share. Each is a program of libFuzzer's, which calls LLVMFuzzerTestOneInput with bytes of its own
/// making, mutated from a corpus; run.sh runs them all.
namespace wrinkle::fuzz {

/// Calls `read` with the name of a file that holds the bytes. An Error is the right answer to nearly all of them;
/// anything else that is thrown, a crash, a hang and a sanitizer's report are finds.
template <class Read>
int with_file(const std::uint8_t* data, std::size_t size, const char* extension, const Read& read) {
    static const std::filesystem::path file =
        std::filesystem::path("/dev/shm") / ("wrinkle-fuzz-" + std::to_string(::getpid()) + extension);
    static const struct Remover {
        ~Remover() { std::filesystem::remove(file); }
    } remover;
    std::ofstream(file, std::ios::binary | std::ios::trunc)
        .write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
    try {
        read(file);
    } catch (const Error&) {}
    return 0;
}

}  // namespace wrinkle::fuzz
