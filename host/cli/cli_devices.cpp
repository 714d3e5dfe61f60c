#include <fmt/format.h>

#include <cstdlib>
#include <nlohmann/json.hpp>

#include "cli/check_child.h"
#include "cli/commands.h"
#include "cli/device_check.h"
#include "cli/json_text.h"
#include "cli/options.h"
#include "device/choose_device.h"
#include "device/drivers.h"
#include "wrinkle/device.h"

namespace wrinkle::cli {

namespace {

void devices(bool json) {
    const std::vector<DeviceInfo> list = list_devices();
    if (json) {
        nlohmann::json rows = nlohmann::json::array();
        for (const DeviceInfo& device : list)
            rows.push_back({{"name", device.name},
                            {"platform", device.platform},
                            {"type", device.type},
                            {"version", device.version},
                            {"driver", device.driver},
                            {"compute_units", device.compute_units},
                            {"memory_bytes", device.memory},
                            {"own_memory", device.own_memory},
                            {"lanes", device.lanes},
                            {"fp64", device.fp64}});
        fmt::print("{}\n", json_text(rows));
        return;
    }
    for (std::size_t i = 0; i < list.size(); ++i) {
        const DeviceInfo& d = list[i];
        fmt::print(
            "{}: {} ({})\n   {}, driver {}\n   {} compute units, {:.1f} GiB, {} lane{} a work-item, double: {}\n", i,
            d.name, d.type, d.platform, d.driver, d.compute_units, static_cast<double>(d.memory) / (1u << 30), d.lanes,
            d.lanes == 1 ? "" : "s", d.fp64 ? "yes" : "no");
    }
    const char* wanted = std::getenv("WRINKLE_DEVICE");
    const std::string rule =
        wanted != nullptr ? "WRINKLE_DEVICE" : fmt::format("a GPU, else {}; WRINKLE_DEVICE sets another", kFastestCpu);
    fmt::print("without --device: {} ({})\n", choose_device(list, wanted != nullptr ? wanted : ""), rule);
    for (const std::string& driver : broken_drivers()) fmt::print("not loaded: {}\n", driver);
}

struct DevicesArguments {
    bool json = false, check = false;
    WantedCheck wanted;
    std::size_t check_from = 0;
    int check_on = -1;
};

void run(const DevicesArguments& arguments) {
    if (arguments.check_on >= 0) return serve_device_check(arguments.wanted, arguments.check_from, arguments.check_on);
    if (!arguments.check && arguments.wanted != WantedCheck{})
        throw CLI::RequiredError("--check (which --device, --lanes and --only go with)");
    if (arguments.check) return check_device(arguments.wanted, arguments.json);
    devices(arguments.json);
}

}  // namespace

void add_devices(CLI::App& app) {
    auto arguments = std::make_shared<DevicesArguments>();
    CLI::App* command = app.add_subcommand("devices", "List the OpenCL devices of this machine, or check one");
    command->add_flag("--json", arguments->json, "print as JSON");
    command->add_flag(
        "--check", arguments->check,
        "check one, in two minutes at most: transfers, work-groups, whole scenes and every kernel function "
        "against results that the program carries; the status is 1 where errors exceed what is documented");
    add_device_option(*command, arguments->wanted.device);
    add_lanes_option(*command, arguments->wanted.lanes);
    command
        ->add_option("--only", arguments->wanted.only,
                     "checks with this in their names: \"scene\", \"function resolve\"")
        ->type_name("TEXT");
    // What --check starts.
    command->add_option("--check-on", arguments->check_on)->group("");
    command->add_option("--check-from", arguments->check_from)->group("");
    command->callback([arguments] { run(*arguments); });
}

}  // namespace wrinkle::cli
