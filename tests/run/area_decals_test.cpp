// Tables of decals over the areas of pixels: no tile may lose one.
#include "tests/run/area_frames.h"
#include "tests/run/decal_frames.h"

namespace wrinkle::test {
namespace {

/// What every row of the scene's layer `table` adds, each evaluated alone: a table of one row has nothing to bin apart.
std::vector<V> sum_of_rows(const HostFrame& frame, const Scene& scene, std::size_t table,
                           const std::vector<Projector>& rows) {
    Scene alone = scene;
    std::vector<V> sum(frame.count());
    for (const Projector& row : rows) {
        std::get<DecalsLayer>(alone.layers[table].bump).rows = std::make_shared<const std::vector<Projector>>(1, row);
        const Pixels one = evaluate_area(frame, alone);
        for (std::size_t i = 0; i < sum.size(); ++i) sum[i] = sum[i] + vec_at(one, "surface_gradient", i);
    }
    return sum;
}

void expect_sum(const Pixels& all, const std::vector<V>& sum) {
    for (std::size_t i = 0; i < sum.size(); ++i)
        EXPECT_LE(length(vec_at(all, "surface_gradient", i) - sum[i]), 1e-4 * (1 + length(sum[i]))) << "pixel " << i;
}

/// The rows as a table, evaluated over the areas of pixels.
Scene table_over_areas(const std::vector<Projector>& rows) {
    Scene scene = table_scene(rows);
    scene.filter.taps = 16;
    scene.output = {.surface_gradient = true};
    return scene;
}

TEST(AreaDecals, NoDecalOfATableIsLost) {
    const HostFrame frame = ground({96, 64});
    const std::vector<Projector> rows = on_surfaces(frame, 60, 0.05, 1, 3);
    const Scene scene = table_over_areas(rows);
    expect_sum(evaluate_area(frame, scene), sum_of_rows(frame, scene, 0, rows));
}

TEST(AreaDecals, NoDecalIsLostWhereAnotherTablePrecedesAParallax) {
    const HostFrame frame = ground({96, 64});
    const std::vector<Projector> rows = on_surfaces(frame, 25, 0.05, 0.6, 4);
    Scene scene = table_over_areas(rows);
    Layer before = scene.layers[0], moves = layer_of(ParallaxLayer{{.file = cobbles}, planar}, 0.8);
    Projector far = rows.front();
    far.center = {0, 0, 50};
    before.name = "before", moves.name = "parallax";
    std::get<DecalsLayer>(before.bump).rows = std::make_shared<const std::vector<Projector>>(1, far);
    scene.layers = {before, moves, scene.layers[0]};
    expect_sum(evaluate_area(frame, scene), sum_of_rows(frame, scene, 2, rows));
}

}  // namespace
}  // namespace wrinkle::test
