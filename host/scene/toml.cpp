#define TOML_IMPLEMENTATION
#include "scene/toml.h"

#include <fmt/format.h>

#include "base/names.h"
#include "wrinkle/error.h"

namespace wrinkle::scene {

toml::table parse_toml(std::string_view text, const std::string& name, std::uint32_t first_line) {
    try {
        return toml::parse(text);
    } catch (const toml::parse_error& error) {
        const toml::source_position at = error.source().begin;
        throw Error(fmt::format("{}:{}:{}: not valid TOML: {}", name, at.line + first_line - 1, at.column,
                                error.description()));
    }
}

std::string describe(const toml::node& node) {
    switch (node.type()) {
        case toml::node_type::string:
            return "the text " + quote(node.as_string()->get());
        case toml::node_type::integer:
            return fmt::format("{}", node.as_integer()->get());
        case toml::node_type::boolean:
            return node.as_boolean()->get() ? "true" : "false";
        case toml::node_type::array:
            return node.as_array()->is_array_of_tables() ? "an array of tables"
                                                         : fmt::format("{} values in []", node.as_array()->size());
        case toml::node_type::table:
            return "a table";
        case toml::node_type::floating_point: {
            const std::string digits = fmt::format("{}", node.as_floating_point()->get());
            return digits.find_first_not_of("-0123456789") == std::string::npos ? digits + ".0" : digits;
        }
        default:
            return "a date or time";
    }
}

}  // namespace wrinkle::scene
