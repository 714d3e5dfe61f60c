#include "budget/cost_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "base/atomic_file.h"
#include "base/only_errors.h"
#include "base/text_file.h"
#include "device/kernel_sources.h"
#include "device/program_cache.h"
#include "wrinkle/error.h"

namespace wrinkle {

namespace {

constexpr Precision kPrecisions[] = {Precision::fast, Precision::standard, Precision::exact, Precision::fp64};

double number(const nlohmann::json& object, const char* key) {
    const double value = object.at(key).get<double>();
    if (!(value >= 0 && std::isfinite(value))) throw Error(fmt::format("\"{}\" is negative or not finite", key));
    return value;
}

int taps_of(const nlohmann::json& row) {
    const double taps = number(row, "taps");
    if (!(taps >= 1 && taps <= 64 && taps == std::floor(taps)))
        throw Error(fmt::format("\"taps\" is {}, and they are whole numbers from 1 to 64", taps));
    return static_cast<int>(taps);
}

std::vector<DeviceCosts> parse(const std::string& text, const std::string& name) {
    try {
        std::vector<DeviceCosts> tables;
        const auto parsed = nlohmann::json::parse(text);
        for (const auto& entry : parsed.at("devices")) {
            DeviceCosts& table = tables.emplace_back();
            table.device_class = entry.at("class").get<std::string>();
            table.device = entry.at("device").get<std::string>();
            table.driver = entry.at("driver").get<std::string>();
            for (const auto& [kind, variants] : entry.at("kinds").items())
                for (const Precision precision : kPrecisions)
                    if (const auto found = variants.find(precision_name(precision)); found != variants.end())
                        table.kinds[kind][precision] = {number(*found, "ns"), number(*found, "p99"),
                                                        number(*found, "max")};
            const auto areas = entry.value("areas", nlohmann::json::object());  // older tables have none
            for (const auto& [kind, rows] : areas.items())
                for (const auto& row : rows)
                    table.areas[kind][taps_of(row)] = {number(row, "ns"), number(row, "median"), number(row, "p99")};
        }
        return tables;
    } catch (const nlohmann::json::exception&) {
        throw Error(name +
                    ": not a table of costs as \"wrinkle tune\" writes it; remove it, or run \"wrinkle tune\" "
                    "into another file");
    } catch (const Error& error) { throw Error(fmt::format("{}: {}", name, error.what())); }
}

}  // namespace

std::optional<VariantCost> DeviceCosts::find(const std::string& kind, Precision precision) const {
    const auto variants = kinds.find(kind);
    if (variants == kinds.end()) return std::nullopt;
    const auto found = variants->second.find(precision);
    return found == variants->second.end() ? std::nullopt : std::optional(found->second);
}

std::optional<std::pair<int, TapsCost>> DeviceCosts::find_taps(const std::string& kind, int taps) const {
    const auto rows = areas.find(kind);
    if (rows == areas.end()) return std::nullopt;
    const auto above = rows->second.upper_bound(taps);
    return above == rows->second.begin() ? std::nullopt : std::optional(*std::prev(above));
}

std::string device_class(const DeviceInfo& info) {
    return fmt::format("{}, {} lane{}", info.type, info.lanes, info.lanes == 1 ? "" : "s");
}

std::vector<DeviceCosts> shipped_costs() { return parse(kernel_source("precision.json"), "precision.json"); }

DeviceCosts costs_of(const DeviceInfo& info) {
    const std::vector<DeviceCosts> known = shipped_costs();
    if (known.empty()) throw Error("precision.json: holds no device");
    const auto nearness = [&](const DeviceCosts& table) {
        return (table.device_class == device_class(info)) + table.device_class.starts_with(info.type + ",");
    };
    DeviceCosts costs = *std::ranges::max_element(known, {}, nearness);
    const std::filesystem::path file = user_costs_file();
    if (file.empty()) return costs;
    for (const DeviceCosts& own : read_costs(file)) {
        if (own.device != info.name || own.driver != info.driver || own.device_class != device_class(info)) continue;
        costs.device_class = own.device_class, costs.device = own.device, costs.driver = own.driver;
        for (const auto& [kind, variants] : own.kinds) costs.kinds[kind] = variants;
        for (const auto& [kind, rows] : own.areas) costs.areas[kind] = rows;
    }
    return costs;
}

std::filesystem::path user_costs_file() {
    const std::filesystem::path folder = cache_folder();
    return folder.empty() ? folder : folder / "precision.json";
}

std::vector<DeviceCosts> read_costs(const std::filesystem::path& file) {
    if (!std::filesystem::exists(file)) return {};
    return only_errors(file.c_str(), [&] { return parse(read_text(file, "a table of costs"), file.string()); });
}

void write_costs(const std::filesystem::path& file, const std::vector<DeviceCosts>& tables) {
    const auto rounded = [](double v) { return nlohmann::json::parse(fmt::format("{:.3g}", v)); };
    nlohmann::ordered_json devices = nlohmann::ordered_json::array();
    for (const DeviceCosts& table : tables) {
        nlohmann::ordered_json kinds = nlohmann::ordered_json::object();
        for (const auto& [kind, variants] : table.kinds)
            for (const auto& [precision, cost] : variants)
                kinds[kind][precision_name(precision)] = {
                    {"ns", rounded(cost.ns)}, {"p99", rounded(cost.p99)}, {"max", rounded(cost.max)}};
        nlohmann::ordered_json areas = nlohmann::ordered_json::object();
        for (const auto& [kind, rows] : table.areas)
            for (const auto& [taps, cost] : rows)
                areas[kind].push_back({{"taps", taps},
                                       {"ns", rounded(cost.ns)},
                                       {"median", rounded(cost.median)},
                                       {"p99", rounded(cost.p99)}});
        devices.push_back({{"class", table.device_class},
                           {"device", table.device},
                           {"driver", table.driver},
                           {"kinds", kinds},
                           {"areas", areas}});
    }
    const std::string text =
        nlohmann::ordered_json{{"devices", devices}}.dump(1, ' ', false, nlohmann::json::error_handler_t::replace) +
        "\n";
    AtomicFile out(file);
    out.write(text);
    out.commit();
}

}  // namespace wrinkle
