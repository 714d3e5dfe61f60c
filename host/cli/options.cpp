#include "cli/options.h"

#include <limits>

namespace wrinkle::cli {

void add_device_option(CLI::App& command, std::string& device) {
    command.add_option("--device", device, "number, type (cpu, gpu) or part of a name; see \"wrinkle devices\"")
        ->type_name("DEVICE");
}

void add_max_error_option(CLI::App& command, std::optional<double>& max_error, const std::string& what) {
    command.add_option("--max-error", max_error, "largest error of a normal, degrees: " + what)
        ->type_name("DEGREES")
        ->check(CLI::Range(std::numeric_limits<double>::min(), 180.0));
}

}  // namespace wrinkle::cli
