#include <fmt/format.h>

#include <memory>

#include "base/same_file.h"
#include "cli/commands.h"
#include "cli/eval_outputs.h"
#include "cli/options.h"
#include "functions/reference.h"
#include "functions/tables.h"
#include "wrinkle/error.h"

namespace wrinkle::cli {

namespace {

struct EvalArguments {
    std::string function, size, device;
    std::string precision = "standard";
    std::vector<std::string> in, out, settings;
    bool list = false, reference = false, kernels = false, help = false;
};

template <class T, class In, class Out>
void evaluate(const EvalArguments& arguments, const Function& function, FunctionOptions options) {
    std::vector<EvalFile> in, out;
    for (const std::string& text : arguments.in) in.push_back(parse_eval_file(text));
    for (const std::string& text : arguments.out) out.push_back(parse_eval_file(text));
    const EvalOutputs outputs(function, out);
    std::vector<std::filesystem::path> read;
    for (const EvalFile& file : in) read.push_back(file.file);
    for (const EvalFile& file : out) refuse_to_replace(file.file, read);
    const EvalInputs<T> inputs = read_inputs<T>(function, in);
    std::optional<Size> size;
    if (inputs.shape.size() == 2)
        size = Size{static_cast<std::uint32_t>(inputs.shape[1]), static_cast<std::uint32_t>(inputs.shape[0])};
    if (!arguments.size.empty()) size = parse_size(arguments.size);
    options.settings = parse_settings(function, arguments.settings, size);
    In columns;
    for (const auto& [name, values] : inputs.columns) columns.emplace(name, values);
    EvalResults<T> results;
    Out spans;
    for (const Result& result : outputs.results())
        for (const std::string& column : result.columns()) {
            results[column].resize(columns.begin()->second.size());
            spans.emplace(column, results[column]);
        }
    evaluate_function(Device::open(arguments.device), function, columns, spans, options);
    outputs.write(inputs, results);
}

void eval(const EvalArguments& arguments, const CLI::App& command) {
    if (arguments.list || arguments.reference) {
        fmt::print("{}", arguments.list ? function_list() : reference_page());
        return;
    }
    if (arguments.kernels) {
        fmt::print("{}", every_column_kernel());
        return;
    }
    if (arguments.function.empty()) {
        if (!arguments.help) throw CLI::RequiredError("FUNCTION (see wrinkle eval --list)");
        fmt::print("{}", command.help("wrinkle"));
        return;
    }
    const Function& function = wrinkle::function(arguments.function);
    if (arguments.help) {
        fmt::print("{}", function_help(function));
        return;
    }
    if (arguments.precision == "double")
        return evaluate<double, ColumnsInDouble, ColumnResultsInDouble>(arguments, function, {});
    FunctionOptions options;
    if (arguments.precision == "fast") options.precision = Precision::fast;
    if (arguments.precision == "exact") options.precision = Precision::exact;
    evaluate<float, Columns, ColumnResults>(arguments, function, options);
}

}  // namespace

void add_eval(CLI::App& app) {
    auto arguments = std::make_shared<EvalArguments>();
    CLI::App* command = app.add_subcommand("eval", "Evaluate one kernel function over rows of numbers");
    command->set_help_flag();
    command->add_flag("-h,--help", arguments->help, "print this, or all about FUNCTION");
    command->add_option("FUNCTION", arguments->function, "name of the function");
    command->add_flag("--list", arguments->list, "print every function with its errors");
    command->add_flag("--reference", arguments->reference, "print the reference page kernels/README.md");
    command->add_flag("--kernels", arguments->kernels,
                      "print every function as a kernel in OpenCL C, for compilers that are given kernels/ by -I");
    command
        ->add_option("--in", arguments->in,
                     "FILE (CSV, - for standard input); PARAMETER=FILE.npy; PARAMETER=FILE.exr:LAYER")
        ->type_name("INPUT")
        ->allow_extra_args(false);
    command->add_option("--out", arguments->out, "FILE (CSV); RESULT=FILE.npy; RESULT=FILE.exr; else CSV is printed")
        ->type_name("OUTPUT")
        ->allow_extra_args(false);
    command->add_option("--set", arguments->settings, "a setting: numbers with commas, a camera, image or volume file")
        ->type_name("NAME=VALUE")
        ->allow_extra_args(false);
    command->add_option("--size", arguments->size, "size of a camera's frame; else that of its file or of the pictures")
        ->type_name("WIDTHxHEIGHT");
    command->add_option("--precision", arguments->precision, "fast, standard, exact or double")
        ->check(CLI::IsMember({"fast", "standard", "exact", "double"}))
        ->type_name("PRECISION")
        ->capture_default_str();
    add_device_option(*command, arguments->device);
    command->footer(
        "CSV: the first row names the columns: n.x, n.y, n.z for a parameter n. All columns of the input pass "
        "through,\n"
        "results follow (one that is there already is replaced in place).\n"
        "\n"
        "  wrinkle eval --list\n"
        "  wrinkle eval resolve --help\n"
        "  wrinkle eval resolve < in.csv > out.csv\n"
        "  wrinkle eval resolve --in n=normal.npy --in g=g.npy --out normal=bumped.npy\n"
        "  wrinkle eval screen_derivatives --in n=data/gbuffer/small.exr:Normal --in p=p.npy "
        "--set camera=data/gbuffer/small.camera.json --out dp_dx=d.exr\n"
        "                        (p: positions less the camera's, as kernels take them)");
    command->callback([arguments, command] { eval(*arguments, *command); });
}

}  // namespace wrinkle::cli
