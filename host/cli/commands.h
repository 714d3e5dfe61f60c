#pragma once

#include <CLI/CLI.hpp>

namespace wrinkle::cli {

/// Each adds a subcommand to the program. CLI11 calls it back, and so runs the command, while it parses the arguments.
void add_run(CLI::App& app);
void add_watch(CLI::App& app);
void add_info(CLI::App& app);
void add_explain(CLI::App& app);
void add_eval(CLI::App& app);
void add_figures(CLI::App& app);
void add_devices(CLI::App& app);
void add_scatter(CLI::App& app);
void add_decals(CLI::App& app);
/// Adds two commands, bake-volume and bake-frame.
void add_bake(CLI::App& app);
void add_bench(CLI::App& app);
void add_tune(CLI::App& app);
void add_area(CLI::App& app);
void add_fit_lights(CLI::App& app);
void add_job(CLI::App& app);

}  // namespace wrinkle::cli
