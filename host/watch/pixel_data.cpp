#include "watch/pixel_data.h"

#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <nlohmann/json.hpp>

#include "base/error_stats.h"
#include "base/vec.h"
#include "io/object_ids.h"

namespace wrinkle {
namespace {

using TableRows = std::vector<std::pair<std::string, std::string>>;

/// The planes of a picture at one pixel.
class At {
public:
    At(const WholePlanes& planes, std::size_t pixel) : planes_(planes), pixel_(pixel) {}

    std::optional<float> number(const std::string& name) const {
        const auto plane = planes_.find(name);
        return plane == planes_.end() ? std::nullopt : std::optional(plane->second[pixel_]);
    }
    std::optional<Vec3> vec(const std::string& name, const char* parts) const {
        Vec3 out{};
        for (std::size_t k = 0; k < 3; ++k) {
            const auto part = number(fmt::format("{}.{}", name, parts[k]));
            if (!part) return {};
            out[k] = static_cast<double>(*part);
        }
        return out;
    }

private:
    const WholePlanes& planes_;
    std::size_t pixel_;
};

std::string text(const Vec3& v) { return fmt::format("{:.4g}, {:.4g}, {:.4g}", v[0], v[1], v[2]); }

double angle_between(const Vec3& a, const Vec3& b) { return angle_degrees({a[0], a[1], a[2]}, {b[0], b[1], b[2]}); }

double length(const Vec3& v) { return std::sqrt(dot(v, v)); }

std::string object_at(const LookImage& image, const At& frame) {
    if (const auto id = frame.number("crypto.id0")) {
        const auto bits = std::bit_cast<std::uint32_t>(*id);
        const auto name = image.objects.find(bits);
        if (name != image.objects.end()) return name->second;
        if (bits != 0) return fmt::format("#{:08x}", bits);
    }
    if (const auto label = frame.number("object")) return fmt::format("{:.9g}", io::object_number(*label));
    return {};
}

}  // namespace

nlohmann::json pixel_data(const LookImage& image, const LookPixel& pixel, std::uint32_t x, std::uint32_t y) {
    const std::size_t i = std::size_t{y} * image.size.width + x;
    const At frame(*image.frame, i), out(image.out, i);
    TableRows rows{{"pixel", fmt::format("{}, {}", x, y)}};
    if (const std::string object = object_at(image, frame); !object.empty()) rows.emplace_back("object", object);
    const auto base = frame.vec("normal", "xyz"), normal = out.vec("normal", "xyz");
    if (base) rows.emplace_back("normal before", text(*base));
    if (normal) rows.emplace_back("normal", text(*normal));
    if (base && normal) rows.emplace_back("turned by", fmt::format("{:.3g} degrees", angle_between(*base, *normal)));
    const auto right = out.vec("dp_dx", "xyz"), down = out.vec("dp_dy", "xyz");
    if (right && down)
        rows.emplace_back("footprint", fmt::format("{:.3g} x {:.3g} mm", 1000 * length(*right), 1000 * length(*down)));
    if (const auto roughness = out.number("roughness"))
        rows.emplace_back("roughness", fmt::format("{:.3g}", *roughness));
    if (const auto condition = out.number("condition"))
        rows.emplace_back("condition", fmt::format("{:.3g}", *condition));
    if (const auto marked = out.number("marked")) rows.emplace_back("marked", fmt::format("{:.0f}", *marked));
    const auto before = image.unbumped ? At(*image.unbumped, i).vec("lit", "rgb") : frame.vec("beauty", "rgb");
    if (before && out.number("lit.r")) rows.emplace_back("picture before", text(*before));
    if (const auto lit = out.vec("lit", "rgb")) rows.emplace_back("picture", text(*lit));
    std::size_t none = 0;
    for (const auto& [layer, gradient] : pixel.gradients) {
        if (length(gradient) > 0)
            rows.emplace_back("gradient of " + layer, fmt::format("{} ({:.3g})", text(gradient), length(gradient)));
        else
            ++none;
    }
    if (none > 0) rows.emplace_back(fmt::format("gradient of {} {}", none, none == 1 ? "layer" : "layers"), "0");
    return rows;
}

}  // namespace wrinkle
