#include "scene/set_values.h"

#include <fmt/format.h>

#include "base/names.h"
#include "wrinkle/error.h"

namespace wrinkle::scene {
namespace {

/// The first "=" that is not in quotes.
std::size_t equals_of(const std::string& setting) {
    char quote = 0;
    for (std::size_t i = 0; i < setting.size(); ++i) {
        const char c = setting[i];
        if (quote == 0 && c == '=') return i;
        if (quote == 0 && (c == '"' || c == '\''))
            quote = c;
        else if (c == quote)
            quote = 0;
    }
    return std::string::npos;
}

/// `setting` as TOML, its value as a text where it is nothing else.
toml::table parse(const std::string& setting) {
    const std::string name = fmt::format("--set {}", setting);
    const std::size_t equals = equals_of(setting);
    if (equals == std::string::npos || setting.find('\n') != std::string::npos)
        throw Error(fmt::format("{}: expected KEY=VALUE, such as layer.cobbles.scale=0.02", name));
    const std::string key = setting.substr(0, equals) + " = ", value = setting.substr(equals + 1);
    try {
        return parse_toml(key + value, name);
    } catch (const Error&) {
        if (value.find('\'') != std::string::npos || value.find_first_not_of(' ') == std::string::npos) throw;
        return parse_toml(fmt::format("{}'{}'", key, value), name);
    }
}

/// What layers are called that have no name of their own.
std::string name_of(const toml::table& element, std::size_t number) {
    if (const auto name = element["name"].value<std::string>()) return *name;
    return fmt::format("{} {}", element["kind"].value_or(std::string("layer")), number);
}

/// The table of `array` that `key` names, by its name or its number.
toml::table& element_of(toml::array& array, std::string_view key, std::string_view array_name,
                        const std::string& setting) {
    std::vector<std::string> names;
    for (std::size_t i = 0; i < array.size(); ++i) {
        toml::table* const element = array[i].as_table();
        if (element == nullptr) continue;
        names.push_back(array_name == "layer" ? name_of(*element, i + 1) : std::to_string(i + 1));
        if (key == names.back() || key == std::to_string(i + 1)) return *element;
    }
    throw Error(fmt::format("--set {}: there is no {} {}; there are: {}", setting, array_name, quote(std::string(key)),
                            quote_list(names)));
}

void merge(toml::table& into, const toml::table& from, const std::string& setting) {
    for (const auto& [key, value] : from) {
        const toml::table* const inner = value.as_table();
        toml::node* const there = into.get(key.str());
        if (inner == nullptr || inner->is_inline() || there == nullptr) {
            into.insert_or_assign(std::string(key.str()), value);
        } else if (toml::table* const table = there->as_table()) {
            merge(*table, *inner, setting);
        } else if (toml::array* const array = there->as_array()) {
            for (const auto& [element, values] : *inner) {
                toml::table& chosen = element_of(*array, element.str(), key.str(), setting);
                if (!values.is_table())
                    throw Error(fmt::format("--set {}: names no key of {} {}", setting, std::string(key.str()),
                                            quote(std::string(element.str()))));
                merge(chosen, *values.as_table(), setting);
            }
        } else {
            throw Error(fmt::format("--set {}: {} is no table but {}", setting, quote(std::string(key.str())),
                                    describe(*there)));
        }
    }
}

}  // namespace

void set_value(toml::table& scene, const std::string& setting) { merge(scene, parse(setting), setting); }

}  // namespace wrinkle::scene
