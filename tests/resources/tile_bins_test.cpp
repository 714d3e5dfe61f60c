// Bins of decals: no decal is missing from the list of a tile that it touches, and few are listed where they do not
// touch.
#include "resources/tile_bins.h"

#include <set>

#include "run/pass_impl.h"
#include "tests/run/decal_frames.h"
#include "tools/scatter.h"

namespace wrinkle::test {
namespace {

struct Found {
    BinReport bins;
    std::uint64_t touching = 0;  ///< pairs of a tile and a decal that covers one of its pixels
    std::uint64_t lost = 0;      ///< those of them that are missing from the tile's list
};

/// Runs a scene whose last layer is a table, and compares the lists with a test of every decal at every pixel.
Found brute_force(const HostFrame& frame, const Scene& scene, std::uint32_t limit = 0) {
    Pass pass = evaluate(device(), scene, frame.frame);
    pass.impl().bins.limit_entries(limit);
    run(pass, frame);
    const Size size = frame.frame.size;
    std::vector<std::vector<std::uint32_t>> lists;
    Found found{.bins = pass.impl().bins.read(size.width, size.height, &lists)};
    const std::vector<Projector>& rows = *std::get<DecalsLayer>(scene.layers.back().bump).rows;
    const std::vector<std::uint32_t>& order = pass.impl().plan.tables.at(0).order;
    std::vector<std::set<std::uint32_t>> listed;
    for (const auto& list : lists) {
        EXPECT_TRUE(std::ranges::is_sorted(list)) << "a list keeps the order of the table";
        listed.emplace_back(list.begin(), list.end());
        EXPECT_EQ(listed.back().size(), list.size()) << "a decal is listed once";
    }
    const std::vector<std::optional<V>> points = positions(frame, scene.layers);
    const std::uint32_t across = (size.width + 15) / 16;
    for (std::uint32_t k = 0; k < order.size(); ++k) {
        const Projector& row = rows[order[k]];
        if (!(std::min({row.half_size[0], row.half_size[1], row.half_size[2]}) > 1e-30)) continue;
        using reference::from_array;
        const auto box = reference::decal_box(from_array<double>(row.center), from_array<double>(row.axis_x),
                                              from_array<double>(row.axis_y), from_array<double>(row.half_size));
        Projector hard = row;
        hard.falloff = {0, 0, 0};
        std::set<std::uint32_t> tiles;
        for (std::size_t i = 0; i < points.size(); ++i)
            if (points[i] && reference::project(hard, box, *points[i]).weight > 0)
                tiles.insert(static_cast<std::uint32_t>(i / size.width / 8 * across + i % size.width / 16));
        found.touching += tiles.size();
        for (const std::uint32_t tile : tiles) found.lost += listed.at(tile).contains(k) ? 0 : 1;
    }
    return found;
}

void expect_none_lost(const std::string& what, const HostFrame& frame, const Scene& scene, std::uint32_t limit = 0) {
    const Found found = brute_force(frame, scene, limit);
    fmt::print("{:<34} {} entries for {} that touch; {} of {} tiles, longest {}, {} inherited\n", what,
               found.bins.entries, found.touching, found.bins.touched, found.bins.tiles, found.bins.longest,
               found.bins.inherited);
    EXPECT_EQ(found.lost, 0u) << what;
}

TEST(TileBins, LoseNothingOnSurfaces) {
    const HostFrame frame = small_frame();
    for (unsigned seed = 1; seed <= 3; ++seed)
        expect_none_lost(fmt::format("on surfaces, seed {}", seed), frame,
                         table_scene(on_surfaces(frame, 500, 0.003, 2, seed)));
}

TEST(TileBins, LoseNothingUnderOtherCameras) {
    for (const Size size : {Size{37, 23}, Size{300, 131}, Size{5, 40}}) {
        HostFrame parallel(plane_frame(orthographic_camera(), size, normalize(V{0.1, -0.2, 1})), orthographic_camera());
        expect_none_lost("parallel", parallel, table_scene(on_surfaces(parallel, 200, 0.01, 3, 7)));
        HostFrame tilted(plane_frame(tilted_camera(), size, normalize(V{0.1, -0.2, 1})), tilted_camera());
        tilted.remove("depth");
        expect_none_lost("positions of a tilted camera", tilted, table_scene(on_surfaces(tilted, 200, 0.01, 3, 8)));
    }
}

TEST(TileBins, LoseNothingInHardPlaces) {
    const HostFrame frame = small_frame();
    const reference::Frame<double> decoder({}, frame.frame.size, frame.frame.camera, frame.planes());
    const V eye = decoder.rays().eye();
    const V point = *positions(frame)[60 * 120 + 60], forward = normalize(point - eye);
    Random random(5);
    const auto around = [&](V middle, double spread, double half, std::size_t count) {
        std::vector<Projector> rows;
        for (std::size_t i = 0; i < count; ++i) {
            const Vec3 off = random.box(spread);
            rows.push_back(random_decal(random, {middle.x + off[0], middle.y + off[1], middle.z + off[2]}, half));
        }
        return rows;
    };
    expect_none_lost("the camera inside", frame, table_scene(around(eye, 0.5, 8, 100)));
    expect_none_lost("behind the eye", frame, table_scene(around(eye - forward * 5.0, 1, 1, 100)));
    expect_none_lost("straddling the eye", frame, table_scene(around(eye - forward * 2.0, 1, 12, 100)));
    expect_none_lost("huge", frame, table_scene(around(point, 1e3, 1e6, 50)));
    expect_none_lost("off screen", frame, table_scene(around(eye + V{100, -300, 50}, 10, 5, 100)));
    expect_none_lost("10,000 in one pixel", frame, table_scene(around(point, 0.002, 0.01, 10000)));

    std::vector<Projector> flat = around(point, 0.5, 1, 60);
    for (std::size_t i = 0; i < flat.size(); ++i) flat[i].half_size[i % 3] = i % 2 == 0 ? 0 : 1e-30;
    flat.push_back(around(point, 0, 0.5, 1).front());
    const Scene scene = table_scene(flat);
    expect_none_lost("without size", frame, scene);
    for (const auto& [name, values] : evaluate_on(frame, scene))
        for (const float value : values) ASSERT_TRUE(std::isfinite(value)) << name;
}

TEST(TileBins, LoseNothingThatParallaxesMoveThere) {
    const HostFrame frame = small_frame();
    const HostFrame parallel(plane_frame(orthographic_camera(), {300, 131}, normalize(V{0.1, -0.2, 1})),
                             orthographic_camera());
    for (unsigned seed = 1; seed <= 3; ++seed)
        for (const auto& [name, layers] : parallax_stacks()) {
            for (const HostFrame* each : {&frame, &parallel}) {
                Scene scene = table_scene({});
                scene.layers.insert(scene.layers.begin(), layers.begin(), layers.end());
                // Decals around the points that pixels are moved to, as those could be missing from lists.
                std::get<DecalsLayer>(scene.layers.back().bump).rows = std::make_shared<const std::vector<Projector>>(
                    decals_around(positions(*each, layers), 300, 0.003, 0.3, seed));
                expect_none_lost(fmt::format("{}, seed {}", name, seed), *each, scene);
            }
        }
}

TEST(TileBins, ShareParentsListsWhenThereIsNoRoom) {
    const HostFrame frame = small_frame();
    const Scene scene = table_scene(on_surfaces(frame, 300, 0.05, 1, 3));
    const Pixels plenty = evaluate_on(frame, scene);
    for (const std::uint32_t limit : {1u, 300u, 800u, 3000u}) {
        expect_none_lost(fmt::format("room for {}", limit), frame, scene, limit);
        Pass pass = evaluate(device(), scene, frame.frame);
        pass.impl().bins.limit_entries(limit);
        EXPECT_EQ(largest_difference(plenty, run(pass, frame)), 0) << limit;
    }
}

TEST(TileBins, ListFewThatDoNotTouch) {
    const HostFrame frame(plane_frame(test_camera(), {480, 270}, normalize(V{0.1, -0.2, 1})), test_camera());
    ScatterOptions options;
    options.count = 400;
    options.pixels = true;
    options.half_size = {8, 20};
    options.shapes = {ProjectorShape::box, ProjectorShape::sphere, ProjectorShape::cone};
    const Found found = brute_force(frame, table_scene(scatter_decals(options, frame.frame, frame.planes())));
    fmt::print("{} entries for {} that touch: {:.2f}\n", found.bins.entries, found.touching,
               double(found.bins.entries) / double(found.touching));
    EXPECT_EQ(found.lost, 0u);
    EXPECT_LE(double(found.bins.entries), 1.5 * double(found.touching));
}

}  // namespace
}  // namespace wrinkle::test
