#pragma once

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>

namespace wrinkle::test {

inline bool has_clang() { return !std::string(WRINKLE_CLANG).ends_with("NOTFOUND"); }

/// What clang says of an OpenCL program that includes kernels, nothing when it is content. Far quicker than a build.
inline std::string clang_complaints(const std::string& text, const std::string& flags) {
    const std::filesystem::path file =
        std::filesystem::temp_directory_path() / fmt::format("wrinkle_include_{}.cl", ::getpid());
    std::ofstream(file) << text;
    const std::string command = fmt::format(
        "{} -x cl -Xclang -finclude-default-header -Xclang -fdeclare-opencl-builtins -fsyntax-only -I{}/kernels {} {} "
        "2>&1",
        WRINKLE_CLANG, WRINKLE_SOURCE_DIR, flags, file.string());
    std::FILE* pipe = ::popen(command.c_str(), "r");
    std::string said;
    char part[4096];
    while (std::fgets(part, sizeof part, pipe) != nullptr) said += part;
    if (::pclose(pipe) != 0 && said.empty()) said = "clang failed: " + command;
    std::filesystem::remove(file);
    return said;
}

}  // namespace wrinkle::test
