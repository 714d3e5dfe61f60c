#include "tools/farm_job.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <nlohmann/json.hpp>

namespace wrinkle {

namespace {

using Json = nlohmann::ordered_json;

std::vector<std::string> command_with(const FarmJob& job, const std::string& frames) {
    std::vector<std::string> command = job.command;
    command.push_back(frames);
    return command;
}

/// In single quotes, as shells read it.
std::string shell_quote(const std::string& text) {
    std::string quoted = "'";
    for (const char c : text) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return quoted + "'";
}

/// Strings of JSON are strings of Python.
std::string quote(const std::string& text) { return Json(text).dump(-1, ' ', true, Json::error_handler_t::replace); }

std::string pretty(const Json& json) { return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n"; }

bool are_contiguous(const std::vector<int>& frames) {
    return std::ranges::adjacent_find(frames, [](int a, int b) { return b != a + 1; }) == frames.end();
}

}  // namespace

std::string frames_text(const std::vector<int>& frames, const std::string& step) {
    std::vector<std::string> parts;
    for (std::size_t begin = 0; begin < frames.size();) {
        // A range is as many numbers as go on by the same positive step: two by 1, three by any other.
        std::size_t end = begin + 1;
        const int by = end < frames.size() ? frames[end] - frames[begin] : 0;
        while (by > 0 && end < frames.size() && frames[end] - frames[end - 1] == by) ++end;
        if (end - begin < (by == 1 ? 2u : 3u)) end = begin + 1;
        std::string part = fmt::format("{}", frames[begin]);
        if (end - begin > 1) part += fmt::format("-{}", frames[end - 1]);
        if (end - begin > 1 && by > 1) part += fmt::format("{}{}", step, by);
        parts.push_back(part);
        begin = end;
    }
    return fmt::format("{}", fmt::join(parts, ","));
}

std::string openjd_template(const FarmJob& job) {
    const std::vector<std::string> command = command_with(job, "{{Task.Param.Frames}}");
    const Json parameter{{"name", "Frames"},
                         {"type", "CHUNK[INT]"},
                         {"range", frames_text(job.frames, ":")},
                         {"chunks",
                          {{"defaultTaskCount", job.chunk},
                           {"rangeConstraint", are_contiguous(job.frames) ? "CONTIGUOUS" : "NONCONTIGUOUS"}}}};
    const Json run{{"command", command.front()}, {"args", Json(std::vector(command.begin() + 1, command.end()))}};
    const Json step{{"name", "Evaluate"},
                    {"parameterSpace", {{"taskParameterDefinitions", Json::array({parameter})}}},
                    {"script", {{"actions", {{"onRun", run}}}}}};
    return pretty(Json{{"specificationVersion", "jobtemplate-2023-09"},
                       {"extensions", {"TASK_CHUNKING"}},
                       {"name", job.name},
                       {"steps", Json::array({step})}});
}

std::string slurm_script(const FarmJob& job) {
    std::vector<std::string> chunks, command;
    const auto chunk = static_cast<std::size_t>(job.chunk);
    for (std::size_t first = 0; first < job.frames.size(); first += chunk) {
        const auto begin = job.frames.begin() + static_cast<std::ptrdiff_t>(first);
        const auto count = static_cast<std::ptrdiff_t>(std::min(chunk, job.frames.size() - first));
        chunks.push_back(frames_text({begin, begin + count}));
    }
    for (const std::string& argument : job.command) command.push_back(shell_quote(argument));
    return fmt::format(
        "#!/bin/bash\n"
        "#SBATCH --job-name=wrinkle\n"
        "#SBATCH --array=0-{}\n"
        "#SBATCH --requeue\n"
        "chunks=({})\n"
        "exec {} \"${{chunks[$SLURM_ARRAY_TASK_ID]}}\"\n",
        chunks.size() - 1, fmt::join(chunks, " "), fmt::join(command, " "));
}

std::string opencue_outline(const FarmJob& job) {
    // OpenCue joins the words by spaces, and a shell reads them.
    std::vector<std::string> command;
    for (const std::string& argument : job.command) command.push_back(quote(shell_quote(argument)));
    command.push_back(quote("#FRAMESPEC#"));
    return fmt::format(
        "#!/usr/bin/env python3\n"
        "import getpass\n"
        "\n"
        "import outline\n"
        "import outline.cuerun\n"
        "from outline.modules.shell import Shell\n"
        "\n"
        "job = outline.Outline({}, user=getpass.getuser())\n"
        "job.add_layer(\n"
        "    Shell(\n"
        "        \"evaluate\",\n"
        "        command=[{}],\n"
        "        range={},\n"
        "        chunk={},\n"
        "    )\n"
        ")\n"
        "if __name__ == \"__main__\":\n"
        "    outline.cuerun.launch(job, use_pycuerun=False)\n",
        quote(job.name), fmt::join(command, ", "), quote(frames_text(job.frames)), job.chunk);
}

}  // namespace wrinkle
