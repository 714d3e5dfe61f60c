#include "functions/reference.h"

#include <fmt/format.h>

#include <algorithm>
#include <regex>
#include <sstream>

#include "device/kernel_sources.h"
#include "functions/area_table.h"
#include "functions/kernel_listing.h"
#include "functions/tables.h"

namespace wrinkle {

namespace {

std::string joined(const std::vector<std::string>& parts, const char* between = ", ") {
    std::string text;
    for (const std::string& part : parts) text += (text.empty() ? "" : between) + part;
    return text;
}

/// "1e-6"
std::string digits(double value) {
    std::string text = fmt::format("{:g}", value);
    const std::size_t zero = text.find("e-0");
    if (zero != std::string::npos) text.erase(zero + 2, 1);
    return text;
}

const char* unit_of(ErrorMeasure measure) {
    const char* const units[] = {"degrees", "relative", "absolute", "degrees once resolved"};
    return units[static_cast<int>(measure)];
}

/// "dp_dx, dp_dy 1e-6 relative, 1e-5 degrees": results with the same errors together.
std::string errors_of(const Function& function, const FunctionVariant& variant) {
    std::vector<std::pair<std::string, std::string>> groups;
    std::size_t at = 0;
    for (const Result& result : function.results) {
        std::vector<std::string> errors;
        for (const ErrorMeasure measure : result.measures) {
            const double error = variant.max_errors.at(at++);
            errors.push_back(error == 0 ? "exact" : fmt::format("{} {}", digits(error), unit_of(measure)));
        }
        if (!groups.empty() && groups.back().second == joined(errors))
            groups.back().first += ", " + result.name;
        else
            groups.emplace_back(result.name, joined(errors));
    }
    std::vector<std::string> parts;
    for (const auto& [names, errors] : groups)
        parts.push_back(function.results.size() == 1 ? errors : fmt::format("{}: {}", names, errors));
    return joined(parts, "; ") + (variant.everywhere ? ", everywhere" : "");
}

std::string standard_of(const Setting& setting) {
    std::vector<std::string> numbers;
    for (const double number : setting.standard) numbers.push_back(digits(number));
    const std::string range = range_text(setting);
    return (numbers.empty() ? "required" : "default " + joined(numbers, ",")) + (range.empty() ? "" : ", " + range);
}

/// For a cell of a table.
std::string escaped(std::string text) {
    for (std::size_t at = text.find('|'); at != std::string::npos; at = text.find('|', at + 2))
        text.insert(at, 1, '\\');
    return text;
}

/// Calls `visit` with every concept file and its functions, in the order of the table.
template <class Visit>
void by_file(Visit visit) {
    std::vector<std::string> files;
    for (const Function& function : functions())
        if (std::ranges::find(files, function.file) == files.end()) files.push_back(function.file);
    for (const std::string& file : files) {
        std::vector<const Function*> here;
        for (const Function& function : functions())
            if (function.file == file) here.push_back(&function);
        visit(file, here);
    }
}

/// The kernel files in the order of wrinkle.clh.
std::vector<std::string> files_in_order() {
    std::vector<std::string> files;
    std::istringstream lines(kernel_source("wrinkle.clh"));
    for (std::string line; std::getline(lines, line);)
        if (line.starts_with("#include \"")) files.push_back(line.substr(10, line.rfind('"') - 10));
    return files;
}

/// The structs of layout.h, member by member.
std::string layout_tables() {
    std::string text;
    for (const LayoutStruct& layout : layout_structs(kernel_source("layout.h"))) {
        text +=
            fmt::format("\n### `{}`\n\n{} {} numbers.\n\n| offset | member | numbers | meaning |\n|---|---|---|---|\n",
                        layout.name, layout.meaning, layout.size);
        for (const LayoutMember& member : layout.members)
            text += fmt::format("| {} | `{}` | {} | {} |\n", member.offset, member.name, member.count,
                                escaped(member.meaning));
    }
    return text;
}

/// What a kernel file declares, as C, and the text that it begins with.
std::string declarations_of(const std::string& file) {
    const std::string source = kernel_source(file);
    std::string text = "```c\n";
    std::istringstream summary(kernel_file_summary(source));
    for (std::string line; std::getline(summary, line);) text += line.empty() ? "//\n" : "// " + line + '\n';
    for (const KernelItem& item : kernel_items(source)) {
        text += '\n' + item.comment;
        for (const std::string& declaration : item.declarations) text += declaration + '\n';
    }
    return text + "```\n";
}

/// The functions of the kernels that the text of a function's variants calls.
std::string calls_of(const Function& function) {
    static const std::regex call("\\b(wr_\\w+)\\(");
    std::vector<std::string> declared, called;
    for (const KernelItem& item : kernel_items(kernel_source(function.file)))
        for (const std::string& declaration : item.declarations)
            if (item.function) declared.push_back(declaration);
    for (const FunctionVariant& variant : function.variants)
        for (std::sregex_iterator at(variant.text.begin(), variant.text.end(), call), none; at != none; ++at) {
            const std::string name = (*at)[1];
            const bool here = std::ranges::any_of(
                declared, [&](const std::string& text) { return text.find(' ' + name + '(') != std::string::npos; });
            if (here && std::ranges::find(called, name) == called.end()) called.push_back(name);
        }
    return called.empty() ? "" : "<br>calls " + joined(called);
}

std::string line(const std::string& left, const std::string& right) {
    return fmt::format("  {:<26} {}\n", left, right);
}

/// The functions of a file that can be asked one at a time, as a table.
std::string evaluated_functions(const std::vector<const Function*>& here) {
    std::string text =
        "\n| `wrinkle eval` | what | takes | gives | largest error | source |\n|---|---|---|---|---|---|\n";
    for (const Function* function : here) {
        std::vector<std::string> takes, gives, errors;
        for (const Parameter& parameter : function->parameters)
            takes.push_back(fmt::format("`{}` {}; {}", joined(parameter.columns()), parameter.meaning, parameter.unit));
        for (const Setting& setting : function->settings)
            takes.push_back(fmt::format("setting `{}` {}; {}; {}", setting.name, setting.meaning,
                                        wanted_text(setting.kind), standard_of(setting)));
        for (const Result& result : function->results)
            gives.push_back(fmt::format("`{}` {}; {}", joined(result.columns()), result.meaning, result.unit));
        for (const FunctionVariant& variant : function->variants)
            errors.push_back(fmt::format("{} {}", precision_name(variant.precision), errors_of(*function, variant)));
        if (function->fp64_error != Function{}.fp64_error)
            errors.push_back(fmt::format("double {}", digits(function->fp64_error)));
        if (!function->note.empty()) errors.push_back(function->note);
        const std::string cells[] = {'`' + function->name + '`' + calls_of(*function),
                                     function->summary,
                                     joined(takes, "<br>"),
                                     joined(gives, "<br>"),
                                     joined(errors, "<br>"),
                                     function->source};
        for (const std::string& cell : cells) text += "| " + escaped(cell) + " ";
        text += "|\n";
    }
    return text;
}

}  // namespace

std::string function_list() {
    std::string text;
    by_file([&](const std::string& file, const std::vector<const Function*>& here) {
        text += fmt::format("{}kernels/{}\n", text.empty() ? "" : "\n", file);
        for (const Function* function : here) {
            text += fmt::format("  {}\n      {}\n", function->name, function->summary);
            for (const FunctionVariant& variant : function->variants)
                text +=
                    fmt::format("      {:<9} {}\n", precision_name(variant.precision), errors_of(*function, variant));
        }
    });
    return text;
}

std::string function_example(const Function& function) {
    std::vector<std::string> columns, cells;
    for (const Parameter& parameter : function.parameters) {
        const bool normal = parameter.unit_length || parameter.name == "n";
        const char* const values[] = {normal ? "0" : "0.25", normal ? "0" : "0.5", normal ? "1" : "0.75"};
        std::size_t k = 0;
        for (std::string& column : parameter.columns())
            columns.push_back(std::move(column)), cells.push_back(values[k++]);
    }
    std::string settings;
    for (const Setting& setting : function.settings) {
        if (!setting.standard.empty()) continue;
        const char* value = "data/textures/cobbles_height.png";
        if (setting.kind == Setting::Kind::camera) value = "data/gbuffer/small.camera.json";
        if (setting.kind == Setting::Kind::volume) value = "data/volumes/noise.vdb";
        if (setting.kind == Setting::Kind::smooth_volume) value = "data/volumes/noise.vdb";
        if (setting.kind == Setting::Kind::vector_volume) value = "gradient.vdb";
        if (setting.kind == Setting::Kind::number) value = "1";
        if (setting.kind == Setting::Kind::vector) value = "0,0,1";
        if (setting.kind == Setting::Kind::projector) value = "0,0,0,0,1,0,0,0,1,0,1,1,1";
        if (setting.kind == Setting::Kind::lattice) value = "1,2";
        settings += fmt::format(" --set {}={}", setting.name, value);
    }
    return fmt::format("printf '{}\\n{}\\n' | wrinkle eval {}{}", joined(columns, ","), joined(cells, ","),
                       function.name, settings);
}

std::string function_help(const Function& function) {
    std::vector<std::string> parameters, results;
    for (const Parameter& parameter : function.parameters) parameters.push_back(parameter.name);
    for (const Result& result : function.results) results.push_back(result.name);
    std::string text = fmt::format("{}({}) -> {}\n  {}.\n  {}. In kernels/{}\n", function.name, joined(parameters),
                                   joined(results), function.summary, function.source, function.file);
    const auto describe = [&](const Parameter& parameter) {
        text += line(joined(parameter.columns()), fmt::format("{}; {}", parameter.meaning, parameter.unit));
    };
    text += "\ncolumns in\n";
    for (const Parameter& parameter : function.parameters) describe(parameter);
    text += "columns out\n";
    for (const Result& result : function.results) describe(result);
    if (!function.settings.empty()) text += "settings, --set NAME=VALUE\n";
    for (const Setting& setting : function.settings)
        text += line(setting.name,
                     fmt::format("{}; {}; {}", setting.meaning, wanted_text(setting.kind), standard_of(setting)));
    text += "largest error, --precision\n";
    for (const FunctionVariant& variant : function.variants)
        text += line(precision_name(variant.precision), errors_of(function, variant));
    text += line("double", fmt::format("{} by any measure", digits(function.fp64_error)));
    if (!function.note.empty()) text += "note\n  " + function.note + "\n";
    return text + "example\n  " + function_example(function) + "\n";
}

std::string reference_page() {
    std::string text =
        "# Kernels\n\n"
        "Written by `wrinkle eval --reference` from the comments in the files; do not edit.\n\n"
        "To use them in a program of your own, give the compiler this folder (`-I`) and include `wrinkle.clh` or any "
        "of\n"
        "the files alone, which bring what they need. Nothing of the host is necessary. Every name begins with `wr_` "
        "or\n"
        "`WR_`. What they take of a compiler stands under [lanes.clh](#lanesclh).\n\n"
        "World space is right-handed, positions are relative to the eye, image points have x to the right and y down,\n"
        "texture coordinates t up. \"Max error\" is the largest that the tests allow, on regular and hard inputs "
        "alike, in\n"
        "float; with `WR_FP64` it is 1e-9 or as noted. Papers: [Mik20] is Mikkelsen, \"Surface Gradient-Based Bump "
        "Mapping\n"
        "Framework\", JCGT 2020; the others are named by author and year.\n\n"
        "Under a file's declarations stands what `wrinkle eval NAME` evaluates of it on columns of numbers (`--help` "
        "tells\n"
        "how), with the errors that are tested, by measure, and the source of each formula.\n\n"
        "## Structs\n\nOf [layout.h](layout.h). Offsets count numbers: 4 bytes each, 8 with `WR_FP64`.\n" +
        layout_tables();
    std::vector<std::string> files = files_in_order();
    std::erase(files, "layout.h");
    for (const std::string& file : files) {
        text += fmt::format("\n## [{0}]({0})\n\n{1}", file, declarations_of(file));
        std::vector<const Function*> here;
        for (const Function& function : functions())
            if (function.file == file) here.push_back(&function);
        if (!here.empty()) text += evaluated_functions(here);
    }
    return text + area_table();
}

}  // namespace wrinkle
