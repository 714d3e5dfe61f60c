// Tables of lights: no light is lost, whatever it is that bins them, against the sum of all lights in double.
#include "run/pass_impl.h"
#include "tests/run/light_frames.h"

namespace wrinkle::test {
namespace {

constexpr Bounds kBounds{2e-6, 1e-4, 2e-2};  // the largest where light grazes the surface

void expect_all(const std::string& what, const HostFrame& frame, const Scene& scene) {
    expect_within(what, lit_error(evaluate_on(frame, scene), Truth(frame, scene)), kBounds, "relative");
}

TEST(LightTable, LosesNoLight) {
    const HostFrame frame = small_frame();
    for (unsigned seed = 1; seed <= 2; ++seed) {
        const Scene scene = lit_scene(lights_around(positions(frame), 200, 0.05, 4, seed));
        expect_all(fmt::format("ranges of all sizes, seed {}", seed), frame, scene);
    }
    expect_all("some without a range", frame, lit_scene(lights_around(positions(frame), 60, 0.2, 1, 4, false)));
    expect_all("all in one place", frame,
               lit_scene(std::vector<Light>(200, lights_around(positions(frame), 1, 3, 3, 5)[0])));
}

TEST(LightTable, LosesNoLightUnderOtherCameras) {
    const HostFrame parallel(plane_frame(orthographic_camera(), {100, 37}, normalize(V{0.1, -0.2, 1})),
                             orthographic_camera());
    expect_all("parallel", parallel, lit_scene(lights_around(positions(parallel), 200, 0.02, 3, 6)));
    HostFrame tilted(plane_frame(tilted_camera(), {37, 23}, normalize(V{0.1, -0.2, 1})), tilted_camera());
    tilted.remove("depth");
    expect_all("positions", tilted, lit_scene(lights_around(positions(tilted), 200, 0.02, 3, 7)));
}

TEST(LightTable, LosesNoLightWhereParallaxesMovePoints) {
    const HostFrame frame = small_frame();
    const auto [name, layers] = parallax_stacks().back();
    Scene scene = lit_scene(lights_around(positions(frame, layers), 200, 0.05, 0.3, 8));
    scene.layers = layers;
    scene = with_own_names(std::move(scene));
    expect_within(name, lit_error(evaluate_on(frame, scene), Truth(frame, scene)), {1e-5, 1e-3, 5e-2}, "relative");
}

TEST(LightTable, ListsEveryLightThatReachesATile) {
    const HostFrame frame = small_frame();
    const std::vector<std::optional<V>> points = positions(frame);
    const Scene scene = lit_scene(lights_around(points, 1000, 0.02, 1, 9));
    Pass pass = evaluate(device(), scene, frame.frame);
    run(pass, frame);
    std::vector<std::vector<std::uint32_t>> lists;
    const Size size = frame.frame.size;
    const BinReport report = pass.impl().light_bins.read(size.width, size.height, &lists);
    std::size_t reached = 0, lost = 0;
    const std::vector<std::uint32_t>& order = *pass.impl().plan.light_order;
    const std::uint32_t across = (size.width + 15) / 16;
    for (std::uint32_t k = 0; k < order.size(); ++k) {
        const Light& light = scene.lighting.table->at(order[k]);
        std::vector<bool> reaches(lists.size());
        for (std::size_t i = 0; i < points.size(); ++i)
            if (points[i] && length(*points[i] - reference::from_array<double>(light.position)) < *light.range)
                reaches[i / size.width / 8 * across + i % size.width / 16] = true;
        for (std::size_t tile = 0; tile < lists.size(); ++tile)
            if (reaches[tile]) ++reached, lost += std::ranges::count(lists[tile], k) == 1 ? 0 : 1;
    }
    fmt::print("{} entries for {} pairs of a light and a tile that it reaches\n", report.entries, reached);
    EXPECT_GT(reached, 1000u);
    EXPECT_EQ(lost, 0u);
    EXPECT_LT(report.entries, 2 * reached);
}

TEST(LightTable, SharesListsWhenThereIsNoRoom) {
    const HostFrame frame = small_frame();
    const Scene scene = lit_scene(lights_around(positions(frame), 300, 0.05, 1, 10));
    const Pixels plenty = evaluate_on(frame, scene);
    for (const std::uint32_t limit : {1u, 300u, 3000u}) {
        Pass pass = evaluate(device(), scene, frame.frame);
        pass.impl().light_bins.limit_entries(limit);
        EXPECT_EQ(largest_difference(plenty, run(pass, frame)), 0) << limit;
    }
}

TEST(LightTable, DoesNotDependOnItsOrderAndTakesOtherRows) {
    const HostFrame frame = small_frame();
    std::vector<Light> rows = lights_around(positions(frame), 300, 0.05, 1, 11);
    const Scene scene = lit_scene(rows);
    std::ranges::shuffle(rows, std::mt19937(4));
    EXPECT_EQ(largest_difference(evaluate_on(frame, scene), evaluate_on(frame, lit_scene(rows))), 0);
    const Scene fewer = lit_scene(lights_around(positions(frame), 40, 0.5, 2, 12));
    Pass pass = evaluate(device(), scene, frame.frame);
    pass.set_parameters(fewer);
    EXPECT_EQ(largest_difference(run(pass, frame), evaluate_on(frame, fewer)), 0);
    Scene none = scene;
    none.lighting.table = nullptr;
    none.lighting.ambient = {1, 1, 1};
    EXPECT_THROW(pass.set_parameters(none), Error) << "whether there is a table is compiled in";
}

TEST(LightTable, RelightsAsTheSameLightsDoByThemselves) {
    HostFrame frame = small_frame();
    for (const char* color : {"r", "g", "b"}) frame.add(std::string("beauty.") + color, 0.5f);
    Scene table = lit_scene(lights_around(positions(frame), 20, 0.5, 3, 13, false));
    table.lighting.relight = Relight::ratio;
    table.lighting.ambient = {0.1, 0.1, 0.2};
    table.lighting.shadows = Shadows::read;
    table.filter.taps = 16;
    Scene alone = table;
    alone.lighting.lights = *table.lighting.table;
    alone.lighting.table = nullptr;
    EXPECT_LT(largest_difference(evaluate_area(frame, table), evaluate_area(frame, alone)), 2e-5);
}

TEST(LightTable, SharesTheTilesOfTablesOfDecals) {
    const HostFrame frame = small_frame();
    Scene scene = table_scene(on_surfaces(frame, 200, 0.05, 1, 14));
    scene.lighting = lit_scene(lights_around(positions(frame), 200, 0.05, 1, 15)).lighting;
    expect_within("decals and lights", lit_error(evaluate_on(frame, scene), Truth(frame, scene)), {1e-5, 1e-3, 5e-2},
                  "relative");
}

}  // namespace
}  // namespace wrinkle::test
