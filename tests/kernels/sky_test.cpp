// shade/sky.clh and the pictures that it reads, against brute force over all directions.
#include "tests/reference/sky.h"

#include <cmath>

#include "resources/ggx_lobes.h"
#include "resources/sky_levels.h"
#include "tests/cases/lighting.h"
#include "tests/io/files.h"
#include "tests/kernels/check.h"

namespace wrinkle::test {
namespace {

using D = reference::Vec<double>;
using Radiance = std::function<D(D)>;

D narrow(V a) { return normalize(D{double(a.x), double(a.y), double(a.z)}); }

/// A day with clouds and a bright haze around the sun, over darker ground.
D day(D d) {
    const double haze = 6 * std::exp(30 * (dot(d, D{0.48, -0.6, 0.64}) - 1)),
                 clouds = 0.15 * std::sin(9 * d.x) * std::cos(7 * d.y);
    if (d.z < 0) return D{0.2, 0.15, 0.1};
    return D{0.3, 0.5, 1} * (1 - 0.6 * d.z + clouds) + D{1, 0.9, 0.7} * haze;
}

/// One of two colours.
Light two_colours() {
    Light sky{.kind = LightKind::sky};
    sky.zenith = {0.2, 0.35, 0.7}, sky.horizon = {0.6, 0.6, 0.55}, sky.ground = {0.2, 0.15, 0.1};
    return sky;
}

/// What kernels get of a sky: the table of lobes, its picture, and colours in axes of the world.
ColumnData data_of(const std::filesystem::path& file, const std::array<D, 3>& colours) {
    TextureHeap heap;
    add_lobes(heap), add_sky_levels(heap, file);
    heap.texels.resize(heap.texels.size() + kTexelsAfterTheLast);
    ColumnData data;
    data.texels = heap.texels, data.textures = heap.table;
    data.constants = {1, 0, 0, 0, 1, 0, 0, 0, 1};
    for (const D& c : colours) data.constants.insert(data.constants.end(), {c.x, c.y, c.z});
    return data;
}

ColumnData data_of_day() {
    constexpr int height = 128;
    const TempFolder folder;
    write_exr(folder / "sky.exr", 2 * height, height, {"R", "G", "B"}, [](int channel, int x, int y) {
        const double up = M_PI * (0.5 - (y + 0.5) / height), turn = M_PI * (1 - (x + 0.5) / height);
        const D seen = day({std::cos(up) * std::cos(turn), std::cos(up) * std::sin(turn), std::sin(up)});
        return static_cast<float>(channel == 0 ? seen.x : channel == 1 ? seen.y : seen.z);
    });
    return data_of(folder / "sky.exr", {D{1, 0, 0}, D{0, 1, 0}, D{0, 0, 1}});
}

ColumnData data_of_colours() {
    const Light sky = two_colours();
    const auto colour = [](const Vec3& c) { return D{c[0], c[1], c[2]}; };
    return data_of({}, {colour(sky.zenith), colour(sky.horizon), colour(sky.ground)});
}

const std::string mirror_it =
    "wr_lit_surface seen = wr_lit_surface_of(unit(n), unit(m), unit(v), wr_zero3(), roughness);\n"
    "wr_sky_lobe lobe = wr_sky_lobe_of(wr_texture_at(texels, textures, 0), seen, unit(v), 0.0625f);\n"
    "wr_vec3 sky = wr_scale(wr_sky_seen(wr_texture_at(texels, textures, 1), constants, lobe), lobe.strength);";

/// Shares by which what surfaces mirror is off; sorted.
struct Way {
    double roughness = 0.5, cosine = 0.6, bump = 0;  ///< cosine between the normal and the view
    int lanes = 16;
    bool fp64 = false;
};
std::vector<double> errors(const ColumnData& data, const Radiance& radiance, const Way& way) {
    const auto& [roughness, cosine, bump, lanes, fp64] = way;
    cases::Cases c{.name = "mirrored sky"};
    c.data = data;
    std::vector<D> wanted;
    for (unsigned seed = 1; wanted.size() < 24; ++seed) {
        cases::Random random(seed);
        const V m = random.unit(), n = bump > 0 ? cases::Random::rounded(normalize(m + random.unit() * real(bump))) : m;
        const V aside = normalize(cross(n, random.unit()));
        const V v = cases::Random::rounded(normalize(n * real(cosine) + aside * std::sqrt(1 - real(cosine * cosine))));
        if (dot(m, v) < 0.02L) continue;
        c.add("seed " + std::to_string(seed), true);
        c.in("n", n), c.in("m", m), c.in("v", v), c.in("roughness", real(roughness));
        wanted.push_back(reference::mirrored_sky<double>(radiance, narrow(n), narrow(m), narrow(v),
                                                         {{}, roughness, 0.0625}, roughness < 0.25 ? 400 : 120));
    }
    const Results got = run_kernel({mirror_it, xyz("sky")}, c.inputs, {lanes, fp64}, c.data);
    std::vector<double> off;
    for (std::size_t i = 0; i < wanted.size(); ++i)
        off.push_back(length(D{double(got[0][i]), double(got[1][i]), double(got[2][i])} - wanted[i]) /
                      length(wanted[i]));
    std::ranges::sort(off);
    return off;
}

double share(const std::vector<double>& sorted, double part) {
    return sorted.at(static_cast<std::size_t>(part * static_cast<double>(sorted.size() - 1)));
}

struct Bounds {
    double median, most;
};

void expect_within(const std::string& what, const std::vector<double>& off, Bounds bounds) {
    fmt::print("{}: off by {:.4f} in the median, {:.4f} at 90%, {:.4f} at most\n", what, share(off, 0.5),
               share(off, 0.9), off.back());
    EXPECT_LE(share(off, 0.5), bounds.median) << what;
    EXPECT_LE(off.back(), bounds.most) << what;
}

TEST(MirroredSky, IsTheSumOverAllDirections) {
    const ColumnData picture = data_of_day(), colours = data_of_colours();
    const Light sky = two_colours();
    const Radiance of_colours = [&](D d) { return reference::sky_radiance(sky, d); };
    for (const double roughness : {0.3, 0.6, 1.0})
        for (const double cosine : {0.95, 0.5, 0.1}) {
            const std::string at = fmt::format("roughness {}, cosine {}", roughness, cosine);
            const double flat = cosine > 0.9 ? 1 : 3;
            expect_within("day, " + at, errors(picture, day, {roughness, cosine}), {0.035 * flat, 0.2 * flat});
            expect_within("two colours, " + at, errors(colours, of_colours, {roughness, cosine}),
                          {0.02 * flat, 0.11 * flat});
        }
    expect_within("day, smooth", errors(picture, day, {0.15, 0.6}), {0.02, 0.1});
    for (const auto& [lanes, fp64] : {std::pair{1, false}, std::pair{8, false}, std::pair{4, true}})
        if (!fp64 || test_device().info.fp64)
            expect_within("day, on other lanes", errors(picture, day, {.lanes = lanes, .fp64 = fp64}), {0.06, 0.3});
    expect_within("day, bumped", errors(picture, day, {.bump = 0.4}), {0.1, 0.6});
}

}  // namespace
}  // namespace wrinkle::test
