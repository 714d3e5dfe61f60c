#include "cli/eval_outputs.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstring>

#include "base/atomic_file.h"
#include "base/names.h"
#include "io/image_writer.h"
#include "io/npy_file.h"
#include "wrinkle/error.h"

namespace wrinkle::cli {

namespace {

constexpr int standard_output = STDOUT_FILENO;
constexpr std::size_t block = std::size_t{1} << 20;  // bytes that are collected before they are written

std::string extension_of(const EvalFile& file) { return lower(file.file.extension().string()); }

/// Collects text and writes it to a file, or to standard output without one.
class Stream {
public:
    explicit Stream(const AtomicFile* file) : file_(file) {}
    std::string& text() { return text_; }
    void flush(std::size_t unless_below = 0) {
        if (text_.size() < unless_below) return;
        if (file_)
            file_->write(text_);
        else if (const int failed = write_all(standard_output, text_); failed != 0)
            throw Error(fmt::format("cannot write the output: {}", std::strerror(failed)));
        text_.clear();
    }

private:
    const AtomicFile* file_;
    std::string text_;
};

/// Writes the columns of the input, where a result of the same name replaces a column, then the other results.
template <class T>
void write_csv(Stream out, const Function& function, const EvalInputs<T>& inputs, const EvalResults<T>& results) {
    const std::vector<std::string> before = inputs.table ? inputs.table->names() : std::vector<std::string>{};
    std::vector<const std::vector<T>*> in_place, after;
    std::string comma;
    for (const std::string& name : before) {
        const auto found = results.find(name);
        in_place.push_back(found == results.end() ? nullptr : &found->second);
        io::append_csv_cell(out.text() += comma, name), comma = ",";
    }
    for (const Result& result : function.results)
        for (const std::string& column : result.columns())
            if (std::ranges::find(before, column) == before.end())
                after.push_back(&results.at(column)), out.text() += comma + column, comma = ",";
    out.text() += '\n';
    const std::size_t rows = results.begin()->second.size();
    for (std::size_t row = 0; row < rows; ++row) {
        for (std::size_t k = 0; k < in_place.size(); ++k) {
            if (k > 0) out.text() += ',';
            if (in_place[k])
                io::append_number(out.text(), (*in_place[k])[row]);
            else
                io::append_csv_cell(out.text(), inputs.table->cell(row, k));
        }
        for (std::size_t k = 0; k < after.size(); ++k) {
            if (k > 0 || !in_place.empty()) out.text() += ',';
            io::append_number(out.text(), (*after[k])[row]);
        }
        out.text() += '\n';
        out.flush(block);
    }
    out.flush();
}

template <class T>
void write_npy(Stream out, const Result& result, const EvalInputs<T>& inputs, const EvalResults<T>& results) {
    const std::vector<std::string> columns = result.columns();
    std::vector<std::size_t> shape = inputs.shape;
    if (columns.size() > 1) shape.push_back(columns.size());
    out.text() = io::npy_header<T>(shape);
    const std::size_t rows = results.at(columns[0]).size();
    for (std::size_t row = 0; row < rows; ++row) {
        for (const std::string& column : columns) {
            const T value = results.at(column)[row];
            out.text().append(reinterpret_cast<const char*>(&value), sizeof(T));
        }
        out.flush(block);
    }
    out.flush();
}

/// Writes results as channels: a vector "normal" as normal.X, normal.Y and normal.Z, a number "value" as value.
template <class T>
ImageWriter write_exr(const std::filesystem::path& file, const std::vector<Result>& wanted, const EvalInputs<T>& inputs,
                      const EvalResults<T>& results) {
    if (inputs.shape.size() != 2)
        throw Error(fmt::format("{}: a picture needs inputs of height x width; these are {} rows", file.string(),
                                shape_text(inputs.shape)));
    const Size size{static_cast<std::uint32_t>(inputs.shape[1]), static_cast<std::uint32_t>(inputs.shape[0])};
    std::vector<std::string> channels;
    std::vector<std::vector<float>> planes;
    for (const Result& result : wanted)
        for (const std::string& column : result.columns()) {
            const std::vector<T>& values = results.at(column);
            planes.emplace_back(values.begin(), values.end());
            channels.push_back(column);
            if (result.shape != Shape::number) channels.back().back() -= 'x' - 'X';
        }
    std::vector<const float*> rows;
    for (const std::vector<float>& plane : planes) rows.push_back(plane.data());
    ImageWriter writer(file, size, channels);
    writer.write_rows(0, size.height, rows);
    writer.complete();
    return writer;
}

const Result& result_of(const Function& function, const std::string& name) {
    std::vector<std::string> names;
    for (const Result& result : function.results) {
        if (result.name == name) return result;
        names.push_back(result.name);
    }
    throw Error(fmt::format("{} has no result {}{}; it has {}", function.name, quote(name), did_you_mean(name, names),
                            quote_list(names)));
}

}  // namespace

EvalOutputs::EvalOutputs(const Function& function, std::vector<EvalFile> files)
    : function_(function), files_(std::move(files)) {
    std::map<std::filesystem::path, std::string> seen;
    for (const EvalFile& file : files_) {
        const std::string extension = extension_of(file), text = file.file.string();
        const bool array = extension == ".npy" || extension == ".exr";
        if (file.name.empty() && array)
            throw Error(fmt::format("--out {0}: name the result: --out {1}={0}", text, function.results[0].name));
        if (!file.name.empty() && !array)
            throw Error(
                fmt::format("--out {}={}: needs a .npy or .exr file; a CSV file of all results is given "
                            "without a name",
                            file.name, text));
        if (!file.layer.empty()) throw Error(fmt::format("--out {}: layers are named by their results", text));
        if (!file.name.empty()) result_of(function, file.name);
        const auto [place, fresh] = seen.try_emplace(file.file, file.name);
        if (!fresh && (extension != ".exr" || place->second == file.name))
            throw Error(fmt::format("--out: {} is named twice", text));
    }
}

std::vector<Result> EvalOutputs::results() const {
    std::vector<Result> wanted;
    for (const EvalFile& file : files_) {
        if (file.name.empty()) return function_.results;
        wanted.push_back(result_of(function_, file.name));
    }
    return wanted.empty() ? function_.results : wanted;
}

template <class T>
void EvalOutputs::write(const EvalInputs<T>& inputs, const EvalResults<T>& results) const {
    if (files_.empty()) return write_csv(Stream(nullptr), function_, inputs, results);
    std::vector<std::unique_ptr<AtomicFile>> complete;
    std::map<std::filesystem::path, std::vector<Result>> pictures;
    for (const EvalFile& file : files_) {
        if (extension_of(file) == ".exr") {
            pictures[file.file].push_back(result_of(function_, file.name));
            continue;
        }
        complete.push_back(std::make_unique<AtomicFile>(file.file));
        if (file.name.empty())
            write_csv(Stream(complete.back().get()), function_, inputs, results);
        else
            write_npy(Stream(complete.back().get()), result_of(function_, file.name), inputs, results);
        complete.back()->sync();
    }
    std::vector<ImageWriter> writers;
    for (const auto& [file, wanted] : pictures) writers.push_back(write_exr(file, wanted, inputs, results));
    for (const auto& file : complete) file->commit();
    for (ImageWriter& writer : writers) writer.finish();
}

template void EvalOutputs::write(const EvalInputs<float>&, const EvalResults<float>&) const;
template void EvalOutputs::write(const EvalInputs<double>&, const EvalResults<double>&) const;

}  // namespace wrinkle::cli
