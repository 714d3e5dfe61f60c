#include "cli/options.h"

#include <fmt/format.h>

#include <limits>

namespace wrinkle::cli {

void add_device_option(CLI::App& command, std::string& device) {
    command.add_option("--device", device, "number, type (cpu, gpu) or part of a name; see \"wrinkle devices\"")
        ->type_name("DEVICE");
}

void add_lanes_option(CLI::App& command, int& lanes) {
    command
        .add_option("--lanes", lanes,
                    "pixels a work-item evaluates: 1, 4, 8 or 16; without it what the device is best at")
        ->type_name("N")
        ->check(CLI::Validator(
            [](std::string& text) -> std::string {
                if (text == "1" || text == "4" || text == "8" || text == "16") return {};
                return fmt::format("\"{}\" is given; expected 1, 4, 8 or 16", text);
            },
            ""));
}

void add_set_option(CLI::App& command, std::vector<std::string>& settings) {
    command
        .add_option("--set", settings,
                    "a value in place of the scene's: lighting.exposure=1, layer.NAME.scale=0.02, light.1.intensity=3")
        ->type_name("KEY=VALUE")
        ->allow_extra_args(false);
}

Device open_device(const std::string& device, int lanes) {
    Device opened = Device::open(device);
    if (lanes != 0) opened.info.lanes = lanes;
    return opened;
}

void add_max_error_option(CLI::App& command, std::optional<double>& max_error, const std::string& what) {
    command.add_option("--max-error", max_error, "largest error of a normal, degrees: " + what)
        ->type_name("DEGREES")
        ->check(CLI::Range(std::numeric_limits<double>::min(), 180.0));
}

void add_max_area_error_option(CLI::App& command, std::optional<double>& max_area_error) {
    command
        .add_option("--max-area-error", max_area_error,
                    "degrees by which 99% of the normals may miss the mean over their pixels' areas: takes the fewest "
                    "taps that keep it, by measuring")
        ->type_name("DEGREES")
        ->check(CLI::Range(std::numeric_limits<double>::min(), 180.0));
}

}  // namespace wrinkle::cli
