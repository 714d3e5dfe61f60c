#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>

#include "volume.h"
#include "wrinkle/error.h"

int main(int argc, char** argv) {
    CLI::App app{"Measures samples of sparse volumes, against NanoVDB's C++ in the same run."};
    int size = 256, repetitions = 15;
    std::string device_name;
    app.add_option("--size", size, "voxels along an edge, a multiple of 8")->capture_default_str();
    app.add_option("--repetitions", repetitions, "times that each contender runs; medians are reported")
        ->capture_default_str()
        ->check(CLI::Range(3, 1000));
    app.add_option("--device", device_name, "OpenCL device; see \"wrinkle devices\"");
    CLI11_PARSE(app, argc, argv);
    try {
        const wrinkle::Device device = wrinkle::Device::open(device_name);
        fmt::print("{} ({} lanes), {}^3 voxels\n", device.info.name, device.info.lanes, size);
        std::string walk;
        for (const wrinkle::bench::VolumeRow& row : wrinkle::bench::measure_volumes(device, size, repetitions)) {
            if (row.walk != walk)
                fmt::print("\n{:<42}{:>8} {:>8} {:>7}  relative error: median, p99, max\n", row.walk, "ns", "best",
                           "ratio");
            walk = row.walk;
            fmt::print("  {:<40}{:>8.2f} {:>8.2f} {:>7.2f}  ", row.name, row.ns, row.best_ns, row.ratio);
            if (row.max > 0)
                fmt::print("{:.1e} {:.1e} {:.1e}\n", row.median, row.p99, row.max);
            else
                fmt::print("see tests/cases/volume.h\n");
        }
    } catch (const wrinkle::Error& error) {
        fmt::print(stderr, "wrinkle_bench_volume: {}\n", error.what());
        return 1;
    }
    return 0;
}
