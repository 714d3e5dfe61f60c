#include "functions.h"

#include <fmt/format.h>

#include <set>

#include "operations.h"
#include "tests/cases/errors.h"
#include "tests/cases/registry.h"
#include "wrinkle/functions.h"

namespace wrinkle::bench {

namespace {

using cases::Cases;

const char* unit_of(ErrorMeasure measure) {
    switch (measure) {
        case ErrorMeasure::degrees:
        case ErrorMeasure::resolved_degrees:
            return "degrees";
        case ErrorMeasure::relative:
            return "relative";
        case ErrorMeasure::absolute:
            return "absolute";
    }
    return "";
}

template <class T>
std::vector<T> repeated(const std::vector<float>& column, const std::vector<std::size_t>& rows, std::size_t count) {
    std::vector<T> out(count);
    for (std::size_t i = 0; i < count; ++i) out[i] = column[rows[i % rows.size()]];
    return out;
}

/// Results of every row of the cases.
template <class T>
std::vector<std::vector<double>> results_of(const Device& device, const ColumnKernel& kernel, const Cases& c,
                                            int lanes) {
    std::map<std::string, std::vector<T>> numbers;
    std::map<std::string, std::span<const T>> spans;
    for (const auto& [name, values] : c.inputs) spans[name] = numbers[name] = {values.begin(), values.end()};
    std::vector<std::vector<double>> out;
    for (const auto& column : run_columns<T>(device, kernel, spans, lanes, c.data))
        out.emplace_back(column.begin(), column.end());
    return out;
}

/// Fills in the errors of the function's first result, by its first measure.
void add_errors(Measurement& m, const Function& function, const Cases& c,
                const std::vector<std::vector<double>>& results) {
    std::map<std::string, std::vector<double>> errors;
    const Result& result = function.results.front();
    for (std::size_t row = 0; row < c.size(); ++row) {
        const auto got = cases::value_at(results, 0, result.columns().size(), row);
        if (!finite(c.want.at(result.name)[row])) continue;
        errors[c.category(row)].push_back(
            finite(got) ? static_cast<double>(cases::error_of(result.measures.front(), c, result.name, got, row))
                        : INFINITY);
    }
    for (auto& [category, list] : errors) (category == "regular" ? m.error : m.hard[category]) = statistics(list);
    std::string bits;
    for (const auto& column : results)
        bits.append(reinterpret_cast<const char*>(column.data()), column.size() * sizeof(double));
    m.hash = hash_of(bits.data(), bits.size());
}

/// A launch over the regular rows of the cases. One launch has one set of constants: where every row has its own, those
/// of the first row serve for all.
template <class T>
class Launch {
public:
    Launch(const Device& device, const ColumnKernel& kernel, const Cases& c, int lanes, std::size_t rows)
        : device_(device), data_(shared_data(c)), program_(device, kernel, names(c), lanes, data_) {
        std::vector<std::size_t> regular;
        for (std::size_t row = 0; row < c.size(); ++row)
            if (!c.hard[row]) regular.push_back(row);
        if (regular.empty())
            for (std::size_t row = 0; row < c.size(); ++row) regular.push_back(row);
        std::vector<std::vector<T>> columns;
        for (const auto& [name, values] : c.inputs) columns.push_back(repeated<T>(values, regular, rows));
        program_.upload(columns, rows, data_.constants, data_.records);
    }

    void run() {
        program_.enqueue();
        device_.queue.finish();
    }

private:
    static std::vector<std::string> names(const Cases& c) {
        std::vector<std::string> out;
        for (const auto& [name, values] : c.inputs) out.push_back(name);
        return out;
    }
    static ColumnData shared_data(const Cases& c) {
        ColumnData data = c.data;
        if (data.constants_per_row > 0) data.constants.resize(data.constants_per_row);
        if (data.records_per_row > 0) data.records.resize(data.records_per_row);
        data.constants_per_row = data.records_per_row = 0;
        return data;
    }

    const Device& device_;
    ColumnData data_;
    ColumnProgram<T> program_;
};

double operations_of(const ColumnKernel& kernel, const Cases& c) {
    std::vector<std::string> columns;
    for (const auto& [name, values] : c.inputs) columns.push_back(name);
    return counted_operations(column_kernel_source(kernel, columns, c.data));
}

struct Entry {
    Measurement measurement;
    std::function<void()> work;
};

template <class T>
Entry entry_of(const Device& device, const Function& function, const FunctionVariant& variant, const Cases& c,
               int lanes, const FunctionBench& options) {
    const bool fp64 = std::is_same_v<T, double>;
    const ColumnKernel kernel = cases::kernel_of(function, variant, fp64);
    Entry entry;
    Measurement& m = entry.measurement;
    m.group = "function", m.name = function.name, m.lanes = lanes, m.pixels = options.rows;
    m.variant = fp64 ? "double" : precision_name(variant.precision);
    m.unit = unit_of(function.results.front().measures.front());
    m.bound = fp64 ? function.fp64_error : variant.max_errors.front();
    m.bytes = static_cast<double>((c.inputs.size() + kernel.outputs.size()) * sizeof(T));
    m.operations = options.speed ? operations_of(kernel, c) : 0;
    add_errors(m, function, c, results_of<T>(device, kernel, c, lanes));
    if (options.speed) {
        auto launch = std::make_shared<Launch<T>>(device, kernel, c, lanes, options.rows);
        entry.work = [launch] { launch->run(); };
    }
    return entry;
}

}  // namespace

std::vector<Measurement> measure_functions(const Device& device, const FunctionBench& options) {
    std::vector<Measurement> out;
    const std::vector<int> widths = options.lanes.empty() ? std::vector{device.info.lanes} : options.lanes;
    for (const Function& function : functions()) {
        if (!options.only.empty() && options.only != function.name) continue;
        Cases c = cases::registry().at(function.name)();
        std::set<std::string> columns;
        for (const Parameter& parameter : function.parameters)
            for (const std::string& column : parameter.columns()) columns.insert(column);
        std::erase_if(c.inputs, [&](const auto& input) { return !columns.contains(input.first); });
        std::vector<Entry> entries;
        for (const FunctionVariant& variant : function.variants)
            for (const int lanes : widths)
                entries.push_back(entry_of<float>(device, function, variant, c, lanes, options));
        if (device.info.fp64)
            entries.push_back(entry_of<double>(device, function, function.variant(Precision::fp64), c,
                                               std::min(device.info.lanes, 8), options));
        std::vector<Contender> contenders;
        for (const Entry& entry : entries)
            if (entry.work) contenders.push_back({entry.measurement.variant, entry.work});
        race(contenders, {options.repetitions});
        for (std::size_t i = 0; i < entries.size(); ++i) {
            if (i < contenders.size()) entries[i].measurement.seconds = contenders[i].seconds;
            out.push_back(entries[i].measurement);
        }
    }
    return out;
}

}  // namespace wrinkle::bench
