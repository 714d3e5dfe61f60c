#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace wrinkle::io {

/// Records of a .npy file: a structured array of numpy's, one dimension, little-endian fields of numbers or text.
class NpyRecords {
public:
    /// `kind` as numpy has it: f, i, u, b numbers; S, U text.
    struct Field {
        std::string name;
        char kind = 'f';
        std::size_t size = 0, offset = 0;  ///< bytes
        bool is_text() const { return kind == 'S' || kind == 'U'; }
    };

    /// Whether a file begins as a .npy file does.
    static bool is(const std::filesystem::path& file);

    /// Throws Error for anything else, saying what is there, and for a file that is cut short.
    explicit NpyRecords(const std::filesystem::path& file);

    const std::vector<Field>& fields() const { return fields_; }
    std::size_t rows() const { return rows_; }
    /// Of a field of numbers, every one of which a double holds but integers beyond 2^53.
    double number(std::size_t row, const Field& field) const;
    /// Of a field of text; what is not ASCII in a field of kind U is '?'.
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
