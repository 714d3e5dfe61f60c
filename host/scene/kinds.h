#pragma once

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <span>
#include <string>
#include <vector>

#include "base/names.h"
#include "scene/table.h"

namespace wrinkle::scene {

/// A table whose keys depend on its key `kind`: one row a kind.
template <class T>
struct Kind {
    const char* name;
    void (*read)(Table& table, T& out);
};

/// The keys a kind asks for, learned by letting it read an empty table: nowhere else are they written down.
template <class T>
std::vector<std::string> keys_of(const Kind<T>& kind) {
    Document nowhere{.folder = {}, .check_files = false, .problems = Problems("")};
    const toml::table empty;
    Table probe(nowhere, empty, "", 0);
    T ignored;
    kind.read(probe, ignored);
    return probe.known_keys();
}

/// Reads `kind`; gives its row, or null (and the problem is noted) when it is missing or unknown.
template <class T>
const Kind<T>* choose_kind(Table& table, std::span<const Kind<T>> kinds) {
    std::vector<std::string> names;
    for (const Kind<T>& kind : kinds) names.emplace_back(kind.name);
    if (!table.has("kind")) {
        table.know("kind");
        table.complain_here(fmt::format("{} needs the key \"kind\": {}", table.where(), quote_list(names)));
        return nullptr;
    }
    const auto index = table.read_choice("kind", names);
    return index ? &kinds[*index] : nullptr;
}

/// Reads what `kind` knows and reports every other key. Without a kind nobody can tell which keys are mistakes.
template <class T>
void read_as_kind(Table& table, std::span<const Kind<T>> kinds, const Kind<T>* kind, T& out) {
    if (!kind) return;
    kind->read(table, out);
    table.finish([&](const std::string& key) -> std::string {
        std::vector<std::string> owners;
        for (const Kind<T>& other : kinds) {
            const std::vector<std::string> keys = keys_of(other);
            if (std::find(keys.begin(), keys.end(), key) != keys.end()) owners.emplace_back(other.name);
        }
        if (owners.empty()) return {};
        return fmt::format("does not belong to kind {} but to {}; known keys: {}", quote(kind->name),
                           quote_list(owners), fmt::join(table.known_keys(), ", "));
    });
}

}  // namespace wrinkle::scene
