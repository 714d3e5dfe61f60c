#pragma once

#include <filesystem>

#include "record.h"

namespace wrinkle::bench {

void print(const Run& run);

void write_json(const Run& run, const std::filesystem::path& file);

/// Throws Error when there is none and none can be made.
void make_folder(const std::filesystem::path& folder);

/// run.json, run.csv, the charts as SVG, and index.html, which holds all of it in one file.
void write_report(const Run& run, const std::filesystem::path& folder);

/// The charts, as SVG texts by name: "pareto-NAME" for every function and scene with more than one variant, "roofline",
/// "sizes". Throws Error when gnuplot is missing or fails.
std::map<std::string, std::string> charts(const Run& run);

/// One self-contained page: the machine, the charts, every measurement.
std::string html(const Run& run, const std::map<std::string, std::string>& charts);

}  // namespace wrinkle::bench
