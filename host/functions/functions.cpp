#include "wrinkle/functions.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/names.h"
#include "device/guarded.h"
#include "functions/tables.h"
#include "wrinkle/error.h"

namespace wrinkle {

namespace {

std::vector<std::string> all_columns(const auto& parameters) {
    std::vector<std::string> out;
    for (const Parameter& parameter : parameters)
        for (std::string& column : parameter.columns()) out.push_back(std::move(column));
    return out;
}

/// Checks columns against what the function has; gives the number of rows.
template <class Map>
std::size_t check_columns(const Function& function, const Map& columns, const std::vector<std::string>& known, bool all,
                          const char* what) {
    const auto fail = [&](const std::string& text) { throw Error(fmt::format("{}: {}", function.name, text)); };
    for (const auto& [name, values] : columns)
        if (std::ranges::find(known, name) == known.end())
            fail(fmt::format("has no {} column \"{}\"{}", what, name, did_you_mean(name, known)));
    std::size_t rows = columns.empty() ? 0 : columns.begin()->second.size();
    for (const std::string& name : known) {
        const auto found = columns.find(name);
        if (found == columns.end() && all) fail(fmt::format("needs the {} column \"{}\"", what, name));
        if (found != columns.end() && found->second.size() != rows)
            fail(fmt::format("the {} column \"{}\" has {} rows, \"{}\" has {}", what, name, found->second.size(),
                             columns.begin()->first, rows));
    }
    return rows;
}

template <class T>
void evaluate(const Device& device, const Function& function, const std::map<std::string, std::span<const T>>& in,
              const std::map<std::string, std::span<T>>& out, const FunctionOptions& options) {
    const std::vector<std::string> results = all_columns(function.results);
    const std::size_t rows = check_columns(function, in, all_columns(function.parameters), true, "input"),
                      wanted = check_columns(function, out, results, false, "result");
    if (!out.empty() && wanted != rows)
        throw Error(fmt::format("{}: {} rows of results for {} rows of input", function.name, wanted, rows));
    const bool fp64 = std::is_same_v<T, double>;
    if (fp64 && !device.info.fp64)
        throw Error(fmt::format("{} has no double precision (cl_khr_fp64); evaluate in float, or on another device",
                                device.info.name));
    const int lanes = options.lanes != 0 ? options.lanes : std::min(device.info.lanes, fp64 ? 8 : 16);
    const ColumnKernel kernel = column_kernel(function, function.variant(fp64 ? Precision::fp64 : options.precision));
    const ColumnData data = column_data(function, options.settings, device.info);
    const auto got = run_columns<T>(device, kernel, in, lanes, data);
    for (const auto& [name, values] : out)
        std::ranges::copy(got[static_cast<std::size_t>(std::ranges::find(results, name) - results.begin())],
                          values.begin());
}

}  // namespace

std::string precision_name(Precision precision) {
    const char* const names[] = {"fast", "standard", "exact", "double"};
    return names[static_cast<int>(precision)];
}

std::vector<std::string> Parameter::columns() const {
    switch (shape) {
        case Shape::number:
            return {name};
        case Shape::pair:
            return {name + ".x", name + ".y"};
        case Shape::vector:
            break;
    }
    return {name + ".x", name + ".y", name + ".z"};
}

const FunctionVariant& Function::variant(Precision wanted) const {
    for (const FunctionVariant& variant : variants)
        if (variant.precision >= wanted) return variant;
    return variants.back();
}

const std::vector<Function>& functions() {
    static const std::vector<Function> all = [] {
        std::vector<Function> table;
        for (auto part : {surface_functions, source_functions, projector_functions, noise_functions, volume_functions,
                          compose_functions, prologue_functions, displacement_functions})
            for (Function& function : part()) table.push_back(std::move(function));
        return table;
    }();
    return all;
}

const Function& function(const std::string& name) {
    std::vector<std::string> names;
    for (const Function& function : functions()) {
        if (function.name == name) return function;
        names.push_back(function.name);
    }
    throw Error(
        fmt::format("there is no function \"{}\"{} (wrinkle eval --list shows all)", name, did_you_mean(name, names)));
}

std::string every_column_kernel() {
    const std::string include = "#include \"wrinkle.clh\"\n", name = "void wr_columns(";
    std::string text = include;
    for (const Function& function : functions())
        for (const FunctionVariant& variant : function.variants) {
            std::vector<std::string> columns = all_columns(function.parameters);
            std::ranges::sort(columns);
            std::string source = column_kernel_source(column_kernel(function, variant), columns, {});
            source.replace(source.find(include), include.size(), "");
            source.replace(source.find(name), name.size(),
                           fmt::format("void wr_columns_{}_{}(", function.name, precision_name(variant.precision)));
            text += source;
        }
    return text;
}

void evaluate_function(const Device& device, const Function& function, const Columns& in, const ColumnResults& out,
                       const FunctionOptions& options) {
    guarded("evaluate a function", [&] { evaluate<float>(device, function, in, out, options); });
}

void evaluate_function(const Device& device, const Function& function, const ColumnsInDouble& in,
                       const ColumnResultsInDouble& out, const FunctionOptions& options) {
    guarded("evaluate a function", [&] { evaluate<double>(device, function, in, out, options); });
}

}  // namespace wrinkle
