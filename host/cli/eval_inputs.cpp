#include "cli/eval_inputs.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <numeric>

#include "base/names.h"
#include "base/text_file.h"
#include "io/channel_index.h"
#include "io/channel_names.h"
#include "io/gbuffer_reader.h"
#include "io/npy_file.h"
#include "io/whole_planes.h"
#include "wrinkle/error.h"

namespace wrinkle::cli {

namespace {

template <class T>
using Planes = std::vector<std::vector<T>>;

template <class T>
struct Array {
    std::vector<std::size_t> shape;  ///< without the dimension of the components
    Planes<T> planes;                ///< one for each component
};

template <class T>
Array<T> read_array(const Parameter& parameter, const EvalFile& from) {
    io::NpyArray<T> array = io::read_npy<T>(from.file);
    const std::size_t components = parameter.columns().size();
    const bool last = components > 1;
    if (array.shape.size() < (last ? 2 : 1) || (last && array.shape.back() != components))
        throw Error(
            fmt::format("{} is {}; {} needs {}", from.file.string(), shape_text(array.shape), parameter.name,
                        last ? fmt::format("N x {0} or height x width x {0}", components) : "N, or height x width"));
    if (last) array.shape.pop_back();
    Planes<T> planes(components, std::vector<T>(array.values.size() / components));
    for (std::size_t i = 0; i < array.values.size(); ++i) planes[i % components][i / components] = array.values[i];
    return {array.shape, std::move(planes)};
}

/// The channels of a layer, one for each of the components: X Y Z, R G B, U V and so on. When there is only one
/// component, `layer` may also be the name of a channel.
std::vector<std::string> channels_of(const GBufferReader& reader, const std::string& layer, std::size_t components) {
    const io::ChannelIndex index(reader.channels());
    const Role any{"", std::vector<std::string>(components)};
    if (components == 1 && std::ranges::find(index.channels, layer) != index.channels.end()) return {layer};
    std::vector<std::string> matched = index.match(any, layer);
    for (const std::string& whole : index.layers)  // "Normal" also means "ViewLayer.Normal"
        if (matched.empty() && whole.ends_with("." + layer)) matched = index.match(any, whole);
    if (matched.empty())
        throw Error(fmt::format("{}: no layer {} of {} channel{}; channels found: {}", reader.path().string(),
                                quote(layer), components, components == 1 ? "" : "s",
                                io::describe_channels(reader.channels())));
    return matched;
}

template <class T>
Array<T> read_picture(const Parameter& parameter, const EvalFile& from) {
    const GBufferReader reader(from.file);
    const Size size = reader.size();
    std::vector<std::string> names = channels_of(reader, from.layer, parameter.columns().size());
    for (std::string& name : names) name = "channel:" + name;
    const auto planes = io::read_whole_planes(reader, names);
    Array<T> array{{size.height, size.width}, {}};
    for (const std::string& name : names) array.planes.emplace_back(planes.at(name).begin(), planes.at(name).end());
    return array;
}

template <class T>
Array<T> read_named(const Parameter& parameter, const EvalFile& from) {
    const std::string extension = lower(from.file.extension().string());
    if (extension == ".npy") return read_array<T>(parameter, from);
    if (extension == ".exr") return read_picture<T>(parameter, from);
    throw Error(fmt::format("--in {}={}: needs a .npy file, or FILE.exr:LAYER; CSV files are given without a name",
                            from.name, from.file.string()));
}

std::size_t product(const std::vector<std::size_t>& shape) {
    return std::accumulate(shape.begin(), shape.end(), std::size_t{1}, std::multiplies<>());
}

template <class T>
void add_pixel_centres(EvalInputs<T>& inputs, const Function& function) {
    if (inputs.shape.size() != 2) return;
    for (const Parameter& parameter : function.parameters) {
        const bool x = parameter.name == "x", pixels = parameter.unit == "pixels" && (x || parameter.name == "y");
        if (!pixels || inputs.columns.contains(parameter.name)) continue;
        std::vector<T>& column = inputs.columns[parameter.name];
        const std::size_t width = inputs.shape[1];
        for (std::size_t i = 0; i < inputs.shape[0] * width; ++i)
            column.push_back(static_cast<T>(x ? i % width : i / width) + T{0.5});
    }
}

[[noreturn]] void fail_for(const Function& function, const std::vector<std::string>& missing, const io::CsvTable& table,
                           const std::string& name) {
    std::vector<std::string> others;  // columns that no parameter uses: one may be a misspelt name of a missing one
    for (const std::string& there : table.names()) {
        const auto has = [&](const Parameter& p) { return std::ranges::count(p.columns(), there) > 0; };
        if (std::ranges::none_of(function.parameters, has)) others.push_back(there);
    }
    std::string text = fmt::format("{} needs columns that {} does not have:", function.name, name);
    for (const std::string& column : missing) text += fmt::format("\n  \"{}\"{}", column, did_you_mean(column, others));
    throw Error(text + "\nit has " + quote_list(table.names()));
}

}  // namespace

std::string shape_text(const std::vector<std::size_t>& shape) {
    std::string text;
    for (const std::size_t side : shape) text += fmt::format("{}{}", text.empty() ? "" : " x ", side);
    return shape.empty() ? "a single number" : text;
}

template <class T>
EvalInputs<T> read_inputs(const Function& function, const std::vector<EvalFile>& files) {
    EvalInputs<T> inputs;
    std::optional<std::filesystem::path> csv;
    std::string first;  // the file whose shape all others must have
    const auto agree = [&](const std::vector<std::size_t>& shape, const std::string& name) {
        if (first.empty()) first = name, inputs.shape = shape;
        if (shape != inputs.shape)
            throw Error(
                fmt::format("{} holds {} rows, {} holds {}", name, shape_text(shape), first, shape_text(inputs.shape)));
    };
    std::vector<std::string> names;
    for (const Parameter& parameter : function.parameters) names.push_back(parameter.name);
    for (const EvalFile& from : files) {
        if (from.name.empty()) {
            if (csv) throw Error("--in: two CSV files; one table holds all columns");
            csv = from.file;
            continue;
        }
        const auto parameter = std::ranges::find(function.parameters, from.name, &Parameter::name);
        if (parameter == function.parameters.end())
            throw Error(fmt::format("{} has no parameter {}{}", function.name, quote(from.name),
                                    did_you_mean(from.name, names)));
        const std::vector<std::string> columns = parameter->columns();
        if (inputs.columns.contains(columns[0])) throw Error(fmt::format("--in: {} is given twice", from.name));
        Array<T> array = read_named<T>(*parameter, from);
        agree(array.shape, from.file.string());
        for (std::size_t k = 0; k < columns.size(); ++k) inputs.columns[columns[k]] = std::move(array.planes[k]);
    }
    if (files.empty()) {
        if (isatty(STDIN_FILENO) != 0)
            throw Error(fmt::format("no input: give --in FILE, or CSV on standard input; see wrinkle eval {} --help",
                                    function.name));
        csv = "-";
    }
    if (csv) {
        const std::string name = *csv == "-" ? "standard input" : csv->string();
        inputs.table.emplace(*csv == "-" ? read_standard_input(kAnyLength) : read_text(*csv, "a CSV file", kAnyLength),
                             name);
        std::vector<std::string> missing;
        for (const Parameter& parameter : function.parameters)
            for (const std::string& column : parameter.columns()) {
                const bool there = std::ranges::find(inputs.table->names(), column) != inputs.table->names().end();
                if (inputs.columns.contains(column) && there)
                    throw Error(fmt::format("{} is given twice: by --in {} and by {}", column, parameter.name, name));
                if (there)
                    inputs.columns[column] = inputs.table->template numbers<T>(column);
                else if (!inputs.columns.contains(column))
                    missing.push_back(column);
            }
        if (!missing.empty()) fail_for(function, missing, *inputs.table, name);
        if (first.empty() || product(inputs.shape) != inputs.table->rows()) agree({inputs.table->rows()}, name);
    }
    add_pixel_centres(inputs, function);
    for (const Parameter& parameter : function.parameters)
        if (!inputs.columns.contains(parameter.columns()[0]))
            throw Error(
                fmt::format("{0} needs {1}: --in {1}=FILE.npy, --in {1}=FILE.exr:LAYER, or the columns {2} of "
                            "a CSV file, --in FILE (- for standard input)",
                            function.name, parameter.name, quote_list(parameter.columns())));
    return inputs;
}

template EvalInputs<float> read_inputs(const Function&, const std::vector<EvalFile>&);
template EvalInputs<double> read_inputs(const Function&, const std::vector<EvalFile>&);

}  // namespace wrinkle::cli
