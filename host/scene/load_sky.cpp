#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "base/names.h"
#include "io/image_open.h"
#include "wrinkle/error.h"
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

/// The places of red, green and blue among the channels.
std::array<int, 3> colours(const OIIO::ImageSpec& spec, const std::string& file) {
    std::array<int, 3> places{spec.channelindex("R"), spec.channelindex("G"), spec.channelindex("B")};
    if (std::ranges::min(places) < 0)
        throw Error(fmt::format("{}: is no picture of a sky: it has no channels R, G and B", file));
    return places;
}

}  // namespace

SkyHarmonics load_sky(const std::filesystem::path& file) {
    const io::OpenImage image(file);
    const OIIO::ImageSpec& spec = image.input().spec();
    const std::string name = file.string();
    if (!spec.format.is_floating_point())
        throw Error(
            fmt::format("{}: holds integers, which are colours for a display; a sky has to be light, in EXR or "
                        "Radiance's HDR",
                        name));
    if (spec.tile_width != 0)
        throw Error(
            fmt::format("{}: is stored in tiles; a sky is read in rows (oiiotool FILE --scanline -o SKY.exr)", name));
    if (spec.width != 2 * spec.height || spec.height < 1)
        throw Error(fmt::format(
            "{}: is {} x {}; a picture of all directions, by longitude and latitude, is twice as wide as high", name,
            spec.width, spec.height));
    const std::array<int, 3> places = colours(spec, name);
    const auto width = static_cast<std::size_t>(spec.width), channels = static_cast<std::size_t>(spec.nchannels);
    std::vector<float> row(width * channels);
    SkyHarmonics sky{};
    for (int y = 0; y < spec.height; ++y) {
        if (!image.input().read_scanline(spec.y + y, spec.z, OIIO::TypeFloat, row.data()))
            throw Error(fmt::format("{}: cannot be read from row {} on: {}", name, y, image.input().geterror()));
        const auto sine = [&](int edge) { return std::cos(std::numbers::pi * edge / spec.height); };
        const RowIntegrals integrals(sine(y), sine(y + 1));
        for (std::size_t x = 0; x < width; ++x) {
            const auto angle = [&](std::size_t edge) {
                return std::numbers::pi * (1 - 2 * static_cast<double>(edge) / static_cast<double>(width));
            };
            const Row weights = integrals.pixel(angle(x + 1), angle(x));
            for (std::size_t c = 0; c < 3; ++c) {
                const double radiance = double{row[x * channels + static_cast<std::size_t>(places[c])]};
                if (!(radiance >= 0 && radiance <= 3e38))
                    throw Error(
                        fmt::format("{}: pixel ({}, {}) is {}; light is 0 or a positive number", name, x, y, radiance));
                for (std::size_t k = 0; k < 9; ++k) sky[k][c] += radiance * weights[k] * factor(k);
            }
        }
    }
    return sky;
}

}  // namespace wrinkle
