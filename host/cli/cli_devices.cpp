#include <fmt/format.h>

#include <cstdlib>
#include <nlohmann/json.hpp>

#include "cli/commands.h"
#include "cli/json_text.h"
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

}  // namespace

void add_devices(CLI::App& app) {
    auto json = std::make_shared<bool>(false);
    CLI::App* command = app.add_subcommand("devices", "List the OpenCL devices of this machine");
    command->add_flag("--json", *json, "print as JSON");
    command->callback([json] { devices(*json); });
}

}  // namespace wrinkle::cli
