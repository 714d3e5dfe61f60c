#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/problems.h"
#include "scene/toml.h"

namespace wrinkle::scene {

/// The file a table belongs to.
struct Document {
    std::filesystem::path folder;  ///< what relative paths start from
    bool check_files = true;       ///< whether the files a scene names have to exist
    Problems problems;
};

/// Allowed numbers. Kernels compute in float32, so nothing passes that float32 cannot hold.
struct Range {
    double low = -std::numeric_limits<float>::max(), high = std::numeric_limits<float>::max();
    bool low_is_allowed = true, high_is_allowed = true;
};

constexpr Range any_number{};
constexpr Range positive{.low = 0, .low_is_allowed = false};
constexpr Range not_negative{.low = 0};
constexpr Range zero_to_one{.low = 0, .high = 1};

/// One TOML table that is being read. Each key asked for is a known key, so what is left over at finish() is a mistake,
/// and a new key needs its read() and nothing else. Values that are absent or wrong leave `out` as it was; what is
/// wrong goes to the document's problems. The read functions return whether `out` was set.
class Table {
public:
    /// `where` names the table in messages: `[[layer]] "cobbles"`.
    Table(Document& document, const toml::table& values, std::string where, std::uint32_t line)
        : document_(&document), values_(&values), where_(std::move(where)), line_(line) {}

    bool read(std::string_view key, bool& out);
    bool read(std::string_view key, int& out, int low, int high);
    bool read(std::string_view key, double& out, const Range& range = any_number);
    bool read(std::string_view key, std::string& out);
    bool read(std::string_view key, std::vector<std::string>& out);
    template <std::size_t N>
    bool read(std::string_view key, std::array<double, N>& out, const Range& range = any_number) {
        return read_numbers(key, out.data(), N, range);
    }
    bool read_degrees(std::string_view key, double& radians, const Range& degrees = any_number);
    template <std::size_t N>
    bool read_matrix(std::string_view key, std::array<std::array<double, N>, N>& out) {
        return read_rows(key, out.data()->data(), N);
    }

    /// An input file that has to exist. With a frame pattern (#### or %04d) only its folder has to.
    enum class FramePattern { refused, allowed };
    bool read_file(std::string_view key, std::filesystem::path& out, FramePattern pattern = FramePattern::refused);

    /// One of a few names.
    template <class T>
    bool choose(std::string_view key, T& out, std::initializer_list<std::pair<const char*, T>> choices) {
        std::vector<std::string> names;
        for (const auto& choice : choices) names.emplace_back(choice.first);
        const auto index = read_choice(key, names);
        if (index) out = (choices.begin() + *index)->second;
        return index.has_value();
    }
    std::optional<std::size_t> read_choice(std::string_view key, const std::vector<std::string>& names);

    std::optional<Table> table(std::string_view key, std::string where);
    /// An array of tables, each named by its place in messages: "[[key]] 2".
    std::vector<Table> tables(std::string_view key);

    bool has(std::string_view key) const { return values_->contains(key); }
    bool is_array(std::string_view key) const { return (*values_)[key].is_array(); }
    bool is_table(std::string_view key) const { return (*values_)[key].is_table(); }
    bool is_bad(std::string_view key) const { return bad_.contains(key); }

    /// Reports `key` when it is absent.
    void require(std::string_view key);
    /// Makes `key` a known key that is not read.
    void know(std::string_view key) { find(key); }
    /// `key` makes sense only while `holds`, which is up to the key `selector` being `value`.
    void only_with(std::string_view key, bool holds, std::string_view selector, std::string_view value);
    /// `"key" in <where> <text>`, at the key's line. The key counts as bad from then on.
    void complain(std::string_view key, std::string_view text);
    /// Text of one's own, at the table's line.
    void complain_here(std::string text) { document_->problems.add(line_, std::move(text)); }

    /// Reports what nobody asked for. `explain` may know better than "unknown key": it returns a text or nothing.
    void finish(const std::function<std::string(const std::string& key)>& explain = {});

    Document& document() const { return *document_; }
    const std::string& where() const { return where_; }
    void rename(std::string where) { where_ = std::move(where); }
    std::uint32_t line() const { return line_; }
    std::uint32_t line_of(std::string_view key) const;
    std::string location() const { return document_->problems.location(line_); }
    const std::vector<std::string>& known_keys() const { return known_; }
    std::vector<std::string> keys() const;

private:
    const toml::node* find(std::string_view key);
    bool number(std::string_view key, const toml::node& node, double& out, const Range& range,
                std::string_view element);
    bool read_numbers(std::string_view key, double* out, std::size_t count, const Range& range);
    bool read_rows(std::string_view key, double* out, std::size_t size);
    bool wrong_type(std::string_view key, std::string_view wanted, const toml::node& found);

    Document* document_;
    const toml::table* values_;
    std::string where_;
    std::uint32_t line_;
    std::vector<std::string> known_;
    std::set<std::string, std::less<>> bad_;
};

}  // namespace wrinkle::scene
