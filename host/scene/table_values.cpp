// How a table reads values: each type with its checks.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/environment.h"
#include "base/names.h"
#include "io/frame_path.h"
#include "scene/files.h"
#include "scene/table.h"
#include "wrinkle/error.h"

namespace wrinkle::scene {
namespace {

std::string describe(const Range& range) {
    const std::string low = fmt::format("{} {}", range.low_is_allowed ? "at least" : "greater than", range.low);
    const std::string high = fmt::format("{} {}", range.high_is_allowed ? "at most" : "less than", range.high);
    if (range.low == any_number.low) return high;
    if (range.high == any_number.high) return low;
    return low + " and " + high;
}

bool is_within(double x, const Range& range) {
    return (range.low_is_allowed ? x >= range.low : x > range.low) &&
           (range.high_is_allowed ? x <= range.high : x < range.high);
}

bool has_control_character(std::string_view text) {
    return std::any_of(text.begin(), text.end(), [](unsigned char c) { return c < 0x20 || c == 0x7F; });
}

}  // namespace

double to_radians(double degrees) { return degrees * std::numbers::pi / 180; }

double to_degrees(double radians) {
    const double degrees = radians * 180 / std::numbers::pi, whole = std::round(degrees);
    return std::abs(degrees - whole) <= 1e-13 * std::abs(whole) ? whole : degrees;
}

template <class T>
Table::Value Table::value_of(std::string_view key, const T& held) {
    if (visits()) return Value(std::unique_ptr<toml::node>(new toml::value<T>(held)));
    return Value(find(key));
}

/// An empty text counts as not given.
Table::Value Table::text_of(std::string_view key, const std::string& held) {
    if (!visits()) return Value(find(key));
    if (!held.empty()) return Value(std::unique_ptr<toml::node>(new toml::value<std::string>(held)));
    if (std::find(required_.begin(), required_.end(), key) != required_.end()) {
        bad_.emplace(key);
        complain_here(fmt::format("{} needs {}", where_, quote(key)));
    }
    return Value(static_cast<const toml::node*>(nullptr));
}

bool Table::read(std::string_view key, bool& out, Compiled compiled) {
    const Value node = value_of(key, out);
    if (!node) return false;
    if (!node->is_boolean()) return wrong_type(key, "true or false", *node);
    out = node->as_boolean()->get();
    if (compiled == Compiled::yes) compiled_in(key, out);
    return true;
}

bool Table::read(std::string_view key, int& out, int low, int high) {
    const Value node = value_of(key, std::int64_t{out});
    if (!node) return false;
    const std::string wanted = fmt::format("a whole number from {} to {}", low, high);
    if (!node->is_integer()) return wrong_type(key, wanted, *node);
    const std::int64_t value = node->as_integer()->get();
    if (value < low || value > high) return wrong_type(key, wanted, *node);
    out = static_cast<int>(value);
    return true;
}

bool Table::number(std::string_view key, const toml::node& node, double& out, const Range& range,
                   std::string_view element) {
    if (!node.is_number()) return wrong_type(key, fmt::format("{}a number", element), node);
    const double value = *node.value<double>();
    if (!std::isfinite(value)) return wrong_type(key, fmt::format("{}a finite number", element), node);
    if (std::abs(value) > any_number.high)
        return wrong_type(key, fmt::format("{}within the range of 32-bit floats (3.4e38)", element), node);
    if (!is_within(value, range)) return wrong_type(key, fmt::format("{}{}", element, describe(range)), node);
    // Kernels divide by it: below this, a float32 has lost digits and its reciprocal overflows.
    if (range.low == 0 && !range.low_is_allowed && value < std::numeric_limits<float>::min())
        return wrong_type(key, fmt::format("{}at least 1.2e-38, the smallest 32-bit float", element), node);
    out = value;
    return true;
}

bool Table::read(std::string_view key, double& out, const Range& range) {
    const Value node = value_of(key, out);
    return node && number(key, *node, out, range, "");
}

bool Table::visit_numbers(std::string_view key, double* held, std::size_t count, const Range& range,
                          std::string_view element) {
    for (std::size_t i = 0; i < count; ++i)
        if (!number(key, toml::value<double>(held[i]), held[i], range, element)) return false;
    return true;
}

bool Table::read_numbers(std::string_view key, double* out, std::size_t count, const Range& range) {
    constexpr const char* element = "an array with each element ";
    if (visits()) return visit_numbers(key, out, count, range, element);
    const toml::node* node = find(key);
    if (!node) return false;
    const toml::array* array = node->as_array();
    if (!array || array->size() != count) return wrong_type(key, fmt::format("{} numbers in []", count), *node);
    std::vector<double> values(count);
    for (std::size_t i = 0; i < count; ++i)
        if (!number(key, (*array)[i], values[i], range, element)) return false;
    std::copy(values.begin(), values.end(), out);
    return true;
}

bool Table::read_degrees(std::string_view key, double& radians, const Range& degrees) {
    double value = to_degrees(radians);
    if (!read(key, value, degrees)) return false;
    radians = to_radians(value);
    return true;
}

bool Table::read_rows(std::string_view key, double* out, std::size_t size) {
    constexpr const char* element = "a matrix with each element ";
    if (visits()) return visit_numbers(key, out, size * size, any_number, element);
    const toml::node* node = find(key);
    if (!node) return false;
    const toml::array* rows = node->as_array();
    const auto is_row = [&](const toml::node& row) { return row.is_array() && row.as_array()->size() == size; };
    if (!rows || rows->size() != size || !std::all_of(rows->begin(), rows->end(), is_row)) {
        const std::vector<std::string_view> dots(size, "[..]");
        complain(key,
                 fmt::format("must be a {0}x{0} matrix, [{1}] with {0} numbers a row", size, fmt::join(dots, ", ")));
        return false;
    }
    std::vector<double> matrix(size * size);
    for (std::size_t i = 0; i < size * size; ++i)
        if (!number(key, (*(*rows)[i / size].as_array())[i % size], matrix[i], any_number, element)) return false;
    std::copy(matrix.begin(), matrix.end(), out);
    return true;
}

bool Table::read(std::string_view key, std::string& out, Compiled compiled) {
    const Value node = text_of(key, out);
    if (visits() && compiled == Compiled::yes) note(key, out);
    return node && text(key, *node, out, "");
}

bool Table::text(std::string_view key, const toml::node& node, std::string& out, std::string_view element) {
    if (!node.is_string()) return wrong_type(key, fmt::format("{}a text in \"\"", element), node);
    const std::string& value = node.as_string()->get();
    if (value.empty()) return wrong_type(key, fmt::format("{}a text that is not empty", element), node);
    // Texts end up in messages, file names and #line directives of kernels, none of which may hold a line break.
    if (has_control_character(value))
        return wrong_type(key, fmt::format("{}a text without control characters", element), node);
    out = value;
    return true;
}

std::vector<Table::Value> Table::some(std::string_view key, std::string_view wanted) {
    const toml::node* node = find(key);
    std::vector<Value> values;
    if (!node) return values;
    if (const toml::array* array = node->as_array()) {
        for (const toml::node& element : *array) values.emplace_back(&element);
        if (array->empty()) wrong_type(key, wanted, *node);
    } else {
        values.emplace_back(node);
    }
    return values;
}

bool Table::read_some(std::string_view key, std::vector<double>& out) {
    compiled_in(key, static_cast<int>(out.size()));
    if (visits()) return visit_numbers(key, out.data(), out.size(), any_number, "");
    std::vector<double> values;
    for (const Value& value : some(key, "a number, or an array of numbers"))
        if (!number(key, *value, values.emplace_back(), any_number, "")) return false;
    if (values.empty()) return false;
    out = std::move(values);
    return true;
}

bool Table::read_some(std::string_view key, std::vector<std::string>& out) {
    compiled_in(key, static_cast<int>(out.size()));
    if (visits()) {
        for (std::string& held : out)
            if (!text(key, toml::value<std::string>(held), held, "")) return false;
        return !out.empty();
    }
    std::vector<std::string> values;
    for (const Value& value : some(key, "a text in \"\", or an array of texts"))
        if (!text(key, *value, values.emplace_back(), "")) return false;
    if (values.empty()) return false;
    out = std::move(values);
    return true;
}

bool Table::read(std::string_view key, std::vector<std::string>& out) {
    const toml::node* node = find(key);
    if (!node) return false;
    const toml::array* array = node->as_array();
    const auto is_text = [](const toml::node& element) { return element.is_string(); };
    if (!array || !std::all_of(array->begin(), array->end(), is_text))
        return wrong_type(key, "an array of texts, [\"..\", \"..\"]", *node);
    out.clear();
    for (const toml::node& element : *array) out.push_back(element.as_string()->get());
    return true;
}

bool Table::read_name(std::string_view key, std::string& out) {
    std::string name = out;
    if (!read(key, name, Compiled::no)) return false;
    std::error_code ignored;
    try {
        if (!visits() && !std::filesystem::exists(document_->folder / name, ignored)) name = with_environment(name);
    } catch (const Error& error) {
        complain(key, fmt::format("is {}: {}", quote(name), error.what()));
        return false;
    }
    if (const auto place = name.find("%V"); place != std::string::npos) {
        if (document_->view.empty()) {
            complain(key,
                     fmt::format("is {}: %V stands for a view; say which with [gbuffer] view = \"left\"", quote(name)));
            return false;
        }
        name.replace(place, 2, document_->view);
        document_->view_in_names = true;
    }
    out = std::move(name);
    return true;
}

bool Table::read_file(std::string_view key, std::filesystem::path& out, FramePattern pattern) {
    std::string name = visits() ? out.string() : "";
    if (visits()) note(key, name);
    if (!read_name(key, name)) return false;
    std::filesystem::path file = (document_->folder / name).lexically_normal();
    if (pattern == FramePattern::filled && has_frame_pattern(file)) {
        document_->frame_files.push_back(file);
        if (document_->frame) file = frame_path(file, *document_->frame);
    }
    if (document_->check_files) {
        const std::string problem = why_not_readable(file, pattern == FramePattern::kept,
                                                     visits() ? "the working directory" : "the scene's folder");
        if (!problem.empty()) {
            complain(key, fmt::format("is {}: {}", quote(name), problem));
            return false;
        }
    }
    (pattern == FramePattern::filled ? document_->files : document_->kept).push_back(file);
    out = file;
    return true;
}

std::optional<std::size_t> Table::read_choice(std::string_view key, const std::vector<std::string>& names) {
    const toml::node* node = find(key);
    if (!node) return std::nullopt;
    if (!node->is_string()) {
        wrong_type(key, "one of " + quote_list(names), *node);
        return std::nullopt;
    }
    const std::string& name = node->as_string()->get();
    const auto found = std::find(names.begin(), names.end(), name);
    if (found != names.end()) return static_cast<std::size_t>(found - names.begin());
    complain(key, fmt::format("is {}{} allowed: {}", quote(name),
                              did_you_mean(name, names).empty() ? ";" : did_you_mean(name, names), quote_list(names)));
    return std::nullopt;
}

bool Table::visit_choice(std::string_view key, const char* held, int number, const std::vector<std::string>& names,
                         Compiled compiled) {
    if (!held && !is_bad(key))
        complain(key, fmt::format("is number {}, which is none of those allowed: {}", number, quote_list(names)));
    if (held && compiled == Compiled::yes) note(key, held);
    return held != nullptr;
}

}  // namespace wrinkle::scene
