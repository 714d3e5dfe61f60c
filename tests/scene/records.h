#pragma once

#include <string>
#include <utility>

namespace wrinkle {

/// A structured array as numpy writes it.
class Records {
public:
    /// `descr` as Python prints it: "('x', '<f8'), ('shape', '<U6')".
    Records(std::string descr, std::size_t rows) : descr_(std::move(descr)), rows_(rows) {}
    template <class T>
    Records& put(T value) {
        data_.append(reinterpret_cast<const char*>(&value), sizeof value);
        return *this;
    }
    Records& text(std::string value, std::size_t size) {
        value.resize(size);
        data_ += value;
        return *this;
    }
    Records& wide_text(const std::u32string& value, std::size_t size) {
        for (std::size_t i = 0; i < size; ++i) put(i < value.size() ? value[i] : U'\0');
        return *this;
    }
    std::string bytes() const {
        std::string dict =
            "{'descr': [" + descr_ + "], 'fortran_order': False, 'shape': (" + std::to_string(rows_) + ",), }";
        dict.append(63 - (10 + dict.size()) % 64, ' ');
        dict += '\n';
        std::string out = "\x93NUMPY";
        out += {'\x01', '\x00', static_cast<char>(dict.size() & 255), static_cast<char>(dict.size() >> 8)};
        return out + dict + data_;
    }

private:
    std::string descr_, data_;
    std::size_t rows_;
};

}  // namespace wrinkle
