#pragma once

#include <filesystem>

#include "record.h"

namespace wrinkle::bench {

void print(const Run& run);

void write_json(const Run& run, const std::filesystem::path& file);

/// Makes the folder unless it is there. Throws Error when that fails.
void make_folder(const std::filesystem::path& folder);

/// Writes run.json, run.csv, the charts as SVG, and index.html, a single page with all of it.
void write_report(const Run& run, const std::filesystem::path& folder);

/// The charts as SVG, by name: "pareto-NAME" for everything that has several variants, "roofline", "sizes". Throws
/// Error when gnuplot is missing or fails.
std::map<std::string, std::string> charts(const Run& run);

/// One self-contained page: the machine, the charts, every measurement.
std::string html(const Run& run, const std::map<std::string, std::string>& charts);

}  // namespace wrinkle::bench
