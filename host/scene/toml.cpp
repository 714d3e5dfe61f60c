#define TOML_IMPLEMENTATION
#include "scene/toml.h"

#include <fmt/format.h>

#include <optional>

#include "base/names.h"
#include "wrinkle/error.h"

namespace wrinkle::scene {
namespace {

/// Finds the first dotted key (a.b.c) of more parts than any scene has. toml++ makes nested tables of the parts and
/// destroys them recursively: a key of a million parts overflows the stack. It limits nested brackets by itself.
class LongKey {
public:
    explicit LongKey(std::string_view text) : text_(text) {}

    /// The key's line, counted from 0; nothing when there is no such key.
    std::optional<std::uint32_t> line() {
        int parts = 1;
        while (at_ < text_.size()) {
            const char c = text_[at_];
            if (c == '"' || c == '\'') {
                skip_string(c);
                continue;
            }
            if (c == '#') skip_to('\n');
            if (c == '.' && ++parts > kMostParts) return line_;
            if (std::string_view("=,[]{}\n#").find(c) != std::string_view::npos) parts = 1;
            next();
        }
        return {};
    }

private:
    static constexpr int kMostParts = 16;

    void next() {
        if (at_ < text_.size() && text_[at_++] == '\n') ++line_;
    }
    void skip_to(char c) {
        while (at_ < text_.size() && text_[at_] != c) next();
    }

    /// Skips a string in one or three quotes; one in three may have several lines.
    void skip_string(char quote) {
        const std::string three(3, quote);
        const bool long_text = text_.substr(at_).starts_with(three);
        for (int i = long_text ? 3 : 1; i > 0; --i) next();
        while (at_ < text_.size()) {
            if (quote == '"' && text_[at_] == '\\')
                next();
            else if (long_text ? text_.substr(at_).starts_with(three) : text_[at_] == quote || text_[at_] == '\n')
                break;
            next();
        }
        for (int i = long_text ? 3 : 1; i > 0; --i) next();
    }

    std::string_view text_;
    std::size_t at_ = 0;
    std::uint32_t line_ = 0;
};

}  // namespace

toml::table parse_toml(std::string_view text, const std::string& name, std::uint32_t first_line) {
    if (const auto line = LongKey(text).line())
        throw Error(fmt::format("{}:{}: not a scene: a key of more than 16 parts (a.b.c)", name, *line + first_line));
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
