#pragma once

#include <CLI/CLI.hpp>

namespace wrinkle::cli {

/// Adds a subcommand to the program; what it does runs from the subcommand's callback.
void add_run(CLI::App& app);
void add_info(CLI::App& app);
void add_explain(CLI::App& app);
void add_eval(CLI::App& app);
void add_figures(CLI::App& app);
void add_devices(CLI::App& app);
void add_scatter(CLI::App& app);
/// bake-volume and bake-frame
void add_bake(CLI::App& app);
void add_bench(CLI::App& app);
void add_tune(CLI::App& app);

}  // namespace wrinkle::cli
