#include "device/kernel_sources.h"

#include <fmt/format.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>

#include "wrinkle/error.h"

namespace wrinkle {

namespace {

/// `name`: of the file that the text is from, until a #line 1 names another.
void expand(const std::string& text, std::string name, std::set<std::string>& seen, std::string& out) {
    std::istringstream lines(text);
    std::string line;
    out += fmt::format("#line 1 \"{}\"\n", name);
    for (int number = 1; std::getline(lines, line); ++number) {
        if (!line.starts_with("#include \"")) {
            out += line + '\n';
            if (const auto quote = line.find('"'); line.starts_with("#line 1 ") && quote != std::string::npos)
                name = line.substr(quote + 1, line.rfind('"') - quote - 1), number = 0;
            continue;
        }
        const std::size_t start = line.find('"') + 1;
        const std::string file = line.substr(start, line.find('"', start) - start);
        if (seen.insert(file).second) expand(kernel_source(file), file, seen, out);
        out += fmt::format("#line {} \"{}\"\n", number + 1, name);
    }
}

}  // namespace

std::string kernel_source(const std::string& name) {
    if (const char* folder = std::getenv("WRINKLE_KERNEL_DIR"); folder != nullptr && *folder != '\0') {
        const std::filesystem::path file = std::filesystem::path(folder) / name;
        std::ifstream in(file, std::ios::binary);
        if (!in) throw Error(fmt::format("WRINKLE_KERNEL_DIR: cannot read {}", file.string()));
        return {std::istreambuf_iterator<char>(in), {}};
    }
    for (const KernelSource& source : embedded_kernel_sources())
        if (name == source.name) return source.text;
    throw Error(fmt::format("no kernel file \"{}\"", name));
}

std::string expand_includes(const std::string& text, const std::string& name) {
    std::set<std::string> seen;
    std::string out;
    expand(text, name, seen, out);
    return out;
}

}  // namespace wrinkle
