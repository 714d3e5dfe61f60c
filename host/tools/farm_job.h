#pragma once

#include <string>
#include <vector>

namespace wrinkle {

/// A sequence that a farm is to evaluate, in tasks of some frames each.
struct FarmJob {
    std::string name;
    std::vector<std::string> command;  ///< of every task, up to the frames that it is given, which come last
    std::vector<int> frames;           ///< at least one
    int chunk = 20;                    ///< frames a task, at most; >= 1
};

/// Frame numbers as text, in their order: "1-20", "1-9x2", "1,3,7-9". `step` is what stands before the step of a range;
/// --frames takes ":" and "x".
std::string frames_text(const std::vector<int>& frames, const std::string& step = "x");

/// A template of the Open Job Description, of 2023-09 with its extension TASK_CHUNKING.
/// Source: github.com/OpenJobDescription/openjd-specifications, "Template Schemas", version 2023-09.
std::string openjd_template(const FarmJob& job);

/// A script for sbatch: an array with a task a chunk, which Slurm puts into its queue again when a node is lost.
std::string slurm_script(const FarmJob& job);

/// A Python script that submits an outline of OpenCue, which takes show and shot from the environment.
std::string opencue_outline(const FarmJob& job);

}  // namespace wrinkle
