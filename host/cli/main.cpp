#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <exception>
#include <string>
#include <vector>

#include "cli/commands.h"
#include "cli/process.h"
#include "io/volume_child.h"
#include "wrinkle/error.h"

namespace {

/// The arguments from the last to the first, as CLI11 wants them; "help run" means "run --help", "version" "--version".
std::vector<std::string> reversed_arguments(int argc, char** argv) {
    std::vector<std::string> arguments(argv + 1, argv + argc);
    if (!arguments.empty() && arguments.front() == "version") arguments.front() = "--version";
    if (!arguments.empty() && arguments.front() == "help") {
        arguments.erase(arguments.begin());
        arguments.emplace_back("--help");
    }
    std::ranges::reverse(arguments);
    return arguments;
}

}  // namespace

int main(int argc, char** argv) {
    if (argc > 1 && std::strcmp(argv[1], wrinkle::io::kServeVolume) == 0) return wrinkle::io::serve_volume(argc, argv);
    wrinkle::cli::prepare_process();
    CLI::App app{
        "wrinkle evaluates bump mapping after the render: a G-buffer in, new normals and a lit picture out.\n"
        "\n"
        "Examples:\n"
        "  wrinkle info frame.exr                      what is in a G-buffer, and what that is enough for\n"
        "  wrinkle run courtyard.toml -o out           evaluate a scene; writes out/normal.exr, out/lit.png ...\n"
        "  wrinkle run shot.toml --frames 1-120        a sequence (the scene's file names hold ####)\n"
        "  wrinkle watch courtyard.toml                turn its knobs in a browser\n"
        "  wrinkle explain courtyard.toml              the plan, its expected cost, and the kernel it becomes\n"
        "  wrinkle scatter scene.toml -o decals.csv    place decals on a frame at random\n"
        "  wrinkle decals scene.toml -o gradients.exr  sum up a scene's decals, for other scenes to read\n"
        "  wrinkle fit-lights scene.toml               estimate the lights of a frame from its picture\n"
        "  wrinkle eval resolve < in.csv > out.csv     one kernel function over rows of numbers (wrinkle eval --list)\n"
        "  wrinkle figures data/figures/*.toml         pictures side by side that show what a layer does\n"
        "  wrinkle devices                             where it can run\n"
        "  wrinkle bake-volume golden -o golden.vdb    a volume to try things on\n"
        "  wrinkle bench --report out/bench            how fast and how wrong\n"
        "  wrinkle area courtyard.toml                 what normals miss of each pixel's area, and what more points "
        "cost\n"
        "  wrinkle job shot.toml --frames 1-1000 --for slurm    a sequence, described for a farm\n"
        "  wrinkle tune data/scenes/*.toml             what max_error in a scene chooses by, measured here\n",
        "wrinkle"};
    app.set_version_flag("--version", "wrinkle " WRINKLE_VERSION);
    // 0, so that CLI11 complains of unknown arguments first; a missing one is refused below.
    app.require_subcommand(0, 1);
    app.failure_message(CLI::FailureMessage::help);
    wrinkle::cli::add_run(app);
    wrinkle::cli::add_watch(app);
    wrinkle::cli::add_info(app);
    wrinkle::cli::add_explain(app);
    wrinkle::cli::add_scatter(app);
    wrinkle::cli::add_decals(app);
    wrinkle::cli::add_eval(app);
    wrinkle::cli::add_figures(app);
    wrinkle::cli::add_devices(app);
    wrinkle::cli::add_bake(app);
    wrinkle::cli::add_bench(app);
    wrinkle::cli::add_tune(app);
    wrinkle::cli::add_area(app);
    wrinkle::cli::add_fit_lights(app);
    wrinkle::cli::add_job(app);
    wrinkle::cli::add_limit_options(app);
    try {
        app.parse(reversed_arguments(argc, argv));
        if (app.get_subcommands().empty()) {
            std::fputs(app.help().c_str(), stderr);
            return 2;
        }
    } catch (const CLI::ParseError& error) {
        if (error.get_exit_code() == 0) return app.exit(error);
        const auto used = app.get_subcommands();
        const std::string command = used.empty() ? "" : used.front()->get_name() + " ";
        wrinkle::cli::tell(fmt::format("{}\nRun \"wrinkle {}--help\" for what it can do.", error.what(), command));
        return 2;
    } catch (const wrinkle::Error& error) {
        wrinkle::cli::tell(error.what());
        return 1;
    } catch (const std::bad_alloc&) {
        wrinkle::cli::tell("out of memory");
        return 1;
    } catch (const std::exception& error) {
        if (std::ferror(stdout) != 0) {
            wrinkle::cli::tell("cannot write the output");
            return 1;
        }
        wrinkle::cli::tell(fmt::format("unexpected failure, a defect of wrinkle: {}", error.what()));
        return 3;
    }
    if (std::fflush(stdout) != 0) {
        wrinkle::cli::tell(fmt::format("cannot write the output: {}", std::strerror(errno)));
        return 1;
    }
    return 0;
}
