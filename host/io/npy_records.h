#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace wrinkle::io {

/// The records of a .npy file: a structured array of numpy's with one dimension. Fields are numbers or text, and
/// little-endian.
class NpyRecords {
public:
    /// `kind` is numpy's letter: f, i, u and b are numbers, S and U are text.
    struct Field {
        std::string name;
        char kind = 'f';
        std::size_t size = 0, offset = 0;  ///< bytes
        bool is_text() const { return kind == 'S' || kind == 'U'; }
    };

    /// Whether a file begins like a .npy file.
    static bool is(const std::filesystem::path& file);

    /// Throws Error when the file holds something else, and says what; and when it is cut short.
    explicit NpyRecords(const std::filesystem::path& file);

    const std::vector<Field>& fields() const { return fields_; }
    std::size_t rows() const { return rows_; }
    std::size_t file_bytes() const { return bytes_.size(); }
    /// The number of a row in a field of numbers. Integers beyond 2^53 are rounded.
    double number(std::size_t row, const Field& field) const;
    /// The text of a row in a field of text. Characters of kind U that are not ASCII become '?'.
    std::string text(std::size_t row, const Field& field) const;

private:
    const char* at(std::size_t row, const Field& field) const {
        return bytes_.data() + data_ + row * stride_ + field.offset;
    }

    std::string bytes_;
    std::size_t data_ = 0, rows_ = 0, stride_ = 0;
    std::vector<Field> fields_;
};

}  // namespace wrinkle::io
