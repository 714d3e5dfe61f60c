#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "wrinkle/camera.h"

namespace wrinkle {

/// The attributes of an image header. They can be read by name, and copied from one file to another with their types.
/// Hides OpenImageIO from those who include this header.
class Metadata {
public:
    struct Data;

    Metadata();
    ~Metadata();
    Metadata(const Metadata& other);
    Metadata(Metadata&& other) noexcept;
    Metadata& operator=(Metadata other) noexcept;

    void set(std::string_view name, std::string_view value);
    void set(std::string_view name, const Mat4& row_vectors);  ///< written as M44f

    /// Value as text; nothing when the attribute is missing.
    std::optional<std::string> text(std::string_view name) const;
    std::optional<double> number(std::string_view name) const;
    /// A 4x4 matrix as it lies in the file, sixteen numbers row by row.
    std::optional<Mat4> matrix(std::string_view name) const;

    std::vector<std::string> names() const;

    Data& data() { return *data_; }
    const Data& data() const { return *data_; }

private:
    std::unique_ptr<Data> data_;
};

}  // namespace wrinkle
