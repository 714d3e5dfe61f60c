#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/problems.h"
#include "scene/toml.h"

namespace wrinkle::scene {

/// Whether kernels are compiled for a value, or read it from a buffer (or never do).
enum class Compiled { no, yes };

/// A value of a scene that kernels are compiled for.
struct Structure {
    std::string where, key, value;  ///< `layer "dents"`, octaves, 3
};

/// The file a table belongs to; or a scene in memory, whose values are visited.
struct Document {
    std::filesystem::path folder;  ///< what relative paths start from
    bool check_files = true;       ///< whether the files a scene names have to exist
    Problems problems;
    std::vector<Structure> structure{};  ///< of what was visited
    std::string view{};                  ///< stands for %V in the names of files
    bool view_in_names = false;          ///< whether a name had it
    std::optional<int> frame{};          ///< fills places for a number in names, but those of the G-buffer
    std::vector<std::filesystem::path> frame_files{};  ///< those names
    std::vector<std::filesystem::path> files{};        ///< that were read or will be, but the frame's
    std::vector<std::filesystem::path> kept{};         ///< the frame's: names that keep their place for a number
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

double to_radians(double degrees);
/// Whole degrees stay whole: the rounding of the conversion is undone.
double to_degrees(double radians);

/// One TOML table that is being read. Each key asked for is a known key, so what is left over at finish() is a mistake,
/// and a new key needs its read() and nothing else. Values that are absent or wrong leave `out` as it was; what is
/// wrong goes to the document's problems. The read functions return whether `out` was set.
///
/// A visiting table has no file: what `out` holds already stands where the file's value would, so a scene made in code
/// is checked by the same rules, and what of it is compiled in goes to the document's structure. Such a table has no
/// keys: has() and its like return false.
class Table {
public:
    /// `where` names the table in messages: `[[layer]] "cobbles"`.
    Table(Document& document, const toml::table& values, std::string where, std::uint32_t line)
        : document_(&document), values_(&values), where_(std::move(where)), line_(line) {}
    /// A visiting one.
    Table(Document& document, std::string where) : document_(&document), where_(std::move(where)) {}
    bool visits() const { return values_ == nullptr; }

    bool read(std::string_view key, bool& out, Compiled compiled = Compiled::yes);
    bool read(std::string_view key, int& out, int low, int high);
    bool read(std::string_view key, double& out, const Range& range = any_number);
    bool read(std::string_view key, std::string& out, Compiled compiled = Compiled::yes);
    bool read(std::string_view key, std::vector<std::string>& out);
    /// One value or an array of them, at least one. How many there are is compiled in, what they are is not.
    bool read_some(std::string_view key, std::vector<double>& out);
    bool read_some(std::string_view key, std::vector<std::string>& out);
    template <std::size_t N>
    bool read(std::string_view key, std::array<double, N>& out, const Range& range = any_number) {
        return read_numbers(key, out.data(), N, range);
    }
    /// An optional value. Whether it is there is compiled in; what it is only if `more` says so.
    template <class T, class... More>
    bool read(std::string_view key, std::optional<T>& out, const More&... more) {
        if (visits()) note(key, out ? "given" : "not given");
        if (visits() && !out) return false;
        if (visits()) require(key);
        T value = out.value_or(T{});
        if (!read(key, value, more...)) return false;
        out = std::move(value);
        return true;
    }
    /// Files give angles in degrees, scenes hold them in radians.
    bool read_degrees(std::string_view key, double& radians, const Range& degrees = any_number);
    template <std::size_t N>
    bool read_degrees(std::string_view key, std::array<double, N>& radians, const Range& degrees = any_number) {
        std::array<double, N> values{};
        for (std::size_t i = 0; i < N; ++i) values[i] = to_degrees(radians[i]);
        if (!read(key, values, degrees)) return false;
        for (std::size_t i = 0; i < N; ++i) radians[i] = to_radians(values[i]);
        return true;
    }
    template <std::size_t N>
    bool read_matrix(std::string_view key, std::array<std::array<double, N>, N>& out) {
        return read_rows(key, out.data()->data(), N);
    }

    /// A file's name, in which $NAME stands for a variable of the environment and %V for the view.
    bool read_name(std::string_view key, std::string& out);
    /// An input file that has to exist. A place for a frame number (#### or %04d) is filled with the document's, or
    /// kept, and then only the folder has to exist.
    enum class FramePattern { filled, kept };
    bool read_file(std::string_view key, std::filesystem::path& out, FramePattern pattern = FramePattern::filled);

