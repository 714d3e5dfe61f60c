// A scene gives the same when it is evaluated in other ways: by split kernels, in bands of rows, on other numbers of
// lanes, in double.
#include <algorithm>

#include "tests/run/run_frame.h"

namespace wrinkle::test {
namespace {

/// A scene with every kind of layer, a bare UV plane and two stages, small enough to be compiled often.
Scene mixed_scene() {
    Scene scene = data_scene("decals");
    const auto add = [&](const char* from, std::size_t layer) {
        scene.layers.push_back(data_scene(from).layers.at(layer));
    };
    // A parallax of this height moves the layers after it on the wall.
    Layer depth = data_scene("height_map").layers.at(1);
    const auto& stones = std::get<HeightMapLayer>(depth.bump);
    depth.bump = ParallaxLayer{.texture = stones.texture, .uv = stones.uv, .curved = true};
    depth.name = "depth";
    scene.layers.push_back(depth);
    add("height_map", 1);
    add("normal_map", 0);
    add("resolve", 1);
    add("noise", 0);
    std::get<NoiseLayer>(scene.layers.back().bump).octaves = 3;
    scene.output = {.surface_gradient = true, .dp_dx = true, .dp_dy = true, .marked = true};
    return with_own_names(scene);
}

/// Degrees between the normals of two runs of a frame.
template <class A, class B>
Spread between(const HostFrame& frame, const std::map<std::string, std::vector<A>>& a,
               const std::map<std::string, std::vector<B>>& b) {
    std::vector<double> errors;
    for (std::size_t i = 0; i < frame.count(); ++i) {
        const V x = vec_at(a, "normal", i), y = vec_at(b, "normal", i);
        if (length(x) > 0 || length(y) > 0) errors.push_back(angle_degrees(x, y));
    }
    return Spread(std::move(errors));
}

TEST(Variants, SplitKernelsGiveWhatTheFusedKernelGives) {
    const HostFrame frame = small_frame();
    const Scene scene = mixed_scene();
    const Pixels fused = evaluate_on(frame, scene), split = evaluate_on(frame, scene, {.split = true});
    // Only the compiler's choice of what to contract to fma may differ. Steep texels magnify that.
    expect_within("split against fused", between(frame, split, fused), {1e-6, 1e-5, 1e-4}, "degrees");
    EXPECT_EQ(split.at("marked"), fused.at("marked"));
}

TEST(Variants, LaneCountsAgreeToRounding) {
    const HostFrame frame = small_frame();
    const Scene scene = mixed_scene();
    const Pixels sixteen = evaluate_on(frame, scene, {.lanes = 16});
    for (const int lanes : {1, 4, 8}) {
        const Pixels other = evaluate_on(frame, scene, {.lanes = lanes});
        expect_within(fmt::format("{} lanes against 16", lanes), between(frame, other, sixteen), {1e-6, 1e-5, 1e-3},
                      "degrees");
        EXPECT_EQ(other.at("marked"), sixteen.at("marked")) << lanes;
    }
}

/// Four stages, each of which bumps the surface that the one before has made.
TEST(Variants, AnyNumberOfStagesAgreesWithTheReference) {
    const HostFrame frame = small_frame();
    Scene scene = data_scene("resolve");
    const auto add = [&](const char* from, std::size_t layer, double scale) {
        scene.layers.push_back(data_scene("resolve").layers.at(1));
        scene.layers.push_back(data_scene(from).layers.at(layer));
        scene.layers.back().scale = scale;
    };
    add("triplanar_object", 1, 0.3);
    add("height_channel", 0, 0.002);
    scene = with_own_names(scene);
    scene.lighting.relight = Relight::off;
    ASSERT_EQ(std::ranges::count_if(scene.layers,
                                    [](const Layer& l) { return std::holds_alternative<ResolveLayer>(l.bump); }),
              3);
    const Truth truth(frame, scene);
    std::vector<double> errors;
    const Pixels got = evaluate_on(frame, scene);
    for (std::size_t i = 0; i < frame.count(); ++i)
        if (truth.pixels[i].valid) errors.push_back(angle_degrees(vec_at(got, "normal", i), truth.pixels[i].normal));
    expect_within("four stages", Spread(std::move(errors)), {7e-5, 8e-4, 2e-3}, "degrees");
    EXPECT_EQ(marked_differences(got, truth), 0u);
}

TEST(Variants, DoubleAgreesWithTheReference) {
    if (!device().info.fp64) GTEST_SKIP() << "needs double precision, which " << device().info.name << " lacks";
    const HostFrame frame = small_frame();
    Scene noise = data_scene("noise");  // without textures, which are float in double runs, too
    noise.layers.push_back(data_scene("constant").layers.at(0));
    noise = with_own_names(noise);
    noise.lighting.relight = Relight::off;
    Pass exact = evaluate(device(), noise, frame.frame, {.fp64 = true});
    expect_within("double, without texels", normal_error(run<double>(exact, frame), Truth(frame, noise)),
                  {1e-12, 1e-11, 1e-10}, "degrees");

    const Scene scene = mixed_scene();
    const Truth truth(frame, scene);
    Pass pass = evaluate(device(), scene, frame.frame, {.fp64 = true});
    const auto got = run<double>(pass, frame);
    // Here slopes and mips are stored as floats, while they are double in the reference.
    expect_within("double, texels in float", normal_error(got, truth), {1e-11, 1e-5, 1e-4}, "degrees");
    EXPECT_EQ(marked_differences(got, truth), 0u);

    std::map<std::string, std::vector<float>> narrow;
    HostOutputs spans;
    for (const std::string& name : pass.outputs()) spans[name] = narrow[name] = std::vector<float>(frame.count());
    EXPECT_THROW(pass.run(frame.planes(), spans), Error) << "float outputs of a double pass";
}

cl::Buffer upload(std::span<const float> values) {
    std::vector<float> whole(values.begin(), values.end());
    whole.resize(padded(whole.size()));
    return {device().context, CL_MEM_READ_ONLY | CL_MEM_COPY_HOST_PTR, whole.size() * sizeof(float), whole.data()};
}

TEST(Variants, BandsAreTheWholeFrameBitForBit) {
    const HostFrame frame = small_frame();
    const Size size = frame.frame.size;
    const Scene scene = mixed_scene();
    Pass pass = evaluate(device(), scene, frame.frame);
    ASSERT_TRUE(pass.needs_neighbours());
    const Pixels whole = run(pass, frame);
    for (const std::uint32_t rows : {1u, 7u, 33u}) {
        Pixels banded;
        for (const std::string& name : pass.outputs()) banded[name].resize(frame.count());
        for (std::uint32_t first = 0; first < size.height; first += rows) {
            Rows band{first, std::min(rows, size.height - first), std::min(first, 1u), 0};
            band.after = std::min(1u, size.height - first - band.count);
            DevicePlanes in, out;
            const std::size_t begin = std::size_t{first - band.before} * size.width;
            const std::size_t pixels = std::size_t{band.count} * size.width;
            for (const std::string& name : pass.inputs())
                in[name] = upload(std::span(frame.pixels.at(name))
                                      .subspan(begin, std::size_t{band.before + band.count + band.after} * size.width));
            for (const std::string& name : pass.outputs())
                out[name] = cl::Buffer(device().context, CL_MEM_WRITE_ONLY, padded(pixels) * sizeof(float));
            const cl::Event done = pass.enqueue(in, out, band);
            const std::vector<cl::Event> after{done};
            for (const std::string& name : pass.outputs())
                device().queue.enqueueReadBuffer(out[name], CL_TRUE, 0, pixels * sizeof(float),
                                                 banded[name].data() + std::size_t{first} * size.width, &after);
        }
        EXPECT_EQ(largest_difference(whole, banded), 0) << "bands of " << rows << " rows";
    }
}

}  // namespace
}  // namespace wrinkle::test
