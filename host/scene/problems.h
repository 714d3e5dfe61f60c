#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace wrinkle::scene {

/// What is wrong with a file, collected so that all of it is told at once.
class Problems {
public:
    explicit Problems(std::string file_name) : file_name_(std::move(file_name)) {}

    void add(std::uint32_t line, std::string text) { found_.emplace_back(line, std::move(text)); }

    /// "scene.toml:12"
    std::string location(std::uint32_t line) const;

    /// Throws one Error with a line "scene.toml:12: text" each, in the order of the file; nothing when all is well.
    void throw_if_any();

private:
    std::string file_name_;
    std::vector<std::pair<std::uint32_t, std::string>> found_;
};

/// `text` in double quotes, on one line, shortened when long: safe to print whatever the file held.
std::string quote(std::string_view text);

/// "a", "b", "c"
std::string quote_list(std::span<const std::string> names);

/// `; did you mean "scale"?`, or nothing when no known name is near.
std::string did_you_mean(std::string_view name, std::span<const std::string> known);

}  // namespace wrinkle::scene
