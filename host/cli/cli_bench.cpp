#include <unistd.h>

#include <filesystem>
#include <memory>
#include <vector>

#include "cli/commands.h"
#include "wrinkle/error.h"

namespace wrinkle::cli {

namespace {

namespace fs = std::filesystem;

/// The benchmark's program: in bench/ beside this one in the build tree, or in the same folder when it is installed.
fs::path bench_program() {
    std::error_code failed;
    const fs::path self = fs::read_symlink("/proc/self/exe", failed);
    for (const fs::path& folder : {self.parent_path() / "bench", self.parent_path()})
        if (const fs::path program = folder / "wrinkle_bench"; fs::exists(program, failed)) return program;
    throw Error("the benchmark was not built: ./bootstrap bench builds and runs it (cmake -DWRINKLE_BUILD_BENCH=ON)");
}

void bench(const std::vector<std::string>& arguments) {
    const std::string program = bench_program().string();
    std::vector<char*> texts{const_cast<char*>(program.c_str())};
    for (const std::string& argument : arguments) texts.push_back(const_cast<char*>(argument.c_str()));
    texts.push_back(nullptr);
    ::execv(program.c_str(), texts.data());
    throw Error("cannot run " + program);
}

}  // namespace

void add_bench(CLI::App& app) {
    CLI::App* command = app.add_subcommand(
        "bench", "Measure speed beside error; a program of its own: its options are those of wrinkle bench --help");
    command->prefix_command();
    command->set_help_flag();
    command->callback([command] { bench(command->remaining()); });
}

}  // namespace wrinkle::cli
