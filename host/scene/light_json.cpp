#include "scene/light_json.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "base/names.h"
#include "io/json_file.h"
#include "scene/readers.h"
#include "wrinkle/error.h"

namespace wrinkle::scene {
namespace {

using nlohmann::json;

/// Hands a value to `put`, as TOML has it. Keys of lights take nothing else: an empty table stands for the rest, so
/// that whoever reads it says what is expected in its place.
template <class Put>
void put_plain(const json& value, const Put& put) {
    if (value.is_boolean())
        put(value.get<bool>());
    else if (value.is_number())
        put(value.get<double>());
    else if (value.is_string())
        put(value.get<std::string>());
    else
        put(toml::table());
}

/// null stands for a key that is left out.
toml::table table_of(const json& object) {
    toml::table table;
    for (const auto& [key, value] : object.items()) {
        const auto insert = [&, &name = key](auto plain) { table.insert_or_assign(name, std::move(plain)); };
        if (value.is_array()) {
            toml::array array;
            for (const json& element : value)
                put_plain(element, [&](auto plain) { array.push_back(std::move(plain)); });
            insert(std::move(array));
        } else if (!value.is_null()) {
            put_plain(value, insert);
        }
    }
    return table;
}

}  // namespace

bool is_json(const std::filesystem::path& file) { return lower(file.extension().string()) == ".json"; }

void read_light_json(Table& table, std::string_view key, const std::filesystem::path& file, std::vector<Light>& out) {
    constexpr const char* expected = "{\"lights\": [{\"kind\": ...}, ...]}, each with the keys of a [[light]]";
    json lights;
    try {
        lights = io::read_json_object(file, "a file of lights", expected)["lights"];
        if (!lights.is_array() || !std::ranges::all_of(lights, &json::is_object))
            throw Error(fmt::format("{}: not a file of lights: expected {}", file.string(), expected));
    } catch (const Error& error) { return table.complain(key, fmt::format("cannot be used:\n{}", error.what())); }
    for (std::size_t i = 0; i < lights.size(); ++i) {
        const toml::table values = table_of(lights[i]);
        Table light(table.document(), values, fmt::format("light {} of {}", i + 1, quote(file.string())),
                    table.line_of(key));
        read_light(light, out.emplace_back());
    }
}

}  // namespace wrinkle::scene