    /// One of a few names.
    template <class T>
    bool choose(std::string_view key, T& out, std::initializer_list<std::pair<const char*, T>> choices,
                Compiled compiled = Compiled::yes) {
        std::vector<std::string> names;
        const char* held = nullptr;
        for (const auto& [name, value] : choices) {
            names.emplace_back(name);
            if (value == out) held = name;
        }
        if (visits()) return visit_choice(key, held, static_cast<int>(out), names, compiled);
        const auto index = read_choice(key, names);
        if (index) out = (choices.begin() + *index)->second;
        return index.has_value();
    }
    std::optional<std::size_t> read_choice(std::string_view key, const std::vector<std::string>& names);

    /// A table within this one; where this one visits, it is there if `held` says so.
    std::optional<Table> table(std::string_view key, std::string where, bool held);
    std::optional<Table> table(std::string_view key, std::string where) { return table(key, std::move(where), true); }
    /// An array of tables, each named by its place in messages: "[[key]] 2"; where this one visits, `held` of them.
    std::vector<Table> tables(std::string_view key, std::size_t held);

    bool has(std::string_view key) const { return !visits() && values_->contains(key); }
    bool is_array(std::string_view key) const { return !visits() && (*values_)[key].is_array(); }
    bool is_integer(std::string_view key) const { return !visits() && (*values_)[key].is_integer(); }
    bool is_table(std::string_view key) const { return !visits() && (*values_)[key].is_table(); }
    bool is_bad(std::string_view key) const { return bad_.contains(key); }

    /// Reports `key` when it is absent.
    void require(std::string_view key);
    /// Makes `key` a known key that is not read.
    void know(std::string_view key) { learn(key); }
    /// Notes what kernels have compiled in of `key`: whether a mapping turns, how many octaves there are. A pass
    /// refuses scenes with another answer than the one that it was compiled for. For keys whose reading notes too
    /// little by itself: that of a number notes nothing, while switches and choices note what they are.
    template <class T>
    void compiled_in(std::string_view key, const T& what) {
        if (visits()) note(key, to_text(what));
    }
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
    /// The value of a key: the file's, or one made of what is held in its place.
    class Value {
    public:
        explicit Value(const toml::node* of_file) : node_(of_file) {}
        explicit Value(std::unique_ptr<toml::node> held) : held_(std::move(held)), node_(held_.get()) {}
        explicit operator bool() const { return node_ != nullptr; }
        const toml::node& operator*() const { return *node_; }
        const toml::node* operator->() const { return node_; }

    private:
        std::unique_ptr<toml::node> held_;
        const toml::node* node_;
    };
    void learn(std::string_view key);
    const toml::node* find(std::string_view key);
    template <class T>
    Value value_of(std::string_view key, const T& held);
    Value text_of(std::string_view key, const std::string& held);
    static std::string to_text(bool value) { return value ? "true" : "false"; }
    static std::string to_text(int value) { return std::to_string(value); }
    static std::string to_text(std::string value) { return value; }
    void note(std::string_view key, std::string value);
    bool visit_choice(std::string_view key, const char* held, int number, const std::vector<std::string>& names,
                      Compiled compiled);
    bool number(std::string_view key, const toml::node& node, double& out, const Range& range,
                std::string_view element);
    bool visit_numbers(std::string_view key, double* held, std::size_t count, const Range& range,
                       std::string_view element);
    bool read_numbers(std::string_view key, double* out, std::size_t count, const Range& range);
    bool read_rows(std::string_view key, double* out, std::size_t size);
    /// The values of a key that holds one or an array of them; empty where it is missing or holds none.
    std::vector<Value> some(std::string_view key, std::string_view wanted);
    bool text(std::string_view key, const toml::node& node, std::string& out, std::string_view element);
    bool wrong_type(std::string_view key, std::string_view wanted, const toml::node& found);

    Document* document_;
    const toml::table* values_ = nullptr;  ///< null: it visits
    std::string where_;
    std::uint32_t line_ = 0;
    std::vector<std::string> known_, required_;
    std::set<std::string, std::less<>> bad_;
};

}  // namespace wrinkle::scene
