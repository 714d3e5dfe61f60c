// Tables of decals are compared with the double-precision evaluator, and with the same decals in another order or
// written in another way.
#include "tests/run/decal_frames.h"

namespace wrinkle::test {
namespace {

std::size_t bumped_pixels(const Truth& truth) {
    return static_cast<std::size_t>(std::ranges::count_if(truth.pixels, [](const auto& pixel) {
        return pixel.valid && angle_degrees(pixel.normal, pixel.base_normal) > 0.5;
    }));
}

TEST(DecalTables, OfDecalsThatAddDoNotDependOnTheirOrder) {
    const HostFrame frame = small_frame();
    std::vector<Projector> rows = on_surfaces(frame, 2000, 0.05, 0.5, 21);
    const Scene scene = table_scene(rows);
    std::ranges::shuffle(rows, std::mt19937(4));
    const Scene shuffled = table_scene(rows);
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
    const Scene scene = table_scene(rows);
    std::ranges::reverse(rows);
    EXPECT_EQ(largest_difference(evaluate_on(frame, scene), evaluate_on(frame, table_scene(rows))), 0);
    const Pixels got = evaluate_on(frame, scene);
    expect_within("replacing decals", normal_error(got, Truth(frame, scene)), {2e-5, 7e-3, 6e-2}, "degrees");
}

/// The same boxes, as layers and as rows of a table.
std::pair<Scene, Scene> as_layers_and_rows(const std::vector<Projector>& rows) {
    Scene layers;
    for (const Projector& row : rows) {
        DecalLayer decal;
        decal.texture = {.file = data_folder / "textures/seal_height.png", .wrap = Wrap::clamp};
        decal.center = row.center, decal.axis_x = row.axis_x, decal.axis_y = row.axis_y;
        decal.half_size = row.half_size, decal.falloff = row.falloff[0];
        decal.angle_fade = row.angle_fade, decal.two_sided = row.two_sided;
        Layer& layer = layers.layers.emplace_back();
        layer.name = fmt::format("decal {}", layers.layers.size());
        layer.scale = row.scale;
        layer.bump = decal;
    }
    return {layers, table_scene(rows)};
}

/// From in front and from behind, one-sided and two-sided: the first pixel whose normals differ would tell them apart.
TEST(DecalTables, AgreeWithTheSameDecalsAsLayersFromBothSides) {
    const HostFrame frame = small_frame();
    for (const bool two_sided : {false, true})
        for (const bool behind : {false, true}) {
            std::vector<Projector> rows(1);
            rows[0].center = {0, 0, 0}, rows[0].half_size = {3, 3, 3}, rows[0].scale = 0.1;
            rows[0].angle_fade = {0.1, 0.4}, rows[0].two_sided = two_sided;
            if (behind) rows[0].axis_y = {0, -1, 0};  // axis_z points down: the ground faces away
            const auto [layers, table] = as_layers_and_rows(rows);
            const Pixels a = evaluate_on(frame, layers), b = evaluate_on(frame, table);
            EXPECT_LT(largest_difference(a, b), 3e-7) << two_sided << behind;
            const std::size_t bumped = bumped_pixels(Truth(frame, table));
            EXPECT_GT(bumped, 50u) << two_sided << behind;
            expect_within("a decal from a side", normal_error(a, Truth(frame, layers)), {1e-5, 1e-3, 1e-2}, "degrees");
        }
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
    const Pixels one = evaluate_on(frame, table_scene(rows)), other = evaluate_on(frame, layers);
    EXPECT_LE(largest_difference(one, other), 2e-4);
}

TEST(DecalTables, InDoubleAndInSplitKernels) {
    const HostFrame frame = small_frame();
    const Scene scene = table_scene(on_surfaces(frame, 200, 0.1, 0.8, 25));
    const Truth truth(frame, scene);
    expect_within("float", normal_error(evaluate_on(frame, scene), truth), {3e-6, 4e-3, 9e-2}, "degrees");
    expect_within("split", normal_error(evaluate_on(frame, scene, {.split = true}), truth), {3e-6, 4e-3, 9e-2},
                  "degrees");
    Pass pass = evaluate(device(), scene, frame.frame, {.fp64 = true});
    expect_within("double", normal_error(run<double>(pass, frame), truth), {3e-6, 2e-5, 2e-4}, "degrees");
}

/// At the borders of a frame blocks of pixels overlap, and into the smallest frames they do not fit.
TEST(DecalTables, OnFramesOfAnySize) {
    const HostFrame whole = small_frame();
    for (const Size size : {Size{1, 9}, {3, 3}, {9, 1}, {4, 2}, {4, 4}, {5, 7}, {33, 18}}) {
        HostFrame frame = whole;
        frame.frame.size = size;
        for (auto& [name, plane] : frame.pixels) {
            std::vector<float> part;
            for (std::uint32_t y = 0; y < size.height; ++y) {
                const auto row = plane.begin() + static_cast<std::ptrdiff_t>((y + 40) * whole.frame.size.width + 60);
                part.insert(part.end(), row, row + size.width);
            }
            plane = std::move(part);
        }
        Scene scene = table_scene(on_surfaces(frame, 60, 0.1, 0.8, 26));
        scene.layers[0].footprint = false;  // pixels of a tiny frame are so large that mips would leave nothing
        const Truth truth(frame, scene);
        EXPECT_GT(bumped_pixels(truth), 0u);
        for (const int lanes : {1, 4, 8, 16})
            expect_within(fmt::format("{}x{} pixels on {} lanes", size.width, size.height, lanes),
                          normal_error(evaluate_on(frame, scene, {.lanes = lanes}), truth), {2e-4, 2e-2, 0.2},
                          "degrees");
    }
}

/// Every shape with every content, clamped and tiled. Each is alone in its scene, so that no other decal hides an
/// error.
TEST(DecalTables, OfEveryShapeAndContent) {
    const HostFrame frame = small_frame();
    const std::pair<Content, const char*> contents[] = {{Content::height, "textures/seal_height.png"},
                                                        {Content::normal, "textures/weave_normal.png"},
                                                        {Content::slope, "textures/rock_slopes.png"}};
    for (const ProjectorShape shape : {ProjectorShape::box, ProjectorShape::sphere, ProjectorShape::cone})
        for (const auto& [content, file] : contents)
            for (const Wrap wrap : {Wrap::clamp, Wrap::repeat}) {
                std::vector<Projector> rows = on_surfaces(frame, 300, 0.4, 1.5, 27);
                for (Projector& row : rows) {
                    row.shape = shape, row.wrap = wrap;
                    row.repeat = {2, 1.5};
                    row.region = {0.125, 0, 0.875, 0.75};
                    row.scale = content == Content::height ? 0.05 : 0.4;
                    row.falloff = {0.2, 0, 0.5};
                }
                Scene scene = table_scene(rows);
                std::get<DecalsLayer>(scene.layers[0].bump).textures = {
                    {.file = data_folder / file, .content = content}};
                const Truth truth(frame, scene);
                const Pixels got = evaluate_on(frame, scene);
                const auto name = fmt::format("shape {}, {}, {}", int(shape), file, wrap == Wrap::clamp ? "" : "tiled");
                expect_within(name, normal_error(got, truth), {6e-5, 5e-3, 0.1}, "degrees");
                EXPECT_GT(bumped_pixels(truth), 200u) << name;
            }
}

TEST(DecalTables, OfRowsWithMasks) {
    const HostFrame frame = small_frame();
    ASSERT_GE(frame.frame.cryptomatte.size(), 3u);
    std::vector<Projector> rows = on_surfaces(frame, 200, 0.2, 1.5, 28);
    std::vector<std::string> names;
    for (const auto& [name, hash] : frame.frame.cryptomatte) names.push_back(name);
    for (std::size_t i = 0; i < rows.size(); ++i) {
        if (i % 3 == 0) rows[i].object = static_cast<double>(1 + i / 3 % 6);
        if (i % 3 == 1) rows[i].cryptomatte = names[i / 3 % names.size()];
        rows[i].scale = 0.1;
    }
    const Scene scene = table_scene(rows);
    const Truth truth(frame, scene);
    expect_within("rows with masks", normal_error(evaluate_on(frame, scene), truth), {2e-5, 5e-3, 0.1}, "degrees");
    for (Projector& row : rows) row.object.reset(), row.cryptomatte.clear();
    const Truth unmasked(frame, table_scene(rows));
    std::size_t changed = 0;
    for (std::size_t i = 0; i < frame.count(); ++i)
        changed += angle_degrees(truth.pixels[i].normal, unmasked.pixels[i].normal) > 1 ? 1 : 0;
    EXPECT_GT(changed, 1000u) << "masks that change nothing are not tested";
    rows[0].cryptomatte = names[0], rows[0].object = 1;
    EXPECT_THROW(evaluate(device(), table_scene(rows), frame.frame), Error);
    rows[0].cryptomatte = "no such object", rows[0].object.reset();
    EXPECT_THROW(evaluate(device(), table_scene(rows), frame.frame), Error);
}

TEST(DecalTables, FollowWhatParallaxesMove) {
    const HostFrame frame = small_frame();
    for (const auto& [name, layers] : parallax_stacks()) {
        Scene scene = table_scene(decals_around(positions(frame, layers), 300, 0.02, 0.5, 26));
        scene.layers.insert(scene.layers.begin(), layers.begin(), layers.end());
        const Truth truth(frame, scene);
        expect_within(name, normal_error(evaluate_on(frame, scene), truth), {3e-5, 2e-2, 1}, "degrees");
    }
}

TEST(DecalTables, InBandsAndOnOtherLanes) {
    const HostFrame frame = small_frame();
    const Scene scene = table_scene(on_surfaces(frame, 800, 0.05, 0.5, 24));
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
