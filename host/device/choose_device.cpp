#include "device/choose_device.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "base/names.h"
#include "wrinkle/error.h"

namespace wrinkle {

namespace {

/// How many numbers a device works on at once, as far as it tells; GPUs before all else.
std::uint64_t speed(const DeviceInfo& info, unsigned processors) {
    const bool limited = info.type == "cpu" && processors > 0;
    const std::uint64_t units = limited ? std::min(info.compute_units, processors) : info.compute_units;
    const std::uint64_t width = units * static_cast<std::uint64_t>(info.lanes);
    return info.type == "gpu" ? width + (std::uint64_t{1} << 62) : info.type == "cpu" ? width : 0;
}

bool matches(const DeviceInfo& info, std::size_t number, const std::string& wanted) {
    if (wanted == fmt::format("{}", number) || wanted == info.type) return true;
    if (wanted.size() < 2 || wanted.find_first_not_of("0123456789") == std::string::npos) return false;
    return std::ranges::any_of(std::array{&info.name, &info.platform, &info.version},
                               [&](const std::string* text) { return contains_ignoring_case(*text, wanted); });
}

}  // namespace

std::size_t choose_device(std::span<const DeviceInfo> devices, const std::string& wanted, unsigned processors) {
    const auto fastest = [&] {
        return std::ranges::max_element(devices, {}, [&](const DeviceInfo& info) { return speed(info, processors); });
    };
    if (wanted.empty()) return static_cast<std::size_t>(fastest() - devices.begin());
    const std::string name = lower(wanted);
    std::string listing;
    for (std::size_t i = 0; i < devices.size(); ++i) {
        if (matches(devices[i], i, name)) return i;
        listing += fmt::format("\n  {}: {} ({}, {})", i, devices[i].name, devices[i].type, devices[i].platform);
    }
    throw Error(fmt::format(
        "no OpenCL device \"{}\"; give a number, a type (cpu, gpu) or a part of a name, platform or version of:{}",
        wanted, listing));
}

}  // namespace wrinkle
