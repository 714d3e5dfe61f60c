// Skies of pictures: their harmonics, against brute force over the picture.
#include <OpenImageIO/imagebuf.h>

#include <cmath>

#include "layers/kinds.h"
#include "resources/light_constants.h"
#include "tests/io/files.h"
#include "tests/reference/vec.h"
#include "tests/scene/scene_folder.h"

namespace wrinkle {
namespace {

using V = reference::Vec<double>;
using Radiance = std::function<double(V)>;

class Sky : public SceneFolder {
protected:
    /// Writes a picture of all directions, from x in the middle over -y on the right, z on top; red, green and blue are
    /// 1, 2 and 4 times `radiance`.
    std::filesystem::path picture(int height, const Radiance& radiance) const {
        const std::filesystem::path file = folder_ / "sky.exr";
        test::write_exr(file, 2 * height, height, {"R", "G", "B"}, [&](int channel, int x, int y) {
            const double up = M_PI * (0.5 - (y + 0.5) / height), turn = M_PI * (1 - (x + 0.5) / height);
            const V d{std::cos(up) * std::cos(turn), std::cos(up) * std::sin(turn), std::sin(up)};
            return static_cast<float>(radiance(d) * (1 << channel));
        });
        return file;
    }
};

/// Irradiance / pi by the numbers that kernels get.
V irradiance(const Light& sky, V n) {
    double k[27]{};
    add_sky(k, sky);
    const double terms[] = {
        1, n.x, n.y, n.z, n.x * n.y, n.y * n.z, n.z * n.x, n.x * n.x - n.y * n.y, 3 * n.z * n.z - 1};
    double sum[3]{};
    for (std::size_t i = 0; i < 9; ++i)
        for (std::size_t c = 0; c < 3; ++c) sum[c] += terms[i] * k[3 * i + c];
    return {sum[0], sum[1], sum[2]};
}

/// The same by adding up radiance times cosine over all directions.
double brute(const Radiance& radiance, V n) {
    double sum = 0;
    constexpr int steps = 300;
    for (int i = 0; i < steps; ++i)
        for (int j = 0; j < 2 * steps; ++j) {
            const double z = 2 * (i + 0.5) / steps - 1, turn = M_PI * (j + 0.5) / steps, out = std::sqrt(1 - z * z);
            const V d{out * std::cos(turn), out * std::sin(turn), z};
            sum += radiance(d) * std::max(dot(n, d), 0.0) * 4 * M_PI / (2 * steps * steps);
        }
    return sum / M_PI;
}

const std::vector<V> directions{{1, 0, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}, {0.6, 0.48, 0.64}, {-0.8, 0.36, -0.48}};

TEST_F(Sky, OfOneColourLightsAllAlike) {
    const Light sky{.kind = LightKind::sky, .intensity = 3, .harmonics = load_sky(picture(4, [](V) { return 0.5; }))};
    for (const V n : directions) EXPECT_LE(length(irradiance(sky, n) - V{1.5, 3, 6}), 1e-6);
}

TEST_F(Sky, LightsAsItsPictureDoes) {
    // Order 2 holds these exactly: polynomials of the direction up to squares, and a day's horizon nearly.
    const Radiance polynomial = [](V d) {
        return 2 + d.x - 0.5 * d.y + 0.3 * d.z + d.x * d.y - 0.7 * d.y * d.z + d.z * d.z;
    };
    const Light sky{.kind = LightKind::sky, .harmonics = load_sky(picture(128, polynomial))};
    const Radiance day = [](V d) {
        return d.z > 0 ? 1 - 0.6 * d.z + std::exp(-8 * length(d - V{0.6, 0.64, 0.48})) : 0.2;
    };
    const Light other{.kind = LightKind::sky, .harmonics = load_sky(picture(128, day))};
    for (const V n : directions) {
        EXPECT_NEAR(irradiance(sky, n).x, brute(polynomial, n), 1e-3);
        EXPECT_NEAR(irradiance(sky, n).z, 4 * irradiance(sky, n).x, 1e-6);
        EXPECT_NEAR(irradiance(other, n).x, brute(day, n), 0.03 * brute(day, n));
    }
}

TEST_F(Sky, IsReadFromTilesAsFromRows) {
    const auto radiance = [](V d) { return 2 + d.x - 0.5 * d.y + 0.3 * d.z; };
    const std::filesystem::path rows = picture(20, radiance), tiles = folder_ / "tiles.exr";
    OIIO::ImageBuf image(rows.string());
    image.set_write_tiles(16, 16);
    ASSERT_TRUE(image.write(tiles.string())) << image.geterror();
    ASSERT_EQ(OIIO::ImageBuf(tiles.string()).spec().tile_width, 16);
    EXPECT_EQ(load_sky(rows), load_sky(tiles));
}

TEST_F(Sky, TurnsAroundItsUp) {
    const SkyHarmonics lamp = load_sky(picture(32, [](V d) { return dot(d, V{0.8, 0, 0.6}) > 0.95 ? 9.0 : 0.0; }));
    const auto brightest = [&](Vec3 up, double degrees) {
        const Light sky{.kind = LightKind::sky, .up = up, .rotation = degrees * M_PI / 180, .harmonics = lamp};
        V best{};
        for (int x = -5; x <= 5; ++x)
            for (int y = -5; y <= 5; ++y)
                for (int z = -5; z <= 5; ++z)
                    if (const V d{x / 5.0, y / 5.0, z / 5.0}; length(d) > 0)
                        if (irradiance(sky, normalize(d)).x > (length(best) > 0 ? irradiance(sky, best).x : 0))
                            best = normalize(d);
        return best;
    };
    EXPECT_GT(dot(brightest({0, 0, 1}, 0), V{0.8, 0, 0.6}), 0.98);
    EXPECT_GT(dot(brightest({0, 0, 1}, 90), V{0, 0.8, 0.6}), 0.98);
    EXPECT_GT(dot(brightest({0, 1, 0}, 0), V{0.8, 0.6, 0}), 0.98);
    EXPECT_GT(dot(brightest({0, 2, 0}, 90), V{0, 0.6, -0.8}), 0.98);
}

TEST_F(Sky, IsReadFromAScene) {
    picture(4, [](V d) { return 1 + d.z; });
    const std::string lit = "[lighting]\nrelight = \"lit\"\n[[light]]\nkind = \"sky\"\n";
    const Scene scene = load_with(lit + "texture = \"sky.exr\"\nrotation = 90\nintensity = 2\n");
    ASSERT_TRUE(scene.lighting.lights[0].harmonics);
    EXPECT_NEAR(scene.lighting.lights[0].rotation, M_PI / 2, 1e-12);
    check(scene);
    expect_problem_with(lit + "texture = \"sky.exr\"\nzenith = [1, 1, 1]\n", 10,
                        {"\"zenith\"", "no effect beside texture"});
    expect_problem_with(lit + "zenith = [1, 1, 1]\nrotation = 5\n", 10, {"\"rotation\"", "no effect without texture"});
    expect_problem_with(lit, 7, {"needs the key \"zenith\""});
    const auto expect_refused = [&](const char* why) {
        const auto found = problems(frame_ + lit + "texture = \"sky.exr\"\n");
        ASSERT_EQ(found.size(), 2u) << why;
        EXPECT_NE(found[1].find(why), std::string::npos) << found[1];
    };
    picture(4, [](V d) { return d.z; });
    expect_refused("light is 0 or a positive number");
    test::write_exr(folder_ / "sky.exr", 4, 4, {"R", "G", "B"}, [](int, int, int) { return 1.0f; });
    expect_refused("twice as wide as high");
    test::write_exr(folder_ / "sky.exr", 4, 2, {"Y"}, [](int, int, int) { return 1.0f; });
    expect_refused("no channels R, G and B");
}

}  // namespace
}  // namespace wrinkle
