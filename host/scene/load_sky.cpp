#include <cmath>
#include <numbers>

#include "io/sky_picture.h"
#include "wrinkle/lighting.h"

namespace wrinkle {
namespace {

using Row = std::array<double, 9>;

/// Integrals of the nine polynomials of SkyHarmonics over the pixels of a row, up to what depends on the column.
struct RowIntegrals {
    double flat, up, side, side_up, twice, rise;  ///< of 1, z, x or y, yz or zx, xy or x^2 - y^2, and 3 z^2 - 1

    /// `high`, `low`: sines of the elevation that the row lies between.
    RowIntegrals(double high, double low) {
        const auto cosine = [](double z) { return std::sqrt(std::max(1 - z * z, 0.0)); };
        const auto between = [&](auto&& of) { return of(high) - of(low); };
        flat = high - low;
        up = between([](double z) { return z * z / 2; });
        side = between([&](double z) { return (z * cosine(z) + std::asin(z)) / 2; });
        side_up = between([&](double z) { return -std::pow(cosine(z), 3) / 3; });
        twice = between([](double z) { return z - z * z * z / 3; });
        rise = between([](double z) { return z * z * z - z; });
    }

    /// Of a pixel between two angles around the zenith, counter-clockwise.
    Row pixel(double from, double to) const {
        const double turn = to - from, x = std::sin(to) - std::sin(from), y = std::cos(from) - std::cos(to);
        const double sines = std::sin(to) * std::sin(to) - std::sin(from) * std::sin(from);
        return {flat * turn,       side * x,    side * y,    up * turn,
                twice * sines / 2, side_up * y, side_up * x, twice * (std::sin(2 * to) - std::sin(2 * from)) / 2,
                rise * turn};
    }
};

/// Squares of what makes the polynomials orthonormal, times the clamped cosine's factors 1, 2/3 and 1/4 over pi.
double factor(std::size_t k) {
    constexpr double over = 1 / (4 * std::numbers::pi);
    if (k == 0) return over;
    if (k < 4) return 2 * over;
    if (k < 7) return 15.0 / 4 * over;
    return (k == 7 ? 15.0 : 5.0) / 16 * over;
}

}  // namespace

SkyHarmonics load_sky(const std::filesystem::path& file) {
    SkyHarmonics sky{};
    io::read_sky(file, [&](const io::SkyRow& row) {
        const auto sine = [&](int edge) { return std::cos(std::numbers::pi * edge / row.height); };
        const RowIntegrals integrals(sine(row.y), sine(row.y + 1));
        for (int x = 0; x < row.width; ++x) {
            const auto angle = [&](int edge) {
                return std::numbers::pi * (1 - 2 * static_cast<double>(edge) / row.width);
            };
            const Row weights = integrals.pixel(angle(x + 1), angle(x));
            for (std::size_t c = 0; c < 3; ++c) {
                const double radiance = double{row.rgb[3 * static_cast<std::size_t>(x) + c]};
                for (std::size_t k = 0; k < 9; ++k) sky[k][c] += radiance * weights[k] * factor(k);
            }
        }
    });
    return sky;
}

}  // namespace wrinkle
