#include "record.h"

#include <fmt/format.h>

#include <fstream>

#include "wrinkle/error.h"

namespace wrinkle::bench {

namespace {

using nlohmann::json;

json stats_json(const ErrorStats& e) {
    return {{"median", e.median}, {"p99", e.p99}, {"max", e.max}, {"samples", e.samples}, {"not_finite", e.not_finite}};
}

ErrorStats stats_of(const json& j) {
    return {j.at("median"), j.at("p99"), j.at("max"), j.at("samples"), j.at("not_finite")};
}

json measurement_json(const Measurement& m) {
    json hard = json::object();
    for (const auto& [category, stats] : m.hard) hard[category] = stats_json(stats);
    return {{"group", m.group},
            {"name", m.name},
            {"variant", m.variant},
            {"lanes", m.lanes},
            {"pixels", m.pixels},
            {"seconds", m.seconds.median},
            {"spread", m.seconds.spread},
            {"rounds", m.seconds.runs.size()},
            {"ns_per_pixel", m.ns_per_pixel()},
            {"bytes_per_pixel", m.bytes},
            {"operations_per_pixel", m.operations},
            {"operations_at_most", m.at_most},
            {"error_unit", m.unit},
            {"error", stats_json(m.error)},
            {"error_hard", hard},
            {"documented_error", m.bound},
            {"memory_bytes", m.memory},
            {"figures", m.figures},
            {"hash", m.hash}};
}

Measurement measurement_of(const json& j) {
    Measurement m;
    m.group = j.at("group"), m.name = j.at("name"), m.variant = j.at("variant"), m.lanes = j.at("lanes");
    m.pixels = j.at("pixels"), m.seconds = {j.at("seconds"), j.at("spread"), {}};
    m.bytes = j.at("bytes_per_pixel"), m.operations = j.at("operations_per_pixel"), m.unit = j.at("error_unit");
    m.error = stats_of(j.at("error"));
    for (const auto& [category, stats] : j.at("error_hard").items()) m.hard[category] = stats_of(stats);
    m.bound = j.at("documented_error"), m.hash = j.at("hash"), m.memory = j.value("memory_bytes", 0.0);
    m.at_most = j.value("operations_at_most", false);
    if (j.contains("figures")) m.figures = j.at("figures");
    return m;
}

json bar_json(const Bar& b) {
    return {{"name", b.name},
            {"ratio", b.ratio},
            {"spread", b.spread},
            {"bounds", {b.low, b.high}},
            {b.at_most ? "at_most" : "at_least", b.limit},
            {"verdict", b.verdict},
            {"of", b.of},
            {"to", b.to},
            {"error_p99_of", b.of_p99},
            {"error_p99_to", b.to_p99},
            {"error_unit", b.unit}};
}

Bar bar_of(const json& j) {
    Bar b{j.at("name"), j.at("verdict"), j.at("ratio"), j.at("spread")};
    b.at_most = j.contains("at_most");
    if (j.contains("bounds")) b.low = j.at("bounds").at(0), b.high = j.at("bounds").at(1);
    b.limit = j.at(b.at_most ? "at_most" : "at_least");
    b.of = j.at("of"), b.to = j.at("to");
    b.of_p99 = j.at("error_p99_of"), b.to_p99 = j.at("error_p99_to"), b.unit = j.at("error_unit");
    return b;
}

}  // namespace

std::string Measurement::key() const { return fmt::format("{}/{}/{}/{}/{}", group, name, variant, lanes, pixels); }

Measurement measured(const std::string& group, const std::string& name, const Contender& contender, int lanes,
                     std::size_t pixels) {
    return {.group = group,
            .name = name,
            .variant = contender.name,
            .lanes = lanes,
            .pixels = pixels,
            .seconds = contender.seconds};
}

json to_json(const Run& run) {
    json list = json::array();
    for (const Measurement& m : run.measurements) list.push_back(measurement_json(m));
    json bars = json::array();
    for (const Bar& b : run.bars) bars.push_back(bar_json(b));
    return {{"wrinkle_bench", 2},
            {"processor", run.processor},
            {"device", run.device},
            {"command", run.command},
            {"repetitions", run.rounds.least},
            {"seconds_a_race", run.rounds.seconds},
            {"ceilings",
             {{"copy_gb_per_s", run.ceilings.copy_gb_s},
              {"triad_gb_per_s", run.ceilings.triad_gb_s},
              {"fma_gflop_per_s", run.ceilings.fma_gflop_s},
              {"streamed_triad_gb_per_s", run.ceilings.streamed_triad_gb_s}}},
            {"bars", bars},
            {"measurements", list}};
}

Run read_run(const std::string& file) {
    std::ifstream in(file);
    if (!in) throw Error(fmt::format("cannot read {}", file));
    try {
        const json j = json::parse(in);
        if (const int version = j.at("wrinkle_bench"); version != 1 && version != 2)
            throw Error(fmt::format("{}: written by another version of wrinkle bench", file));
        Run run;
        run.processor = j.at("processor"), run.device = j.at("device"), run.command = j.at("command");
        run.rounds = {j.at("repetitions"), j.value("seconds_a_race", 0.0)};
        const json& c = j.at("ceilings");
        run.ceilings = {c.at("copy_gb_per_s"), c.at("triad_gb_per_s"), c.at("fma_gflop_per_s"),
                        c.value("streamed_triad_gb_per_s", 0.0)};
        for (const json& m : j.at("measurements")) run.measurements.push_back(measurement_of(m));
        for (const json& b : j.value("bars", json::array())) run.bars.push_back(bar_of(b));
        return run;
    } catch (const json::exception&) {
        throw Error(fmt::format("{} is no report of wrinkle bench; write one with --json or --report", file));
    }
}

std::string hash_of(const void* data, std::size_t bytes) {
    std::uint64_t h = 0xcbf29ce484222325u;
    const auto* p = static_cast<const unsigned char*>(data);
    for (std::size_t i = 0; i < bytes; ++i) h = (h ^ p[i]) * 0x100000001b3u;
    return fmt::format("{:016x}", h);
}

std::string processor_name() {
    std::ifstream info("/proc/cpuinfo");
    for (std::string line; std::getline(info, line);)
        if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
    return "unknown";
}

}  // namespace wrinkle::bench
