#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace wrinkle {

/// What is wrong with a file, collected so that all of it is told at once; or with what no file holds, without a name.
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

}  // namespace wrinkle
