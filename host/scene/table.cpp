#include "scene/table.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "base/names.h"

namespace wrinkle::scene {

void Table::learn(std::string_view key) {
    if (std::find(known_.begin(), known_.end(), key) == known_.end()) known_.emplace_back(key);
}

const toml::node* Table::find(std::string_view key) {
    learn(key);
    return visits() ? nullptr : values_->get(key);
}

void Table::note(std::string_view key, std::string value) {
    document_->structure.push_back({where_, std::string(key), std::move(value)});
}

std::uint32_t Table::line_of(std::string_view key) const {
    if (visits()) return line_;
    const auto found = values_->find(key);
    const bool has_line = found != values_->cend() && found->first.source().begin.line > 0;
    return has_line ? found->first.source().begin.line : line_;
}

std::vector<std::string> Table::keys() const {
    std::vector<std::string> out;
    if (visits()) return out;
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
    learn(key);
    if (visits()) required_.emplace_back(key);
    if (visits() || has(key)) return;
    bad_.emplace(key);
    complain_here(fmt::format("{} needs the key {}", where_, quote(key)));
}

void Table::only_with(std::string_view key, bool holds, std::string_view selector, std::string_view value) {
    if (holds || !has(key) || is_bad(selector)) return;
    complain(key, fmt::format("has an effect only with {} = {}; remove it or set that", selector, quote(value)));
}

std::optional<Table> Table::table(std::string_view key, std::string where, bool held) {
    if (visits()) {
        note(key, held ? "given" : "not given");
        return held ? std::optional(Table(*document_, std::move(where))) : std::nullopt;
    }
    const toml::node* node = find(key);
    if (!node) return std::nullopt;
    if (node->is_table()) return Table(*document_, *node->as_table(), std::move(where), line_of(key));
    wrong_type(key, node->is_array_of_tables() ? fmt::format("one table: [{}], not [[{}]]", key, key) : "a table",
               *node);
    return std::nullopt;
}

std::vector<Table> Table::tables(std::string_view key, std::size_t held) {
    std::vector<Table> out;
    for (std::size_t i = 0; visits() && i < held; ++i) out.emplace_back(*document_, fmt::format("{} {}", key, i + 1));
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
        const std::string near = document_->problems.enough() ? "" : did_you_mean(key, known_);
        document_->problems.add(line_of(key), fmt::format("unknown key {} in {}{} known keys: {}", quote(key), where_,
                                                          near.empty() ? ";" : near, fmt::join(known_, ", ")));
    }
}

}  // namespace wrinkle::scene
