#include "scene/scene_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <set>
#include <sstream>

#include "base/names.h"
#include "scene/toml.h"

namespace wrinkle::scene {
namespace {

constexpr std::string_view kName = "the scene";

/// Keys of counts. One that is missing here gets a knob that is too fine, and its values an error.
const std::set<std::string_view> kCounts{"octaves", "steps", "refine", "taps", "seed"};
/// Tables that choose pixels by numbers which are names.
const std::set<std::string_view> kNames{"mask", "leave"};
const std::set<std::string_view> kColors{"color", "ambient", "albedo", "zenith", "horizon", "ground"};

/// Finds numbers of a document in its text. toml++ counts columns in characters, not in bytes.
class Finder {
public:
    explicit Finder(std::string_view text) : text_(text), lines_{0} {
        for (std::size_t i = 0; i < text.size(); ++i)
            if (text[i] == '\n') lines_.push_back(i + 1);
    }

    void add_array(const toml::table& root, std::string_view key) {
        const toml::array* const array = root.get_as<toml::array>(key);
        if (array == nullptr) return;
        for (std::size_t i = 0; i < array->size(); ++i) {
            const toml::table* const table = (*array)[i].as_table();
            if (table == nullptr) continue;
            const std::string name = (*table)["name"].value_or(std::string());
            const std::string kind = (*table)["kind"].value_or(std::string(key));
            group_ = name.empty() ? fmt::format("{} {}", kind, i + 1) : name;
            add_table(*table, fmt::format("{}.{}", key, i), "");
        }
    }

    void add_one(const toml::table& root, std::string_view key) {
        const toml::table* const table = root.get_as<toml::table>(key);
        if (table == nullptr) return;
        group_ = key;
        add_table(*table, std::string(key), "");
    }

    std::vector<SceneNumber> take() {
        std::ranges::sort(found_, {}, &SceneNumber::begin);
        return std::move(found_);
    }

private:
    void add_table(const toml::table& table, const std::string& id, const std::string& name) {
        for (const auto& [key, node] : table) {
            const std::string_view called = key.str();
            if (kNames.contains(called)) continue;
            const std::string inner = fmt::format("{}.{}", id, called);
            const std::string shown = name.empty() ? std::string(called) : fmt::format("{}.{}", name, called);
            if (const toml::table* const deeper = node.as_table())
                add_table(*deeper, inner, shown);
            else if (const toml::array* const array = node.as_array())
                add_numbers(*array, inner, shown, called);
            else
                add(node, inner, shown, called);
        }
    }

    void add_numbers(const toml::array& array, const std::string& id, const std::string& name, std::string_view key) {
        constexpr std::size_t most = 4;
        if (array.size() > most) return;
        for (std::size_t i = 0; i < array.size(); ++i) {
            const char* const parts = kColors.contains(key) ? "rgb" : "xyz";
            add(array[i], fmt::format("{}.{}", id, i),
                array.size() < most ? fmt::format("{} {}", name, parts[i]) : fmt::format("{} {}", name, i + 1), key);
        }
    }

    void add(const toml::node& node, const std::string& id, const std::string& name, std::string_view key) {
        if (!node.is_number()) return;
        const std::optional<double> value = node.value<double>();
        const std::size_t begin = byte_of(node.source().begin);
        if (begin >= text_.size() || !value) return;
        const std::size_t end = std::min(text_.find_first_not_of("+-0123456789.eE_", begin), text_.size());
        // What is written otherwise (0xff, inf) stays as it is.
        std::string digits(text_.substr(begin, end - begin));
        std::erase(digits, '_');
        if (digits.starts_with('+')) digits.erase(0, 1);
        double read = 0;
        const auto result = std::from_chars(digits.data(), digits.data() + digits.size(), read);
        if (result.ec != std::errc() || result.ptr != digits.data() + digits.size() || read != *value) return;
        found_.push_back({id, group_, name, node.source().begin.line, read, kCounts.contains(key), begin, end - begin});
    }

    std::size_t byte_of(const toml::source_position& place) const {
        if (place.line == 0 || place.line > lines_.size()) return text_.size();
        std::size_t at = lines_[place.line - 1];
        const auto continues = [&] {
            return at < text_.size() && (static_cast<unsigned char>(text_[at]) & 0xc0) == 0x80;
        };
        for (std::uint32_t column = 1; column < place.column && at < text_.size(); ++column) {
            ++at;
            while (continues()) ++at;
        }
        return at;
    }

    std::string_view text_;
    std::vector<std::size_t> lines_;  ///< where they begin
    std::string group_;
    std::vector<SceneNumber> found_;
};

std::string written(double value, bool whole) {
    if (whole && value == std::round(value)) return fmt::format("{:.0f}", value);
    const std::string digits = fmt::format("{}", value);
    return digits.find_first_not_of("-0123456789") == std::string::npos ? digits + ".0" : digits;
}

}  // namespace

std::string frame_tables(std::string_view text) {
    const toml::table root = parse_toml(text, std::string(kName));
    std::ostringstream out;
    for (const char* const key : {"gbuffer", "camera"})
        if (const toml::table* const table = root.get_as<toml::table>(key))
            out << toml::toml_formatter(*table) << "\n\n";
    return out.str();
}

std::vector<SceneNumber> numbers_in(std::string_view text) {
    const toml::table root = parse_toml(text, std::string(kName));
    Finder finder(text);
    for (const char* const key : {"layer", "light"}) finder.add_array(root, key);
    for (const char* const key : {"lighting", "filter"}) finder.add_one(root, key);
    return finder.take();
}

std::string with_numbers(std::string text, const std::map<std::string, double>& values) {
    std::vector<SceneNumber> numbers = numbers_in(text);
    for (auto number = numbers.rbegin(); number != numbers.rend(); ++number) {  // from the end: places stay right
        const auto value = values.find(number->id);
        if (value == values.end() || value->second == number->value || !std::isfinite(value->second)) continue;
        text.replace(number->begin, number->size, written(value->second, number->whole));
    }
    return text;
}

}  // namespace wrinkle::scene
