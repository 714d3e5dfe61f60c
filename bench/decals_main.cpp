#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "decals.h"
#include "wrinkle/error.h"

int main(int argc, char** argv) {
    using namespace wrinkle;
    CLI::App app{"Measures tables of decals: as many covered pixels by few and by many of them, beside plain C++."};
    bench::DecalMeasurement wanted;
    std::string device_name;
    bool no_plain = false;
    app.add_option("--width", wanted.size.width)->capture_default_str()->check(CLI::Range(16, 65536));
    app.add_option("--height", wanted.size.height)->capture_default_str()->check(CLI::Range(16, 65536));
    app.add_option("--counts", wanted.counts, "decals of each table")->capture_default_str();
    app.add_option("--coverage", wanted.coverage, "decals that a pixel lies in, on average")->capture_default_str();
    app.add_option("--repetitions", wanted.repetitions)->capture_default_str()->check(CLI::Range(3, 1000));
    app.add_option("--lanes", wanted.lanes, "pixels a work-item; 0: the device's choice")->capture_default_str();
    app.add_option("--device", device_name, "OpenCL device; see \"wrinkle devices\"");
    app.add_flag("--replace", wanted.replace, "decals that replace by priority");
    app.add_flag("--no-plain", no_plain, "without plain C++");
    app.add_flag("--processor-time", wanted.processor_time,
                 "time of all cores together, for machines that others use too; set OMP_WAIT_POLICY=passive");
    CLI11_PARSE(app, argc, argv);
    wanted.plain = !no_plain;
    try {
        const Device device = Device::open(device_name);
        const std::vector<bench::DecalRow> rows = bench::measure_decals(device, wanted);
        const std::size_t pixels = std::size_t{wanted.size.width} * wanted.size.height;
        const auto ns = [&](const bench::Timing& t) { return t.median / static_cast<double>(pixels) * 1e9; };
        fmt::print("{}, {} x {}, {} repetitions; copy {:.2f} ns/pixel, the pass without decals {:.2f}\n",
                   device.info.name, wanted.size.width, wanted.size.height, wanted.repetitions, ns(rows[0].copy),
                   ns(rows[0].empty));
        fmt::print("  {:<32}{:>9}{:>9}{:>8}{:>9}{:>8}{:>8}{:>9}{:>9}{:>9}{:>10}{:>10}{:>8}\n", "", "coverage",
                   "ns/pixel", "spread", "x first", "bins", "listed", "bins MB", "camera", "ns/decal", "plain", "ratio",
                   "p99 deg");
        for (const bench::DecalRow& r : rows)
            fmt::print(
                "  {:<32}{:>9.2f}{:>9.2f}{:>7.0f}%{:>9.2f}{:>7.1f}%{:>8.2f}{:>9.1f}{:>7.0f}ms{:>9.2f}{:>10.2f}{:>9.2f}x"
                "{:>8.0e}\n",
                r.name, r.coverage, ns(r.pass), 100 * r.pass.spread, r.pass.median / rows[0].pass.median,
                100 * r.bin_share(), r.listed, r.bin_megabytes, 1e3 * r.camera.median, r.per_decal(r.pass, pixels),
                ns(r.plain), r.plain.median / r.pass.median, r.error.p99);
    } catch (const Error& error) {
        fmt::print(stderr, "wrinkle_bench_decals: {}\n", error.what());
        return 1;
    }
    return 0;
}
