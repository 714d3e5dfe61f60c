// Bins of decals: no decal is ever missing from the list of a tile that it touches, and few are there for nothing.
#include "run/decal_bins.h"

#include <random>
#include <set>

#include "run/pass_impl.h"
#include "run/scatter.h"
#include "tests/reference/projector.h"
#include "tests/run/run_frame.h"

namespace wrinkle::test {
namespace {

using reference::CameraRays;
using reference::orthographic_camera;
using reference::plane_frame;
using reference::test_camera;
using reference::tilted_camera;

Scene scene_of(std::vector<Projector> rows) {
    DecalsLayer layer;
    layer.textures = {{.file = data_folder / "textures/seal_height.png"}};
    layer.rows = std::make_shared<const std::vector<Projector>>(std::move(rows));
    Scene scene;
    scene.layers.resize(1);
    scene.layers[0].name = "many";
    scene.layers[0].bump = std::move(layer);
    return scene;
}

struct Random {
    std::mt19937 engine;
    explicit Random(unsigned seed) : engine(seed) {}
    double in(double low, double high) { return low + (high - low) * (engine() / 4294967296.0); }
    Vec3 box(double size) { return {in(-size, size), in(-size, size), in(-size, size)}; }
};

Projector random_decal(Random& random, const Vec3& center, double half) {
    Projector p;
    p.shape = static_cast<ProjectorShape>(random.engine() % 3);
    p.center = center;
    p.axis_x = random.box(1);
    p.axis_y = random.box(1);
    p.half_size = {half * random.in(0.2, 1), half * random.in(0.2, 1), half * random.in(0.2, 1)};
    p.two_sided = true;
    p.angle_fade = {-1, -0.5};
    return p;
}

/// World positions of a frame's pixels as the reference decodes them.
std::vector<std::optional<V>> positions(const HostFrame& frame) {
    const reference::Frame<double> decoder({}, frame.frame.size, frame.frame.camera, frame.planes());
    std::vector<std::optional<V>> out(frame.count());
    for (std::size_t i = 0; i < frame.count(); ++i)
        if (const auto d = decoder.decode(i); d.valid) out[i] = d.position + decoder.rays().eye();
    return out;
}

struct Found {
    BinReport bins;
    std::uint64_t touching = 0;  ///< pairs of a tile and a decal that covers a pixel of it
    std::uint64_t lost = 0;      ///< of these, not listed
};

/// Runs the scene and asks every decal of every pixel.
Found brute_force(const HostFrame& frame, const Scene& scene, std::uint32_t limit = 0) {
    Pass pass = evaluate(device(), scene, frame.frame);
    pass.impl().bins.limit_entries(limit);
    run(pass, frame);
    const Size size = frame.frame.size;
    std::vector<std::vector<std::uint32_t>> lists;
    Found found{.bins = pass.impl().bins.read(size.width, size.height, &lists)};
    const std::vector<Projector>& rows = *std::get<DecalsLayer>(scene.layers[0].bump).rows;
    const std::vector<std::uint32_t>& order = pass.impl().plan.tables.at(0).order;
    std::vector<std::set<std::uint32_t>> listed;
    for (const auto& list : lists) {
        EXPECT_TRUE(std::ranges::is_sorted(list)) << "a list keeps the order of the table";
        listed.emplace_back(list.begin(), list.end());
        EXPECT_EQ(listed.back().size(), list.size()) << "a decal is listed once";
    }
    const std::vector<std::optional<V>> points = positions(frame);
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

/// Decals around the points that pixels show.
std::vector<Projector> on_surfaces(const HostFrame& frame, std::size_t count, double low, double high, unsigned seed) {
    Random random(seed);
    const auto points = positions(frame);
    std::vector<Projector> rows;
    while (rows.size() < count) {
        const auto& p = points[random.engine() % points.size()];
        if (!p) continue;
        const double half = low * std::pow(high / low, random.in(0, 1));
        const Vec3 off = random.box(half);
        rows.push_back(random_decal(random, {p->x + off[0], p->y + off[1], p->z + off[2]}, half));
    }
    return rows;
}

TEST(DecalBins, LoseNothingOnSurfaces) {
    const HostFrame frame = small_frame();
    for (unsigned seed = 1; seed <= 3; ++seed)
        expect_none_lost(fmt::format("on surfaces, seed {}", seed), frame,
                         scene_of(on_surfaces(frame, 500, 0.003, 2, seed)));
}

TEST(DecalBins, LoseNothingUnderOtherCameras) {
    for (const Size size : {Size{37, 23}, Size{300, 131}, Size{5, 40}}) {
        HostFrame parallel(plane_frame(orthographic_camera(), size, normalize(V{0.1, -0.2, 1})), orthographic_camera());
        expect_none_lost("parallel", parallel, scene_of(on_surfaces(parallel, 200, 0.01, 3, 7)));
        HostFrame tilted(plane_frame(tilted_camera(), size, normalize(V{0.1, -0.2, 1})), tilted_camera());
        tilted.remove("depth");
        expect_none_lost("positions of a tilted camera", tilted, scene_of(on_surfaces(tilted, 200, 0.01, 3, 8)));
    }
}

TEST(DecalBins, LoseNothingInHardPlaces) {
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
    expect_none_lost("the camera inside", frame, scene_of(around(eye, 0.5, 8, 100)));
    expect_none_lost("behind the eye", frame, scene_of(around(eye - forward * 5.0, 1, 1, 100)));
    expect_none_lost("straddling the eye", frame, scene_of(around(eye - forward * 2.0, 1, 12, 100)));
    expect_none_lost("huge", frame, scene_of(around(point, 1e3, 1e6, 50)));
    expect_none_lost("off screen", frame, scene_of(around(eye + V{100, -300, 50}, 10, 5, 100)));
    expect_none_lost("10,000 in one pixel", frame, scene_of(around(point, 0.002, 0.01, 10000)));

    std::vector<Projector> flat = around(point, 0.5, 1, 60);
    for (std::size_t i = 0; i < flat.size(); ++i) flat[i].half_size[i % 3] = i % 2 == 0 ? 0 : 1e-30;
    flat.push_back(around(point, 0, 0.5, 1).front());
    const Scene scene = scene_of(flat);
    expect_none_lost("without size", frame, scene);
    for (const auto& [name, values] : evaluate_on(frame, scene))
        for (const float value : values) ASSERT_TRUE(std::isfinite(value)) << name;
}

TEST(DecalBins, ShareParentsListsWhenThereIsNoRoom) {
    const HostFrame frame = small_frame();
    const Scene scene = scene_of(on_surfaces(frame, 300, 0.05, 1, 3));
    const Pixels plenty = evaluate_on(frame, scene);
    for (const std::uint32_t limit : {1u, 300u, 800u, 3000u}) {
        expect_none_lost(fmt::format("room for {}", limit), frame, scene, limit);
        Pass pass = evaluate(device(), scene, frame.frame);
        pass.impl().bins.limit_entries(limit);
        EXPECT_EQ(largest_difference(plenty, run(pass, frame)), 0) << limit;
    }
}

TEST(DecalBins, ListFewThatDoNotTouch) {
    const HostFrame frame(plane_frame(test_camera(), {480, 270}, normalize(V{0.1, -0.2, 1})), test_camera());
    ScatterOptions options;
    options.count = 400;
    options.pixels = true;
    options.half_size = {8, 20};
    options.shapes = {ProjectorShape::box, ProjectorShape::sphere, ProjectorShape::cone};
    const Found found = brute_force(frame, scene_of(scatter_decals(options, frame.frame, frame.planes())));
    fmt::print("{} entries for {} that touch: {:.2f}\n", found.bins.entries, found.touching,
               double(found.bins.entries) / double(found.touching));
    EXPECT_EQ(found.lost, 0u);
    EXPECT_LE(double(found.bins.entries), 1.5 * double(found.touching));
}

TEST(Scatter, GivesTheSameRowsForTheSameSeedAndKeepsTheirDistance) {
    const HostFrame frame = small_frame();
    ScatterOptions options;
    options.count = 200;
    options.spacing = 0.2;
    const auto rows = scatter_decals(options, frame.frame, frame.planes());
    const auto again = scatter_decals(options, frame.frame, frame.planes());
    ASSERT_EQ(rows.size(), 200u);
    for (std::size_t i = 0; i < rows.size(); ++i) {
        EXPECT_EQ(rows[i].center, again[i].center);
        EXPECT_EQ(rows[i].axis_x, again[i].axis_x);
        for (std::size_t k = 0; k < i; ++k) {
            const V gap = reference::from_array<double>(rows[i].center) - reference::from_array<double>(rows[k].center);
            EXPECT_GE(length(gap), 0.2 - 1e-6) << i << ", " << k;
        }
    }
    options.seed = 2;
    EXPECT_NE(scatter_decals(options, frame.frame, frame.planes()).front().center, rows.front().center);
}

TEST(DecalTables, OfDecalsThatAddDoNotDependOnTheirOrder) {
    const HostFrame frame = small_frame();
    std::vector<Projector> rows = on_surfaces(frame, 2000, 0.05, 0.5, 21);
    const Scene scene = scene_of(rows);
    std::ranges::shuffle(rows, std::mt19937(4));
    const Scene shuffled = scene_of(rows);
    EXPECT_EQ(largest_difference(evaluate_on(frame, scene), evaluate_on(frame, shuffled)), 0);
    Pass a = accumulate_decals(device(), scene.layers, frame.frame);
    Pass b = accumulate_decals(device(), shuffled.layers, frame.frame);
    EXPECT_EQ(largest_difference(run(a, frame), run(b, frame)), 0);
}

TEST(DecalTables, ReplaceByPriorityWhateverTheirOrder) {
    const HostFrame frame = small_frame();
    std::vector<Projector> rows = on_surfaces(frame, 300, 0.2, 1, 22);
    for (std::size_t i = 0; i < rows.size(); ++i) {
        rows[i].priority = static_cast<double>(i) - 100;
        rows[i].mode = i % 3 == 0 ? ProjectorMode::add : ProjectorMode::replace;
        rows[i].opacity = 0.3 + 0.7 * static_cast<double>(i % 5) / 4;
    }
    const Scene scene = scene_of(rows);
    std::ranges::reverse(rows);
    EXPECT_EQ(largest_difference(evaluate_on(frame, scene), evaluate_on(frame, scene_of(rows))), 0);
    const Pixels got = evaluate_on(frame, scene);
    expect_within("replacing decals", normal_error(got, Truth(frame, scene)), {2e-5, 1e-3, 2e-2}, "degrees");
}

TEST(DecalTables, AgreeWithTheSameDecalsAsLayers) {
    const HostFrame frame = small_frame();
    std::vector<Projector> rows = on_surfaces(frame, 12, 0.3, 1, 23);
    Scene layers;
    for (Projector& row : rows) {
        row.shape = ProjectorShape::box;
        row.two_sided = false;
        row.angle_fade = {0.2, 0.5};
        row.scale = 0.02;
        DecalLayer decal;
        decal.texture = {.file = data_folder / "textures/seal_height.png", .wrap = Wrap::clamp};
        decal.center = row.center, decal.axis_x = row.axis_x, decal.axis_y = row.axis_y;
        decal.half_size = row.half_size;
        decal.angle_fade = {0.2, 0.5};
        Layer& layer = layers.layers.emplace_back();
        layer.name = fmt::format("decal {}", layers.layers.size());
        layer.scale = row.scale;
        layer.bump = decal;
    }
    const Pixels one = evaluate_on(frame, scene_of(rows)), other = evaluate_on(frame, layers);
    EXPECT_LE(largest_difference(one, other), 2e-4);
}

TEST(DecalTables, InDoubleAndInSplitKernels) {
    const HostFrame frame = small_frame();
    const Scene scene = scene_of(on_surfaces(frame, 200, 0.1, 0.8, 25));
    const Truth truth(frame, scene);
    expect_within("float", normal_error(evaluate_on(frame, scene), truth), {3e-6, 3e-3, 3e-2}, "degrees");
    expect_within("split", normal_error(evaluate_on(frame, scene, {.split = true}), truth), {3e-6, 3e-3, 3e-2},
                  "degrees");
    Pass pass = evaluate(device(), scene, frame.frame, {.fp64 = true});
    expect_within("double", normal_error(run<double>(pass, frame), truth), {3e-6, 2e-5, 2e-4}, "degrees");
}

TEST(DecalTables, InBandsAndOnOtherLanes) {
    const HostFrame frame = small_frame();
    const Scene scene = scene_of(on_surfaces(frame, 800, 0.05, 0.5, 24));
    const Pixels whole = evaluate_on(frame, scene);
    for (const int lanes : {1, 4, 8})
        EXPECT_LE(largest_difference(whole, evaluate_on(frame, scene, {.lanes = lanes})), 2e-3) << lanes;
    Pass pass = evaluate(device(), scene, frame.frame);
    const std::size_t width = frame.frame.size.width, bytes = padded(frame.count()) * sizeof(float);
    Pixels banded;
    for (const std::string& name : pass.outputs()) banded[name].resize(frame.count());
    for (const auto& [first, count] : {std::pair{0u, 13u}, {13u, 40u}, {53u, 15u}}) {
        DevicePlanes in, out;
        for (const std::string& name : pass.inputs()) {
            in[name] = cl::Buffer(device().context, CL_MEM_READ_ONLY, bytes);
            device().queue.enqueueWriteBuffer(in[name], CL_TRUE, 0, count * width * sizeof(float),
                                              frame.pixels.at(name).data() + first * width);
        }
        for (const std::string& name : pass.outputs())
            out[name] = cl::Buffer(device().context, CL_MEM_READ_WRITE, bytes);
        pass.enqueue(in, out, {.first = first, .count = count}).wait();
        for (const std::string& name : pass.outputs())
            device().queue.enqueueReadBuffer(out[name], CL_TRUE, 0, count * width * sizeof(float),
                                             banded[name].data() + first * width);
    }
    EXPECT_EQ(largest_difference(whole, banded), 0);
}

}  // namespace
}  // namespace wrinkle::test
