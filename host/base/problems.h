#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace wrinkle {

/// What is wrong with a file, collected so that all of it is told at once. Without a name: with what was made in code.
class Problems {
public:
    explicit Problems(std::string file_name) : file_name_(std::move(file_name)) {}

    void add(std::uint32_t line, std::string text) {
        if (enough())
            ++more_;
        else
            found_.emplace_back(line, std::move(text));
    }

    /// Whether further ones are only counted, so that nothing needs to be said about them. Nobody reads a thousand
    /// lines, and a file can have a hundred thousand.
    bool enough() const { return found_.size() >= kMost; }

    /// "scene.toml:12"
    std::string location(std::uint32_t line) const;

    /// Throws one Error with a line "scene.toml:12: text" each, in the order of the file; nothing when all is well.
    void throw_if_any();

private:
    static constexpr std::size_t kMost = 200;

    std::string file_name_;
    std::size_t more_ = 0;
    std::vector<std::pair<std::uint32_t, std::string>> found_;
};

}  // namespace wrinkle
