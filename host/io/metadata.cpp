#include "io/metadata.h"

#include <utility>

#include "io/metadata_data.h"

namespace wrinkle {
namespace {

const OIIO::ParamValue* find(const OIIO::ParamValueList& list, std::string_view name) {
    const auto found = list.find(OIIO::string_view(name.data(), name.size()));
    return found == list.cend() ? nullptr : &*found;
}

}  // namespace

Metadata::Metadata() : data_(std::make_unique<Data>()) {}
Metadata::~Metadata() = default;
Metadata::Metadata(const Metadata& other) : data_(std::make_unique<Data>(*other.data_)) {}
Metadata::Metadata(Metadata&& other) noexcept = default;
Metadata& Metadata::operator=(Metadata other) noexcept {
    data_.swap(other.data_);
    return *this;
}

void Metadata::set(std::string_view name, std::string_view value) {
    data_->list.attribute(OIIO::string_view(name.data(), name.size()), OIIO::string_view(value.data(), value.size()));
}

void Metadata::set(std::string_view name, const Mat4& row_vectors) {
    float values[16];
    for (int i = 0; i < 16; ++i) values[i] = static_cast<float>(row_vectors[i / 4][i % 4]);
    data_->list.attribute(OIIO::string_view(name.data(), name.size()), OIIO::TypeMatrix44, values);
}

std::optional<std::string> Metadata::text(std::string_view name) const {
    const auto* value = find(data_->list, name);
    if (value == nullptr) return std::nullopt;
    return value->get_string(0);  // 0: of any length, as manifests are long
}

std::optional<double> Metadata::number(std::string_view name) const {
    const auto* value = find(data_->list, name);
    if (value == nullptr || value->type().aggregate != OIIO::TypeDesc::SCALAR) return std::nullopt;
    if (value->type() == OIIO::TypeDesc(OIIO::TypeDesc::DOUBLE)) return value->get<double>();
    return value->get_float();
}

std::optional<Mat4> Metadata::matrix(std::string_view name) const {
    const auto* value = find(data_->list, name);
    if (value == nullptr) return std::nullopt;
    const auto type = value->type();
    if (type.numelements() * type.aggregate != 16) return std::nullopt;
    Mat4 matrix{};
    for (int i = 0; i < 16; ++i) {
        double& element = matrix[i / 4][i % 4];
        if (type.basetype == OIIO::TypeDesc::FLOAT) {
            element = static_cast<const float*>(value->data())[i];
        } else if (type.basetype == OIIO::TypeDesc::DOUBLE) {
            element = static_cast<const double*>(value->data())[i];
        } else {
            return std::nullopt;
        }
    }
    return matrix;
}

std::vector<std::string> Metadata::names() const {
    std::vector<std::string> result;
    for (const auto& value : data_->list) result.push_back(value.name().string());
    return result;
}

}  // namespace wrinkle
