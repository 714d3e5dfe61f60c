#include "scene/table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/names.h"
#include "scene/files.h"

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

const toml::node* Table::find(std::string_view key) {
    if (std::find(known_.begin(), known_.end(), key) == known_.end()) known_.emplace_back(key);
    return values_->get(key);
}

std::uint32_t Table::line_of(std::string_view key) const {
    for (const auto& [name, value] : *values_)
        if (name.str() == key && name.source().begin.line > 0) return name.source().begin.line;
    return line_;
}

std::vector<std::string> Table::keys() const {
    std::vector<std::string> out;
    for (const auto& [name, value] : *values_) out.emplace_back(name.str());
    return out;
}

void Table::complain(std::string_view key, std::string_view text) {
    bad_.emplace(key);
    document_->problems.add(line_of(key), fmt::format("{} in {} {}", quote(key), where_, text));
}

bool Table::wrong_type(std::string_view key, std::string_view wanted, const toml::node& found) {
    complain(key, fmt::format("must be {}; found {}", wanted, describe(found)));
    return false;
}

void Table::require(std::string_view key) {
    find(key);
    if (has(key)) return;
    bad_.emplace(key);
    complain_here(fmt::format("{} needs the key {}", where_, quote(key)));
}

void Table::only_with(std::string_view key, bool holds, std::string_view selector, std::string_view value) {
    if (holds || !has(key) || is_bad(selector)) return;
    complain(key, fmt::format("has an effect only with {} = {}; remove it or set that", selector, quote(value)));
}

bool Table::read(std::string_view key, bool& out) {
    const toml::node* node = find(key);
    if (!node) return false;
    if (!node->is_boolean()) return wrong_type(key, "true or false", *node);
    out = node->as_boolean()->get();
    return true;
}

bool Table::read(std::string_view key, int& out, int low, int high) {
    const toml::node* node = find(key);
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
    // Divided by later on: below this float32 has lost digits and its reciprocal overflows.
    if (range.low == 0 && !range.low_is_allowed && value < std::numeric_limits<float>::min())
        return wrong_type(key, fmt::format("{}at least 1.2e-38, the smallest 32-bit float", element), node);
    out = value;
    return true;
}

bool Table::read(std::string_view key, double& out, const Range& range) {
    const toml::node* node = find(key);
    return node && number(key, *node, out, range, "");
}

bool Table::read_numbers(std::string_view key, double* out, std::size_t count, const Range& range) {
    const toml::node* node = find(key);
    if (!node) return false;
    const toml::array* array = node->as_array();
    if (!array || array->size() != count) return wrong_type(key, fmt::format("{} numbers in []", count), *node);
    std::vector<double> values(count);
    for (std::size_t i = 0; i < count; ++i)
        if (!number(key, (*array)[i], values[i], range, "an array with each element ")) return false;
    std::copy(values.begin(), values.end(), out);
    return true;
}

bool Table::read_degrees(std::string_view key, double& radians, const Range& degrees) {
    double value = 0;
    if (!read(key, value, degrees)) return false;
    radians = value * std::numbers::pi / 180;
    return true;
}

bool Table::read_rows(std::string_view key, double* out, std::size_t size) {
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
        if (!number(key, (*(*rows)[i / size].as_array())[i % size], matrix[i], any_number,
                    "a matrix with each element "))
            return false;
    std::copy(matrix.begin(), matrix.end(), out);
    return true;
}

bool Table::read(std::string_view key, std::string& out) {
    const toml::node* node = find(key);
    if (!node) return false;
    if (!node->is_string()) return wrong_type(key, "a text in \"\"", *node);
    const std::string& text = node->as_string()->get();
    if (text.empty()) return wrong_type(key, "a text that is not empty", *node);
    // Texts end up in messages, file names and the comments of generated kernels.
    if (has_control_character(text)) return wrong_type(key, "a text without control characters", *node);
    out = text;
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

bool Table::read_file(std::string_view key, std::filesystem::path& out, FramePattern pattern) {
    std::string name;
    if (!read(key, name)) return false;
    const std::filesystem::path file = (document_->folder / name).lexically_normal();
    if (document_->check_files) {
        const std::string problem = why_not_readable(file, pattern == FramePattern::allowed);
        if (!problem.empty()) {
            complain(key, fmt::format("is {}: {}", quote(name), problem));
            return false;
        }
    }
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

std::optional<Table> Table::table(std::string_view key, std::string where) {
    const toml::node* node = find(key);
    if (!node) return std::nullopt;
    if (node->is_table()) return Table(*document_, *node->as_table(), std::move(where), line_of(key));
    wrong_type(key, node->is_array_of_tables() ? fmt::format("one table: [{}], not [[{}]]", key, key) : "a table",
               *node);
    return std::nullopt;
}

std::vector<Table> Table::tables(std::string_view key) {
    std::vector<Table> out;
    const toml::node* node = find(key);
    if (!node) return out;
    const std::string wanted = fmt::format("an array of tables: [[{}]]", key);
    if (!node->is_array()) {
        wrong_type(key, wanted, *node);
        return out;
    }
    for (const toml::node& element : *node->as_array()) {
        if (!element.is_table()) {
            wrong_type(key, wanted, element);
            return out;
        }
        out.emplace_back(*document_, *element.as_table(), fmt::format("[[{}]] {}", key, out.size() + 1),
                         element.source().begin.line);
    }
    return out;
}

void Table::finish(const std::function<std::string(const std::string& key)>& explain) {
    for (const std::string& key : keys()) {
        if (std::find(known_.begin(), known_.end(), key) != known_.end()) continue;
        const std::string better = explain ? explain(key) : std::string{};
        if (!better.empty()) {
            complain(key, better);
            continue;
        }
        const std::string near = did_you_mean(key, known_);
        document_->problems.add(line_of(key), fmt::format("unknown key {} in {}{} known keys: {}", quote(key), where_,
                                                          near.empty() ? ";" : near, fmt::join(known_, ", ")));
    }
}

}  // namespace wrinkle::scene
