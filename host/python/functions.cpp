#include "wrinkle/functions.h"

#include <nanobind/stl/filesystem.h>
#include <nanobind/stl/map.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/variant.h>
#include <nanobind/stl/vector.h>

#include "python/bindings.h"
#include "wrinkle/error.h"

namespace nb = nanobind;

namespace wrinkle::python {

namespace {

/// A parameter or result: its name and the names of its columns.
nb::list columns_of(const auto& items) {
    nb::list out;
    for (const Parameter& item : items) {
        nb::list names;
        for (const std::string& column : item.columns()) names.append(column);
        out.append(nb::make_tuple(item.name, names, item.unit, item.meaning));
    }
    return out;
}

nb::dict describe(const Function& function) {
    nb::list settings;
    for (const Setting& setting : function.settings) settings.append(nb::make_tuple(setting.name, setting.meaning));
    nb::dict out;
    out["name"] = function.name;
    out["summary"] = function.summary;
    out["source"] = function.source;
    out["note"] = function.note;
    out["parameters"] = columns_of(function.parameters);
    out["results"] = columns_of(function.results);
    out["settings"] = settings;
    return out;
}

Precision precision_of(const std::string& name) {
    for (const Precision precision : {Precision::fast, Precision::standard, Precision::exact})
        if (name == precision_name(precision)) return precision;
    throw Error("no precision is called \"" + name + "\"; there are \"fast\", \"standard\" and \"exact\"");
}

template <class In, class Out>
void evaluate(const Device& device, const std::string& name, const std::map<std::string, In>& in,
              const std::map<std::string, Out>& out, const std::string& precision,
              const std::map<std::string, std::variant<std::vector<double>, std::filesystem::path>>& settings) {
    std::map<std::string, std::span<typename In::Scalar>> columns;
    for (const auto& [column, array] : in) columns.emplace(column, std::span(array.data(), array.size()));
    std::map<std::string, std::span<typename Out::Scalar>> results;
    for (const auto& [column, array] : out) results.emplace(column, std::span(array.data(), array.size()));
    FunctionOptions options{.precision = precision_of(precision)};
    for (const auto& [setting, value] : settings)
        std::visit([&](const auto& given) { options.settings.emplace(setting, given); }, value);
    nb::gil_scoped_release unlocked;
    evaluate_function(device, function(name), columns, results, options);
}

}  // namespace

void bind_functions(nb::module_& module) {
    module.def("function_names", [] {
        std::vector<std::string> names;
        for (const Function& function : functions()) names.push_back(function.name);
        return names;
    });
    module.def("describe_function", [](const std::string& name) { return describe(function(name)); });
    module.def("evaluate_function", &evaluate<PlaneIn, PlaneOut>, nb::arg("device"), nb::arg("name"), nb::arg("inputs"),
               nb::arg("outputs"), nb::arg("precision"), nb::arg("settings"));
    module.def("evaluate_function", &evaluate<DoublesIn, DoublesOut>, nb::arg("device"), nb::arg("name"),
               nb::arg("inputs"), nb::arg("outputs"), nb::arg("precision"), nb::arg("settings"));
}

}  // namespace wrinkle::python
