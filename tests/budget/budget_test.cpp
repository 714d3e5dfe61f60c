// Error budgets: every scene of data/scenes keeps its own, by the double-precision evaluator of the references.
#include <algorithm>
#include <limits>

#include "budget/choose_precision.h"
#include "budget/error_sample.h"
#include "budget/tune.h"
#include "layers/kinds.h"
#include "run/frame_run.h"
#include "tests/io/files.h"
#include "tests/run/run_frame.h"
#include "tools/render.h"

namespace wrinkle::test {
namespace {

constexpr double kBudgets[] = {1, 0.1, 0.01, 1e-4};

/// A scene of data/scenes on the small frame, without light.
Scene on_small_frame(const std::string& name, const HostFrame& frame) {
    Scene scene = data_scene(name);
    scene.gbuffer.file = data_folder / "gbuffer/small.exr";
    scene.camera = {};
    scene.camera.inline_camera = frame.frame.camera;
    scene.lighting = {};
    scene.output = {.marked = true, .png = false};
    return scene;
}

/// The largest angle, in degrees, between what a run wrote and the truth, over all valid pixels. Those without a usable
/// neighbour, at the horizon, are left out: there kernels and references may decide differently.
double largest_error(const fs::path& file, const Truth& truth) {
    const GBufferReader reader(file);
    Pixels got;
    std::vector<std::string> names;
    std::vector<float*> into;
    for (const char* axis : {"X", "Y", "Z"}) {
        names.push_back(std::string("channel:normal.") + axis);
        std::string plane = std::string("normal.") + static_cast<char>(axis[0] - 'X' + 'x');
        into.push_back((got[plane] = std::vector<float>(truth.pixels.size())).data());
    }
    reader.read_rows(0, reader.size().height, names, into);
    std::vector<bool> left_out(truth.pixels.size());
    for (std::size_t i = 0; i < left_out.size(); ++i)
        left_out[i] = (truth.pixels[i].marked & Marked::no_uv_derivative) != 0;
    EXPECT_LE(std::ranges::count(left_out, true), 400) << "of 8160 pixels";
    return normal_error(got, truth, left_out).max;
}

class Budgets : public testing::TestWithParam<std::string> {};

TEST_P(Budgets, AreKept) {
    const HostFrame frame = small_frame();
    Scene scene = on_small_frame(GetParam(), frame);
    const Truth truth(frame, scene);
    const TempFolder folder;
    RenderOptions options;
    options.directory = folder / "out";
    options.device = test_device_name();
    for (const double max_error : kBudgets) {
        scene.budget = {.max_error = max_error, .sample = std::numeric_limits<int>::max()};
        const RenderReport report = render(scene, options);
        ASSERT_TRUE(report.budget);
        const double error = largest_error(folder / "out/normal.exr", truth);
        fmt::print("{} within {}: {:.2e} degrees ({:.2e} measured, {} pixels), {}\n", GetParam(), max_error, error,
                   report.budget->measured.max, report.budget->measured.samples, report.budget->precision);
        for (const std::string& miss : report.budget->misses) fmt::print("  missed by {}\n", miss);
        EXPECT_LE(error, max_error) << report.budget->precision;
        EXPECT_LE(error, 1.01 * report.budget->measured.max + 4e-5)
            << "floats of a file round off 6e-6; normals that cancel in mips lose more";
    }
}

/// The scenes of data/, but for those that Cycles bumped.
std::vector<std::string> data_scenes() {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(data_folder / "scenes"))
        if (const std::string name = entry.path().stem().string();
            entry.path().extension() == ".toml" && !name.starts_with("cycles_"))
            names.push_back(name);
    std::ranges::sort(names);
    return names;
}

INSTANTIATE_TEST_SUITE_P(Scenes, Budgets, testing::ValuesIn(data_scenes()),
                         [](const auto& info) { return info.param; });

TEST(Budget, LooserOnesAreNeverCostlierByTheTable) {
    const DeviceCosts costs = costs_of(device().info);
    for (const auto& entry : fs::directory_iterator(data_folder / "scenes")) {
        if (entry.path().extension() != ".toml") continue;
        const Scene scene = load_scene(entry.path());
        const std::vector<Choosable> all = choosables(scene, CameraKind::pinhole, costs);
        double before = 0, looser = 180;
        for (double max_error = looser; max_error > 1e-7; max_error *= 0.7) {
            const PrecisionChoice choice = choose_precision(all, scene.layers.size(), max_error);
            EXPECT_GE(choice.ns, before) << entry.path() << " " << max_error;
            EXPECT_TRUE(choice.fp64 || choice.error <= max_error) << entry.path() << " " << max_error;
            before = choice.ns;
        }
    }
}

TEST(Budget, TheTableKnowsEveryLayerOfTheScenes) {
    const DeviceCosts costs = costs_of(device().info);
    for (const auto& entry : fs::directory_iterator(data_folder / "scenes")) {
        if (entry.path().extension() != ".toml") continue;
        const Scene scene = load_scene(entry.path());
        for (std::size_t i = 0; i < scene.layers.size(); ++i) {
            if (std::holds_alternative<ResolveLayer>(scene.layers[i].bump)) continue;
            if (kind_of(layer_kinds(), scene.layers[i]).users_own) continue;
            const std::string kind = cost_kind(layer_kinds(), scene.layers[i]).name;
            for (const Precision precision : layer_precisions(layer_kinds(), scene, i, CameraKind::pinhole))
                EXPECT_TRUE(costs.find(kind, precision)) << kind << " " << precision_name(precision);
            EXPECT_TRUE(costs.find(kind, Precision::fp64)) << kind;
        }
    }
}

/// Two noises and a constant, with a table of round numbers.
struct TwoNoises {
    Scene scene;
    DeviceCosts costs{.device_class = "cpu, 16 lanes", .device = "made up", .driver = "", .kinds = {}, .areas = {}};

    TwoNoises() {
        scene.layers.resize(3);
        scene.layers[0].name = "fine", scene.layers[0].bump = NoiseLayer{.octaves = 2};
        scene.layers[1].name = "coarse", scene.layers[1].bump = NoiseLayer{.type = NoiseType::simplex};
        scene.layers[2].name = "tilt", scene.layers[2].bump = ConstantLayer{{0.1, 0, 0}};
        using enum Precision;
        costs.kinds["geometry"] = {{standard, {2, 0, 1e-3}}, {exact, {3, 0, 0}}, {fp64, {9, 0, 0}}};
        costs.kinds["noise perlin"] = {{standard, {10, 0, 0.5}}, {exact, {15, 0, 0.01}}, {fp64, {40, 0, 0}}};
        costs.kinds["noise simplex"] = {{standard, {20, 0, 0.2}}, {exact, {22, 0, 0.1}}, {fp64, {60, 0, 0}}};
    }
    std::vector<Choosable> all() const { return choosables(scene, CameraKind::pinhole, costs); }
    std::string chosen(double max_error) const {
        return describe(scene, choose_precision(all(), scene.layers.size(), max_error));
    }
};

TEST(Budget, ChoosesTheCheapestThatTheTableAllows) {
    const TwoNoises made;
    EXPECT_EQ(made.chosen(1), "geometry standard, layers standard");
    // An error of 0.1 for 2 ns.
    EXPECT_EQ(made.chosen(0.62), "geometry standard, layers standard but exact \"coarse\"");
    EXPECT_EQ(made.chosen(0.1105), "geometry exact, layers standard but exact \"fine\", \"coarse\"");
    EXPECT_EQ(made.chosen(0.112), "geometry standard, layers standard but exact \"fine\", \"coarse\"");
    EXPECT_EQ(made.chosen(0.109), "everything in double");
    EXPECT_EQ(choose_precision(made.all(), 3, 1).ns, 2 + 2 * 10 + 20);
    EXPECT_EQ(choose_precision(made.all(), 3, 0.01).ns, 9 + 2 * 40 + 60);
}

TEST(Budget, NamesWhatMissedAndEndsInDouble) {
    TwoNoises made;
    made.scene.budget.max_error = 1;
    Budget budget(made.scene, CameraKind::pinhole, made.costs);
    ErrorStats bad;
    bad.max = 7, bad.samples = 10;
    EXPECT_FALSE(budget.accept(bad));
    budget.raise(bad, [](const PrecisionChoice& choice) {  // raising the fine noise helps most, but not enough
        ErrorStats stats;
        stats.max = choice.precision.layers[0] == Precision::exact ? 3 : 7;
        return stats;
    });
    EXPECT_EQ(budget.report().precision, "geometry standard, layers standard but exact \"fine\"");
    expect_mentions(budget.report().misses.at(0), {"layer \"fine\" did it", "7 degrees", "3 with its next variant"});
    const auto nothing_helps = [&](const PrecisionChoice&) { return bad; };
    budget.raise(bad, nothing_helps);
    EXPECT_TRUE(budget.choice().fp64);
    expect_mentions(budget.report().misses.at(1), {"no layer's next variant helps"});
    bad.max = 0.5;
    EXPECT_TRUE(budget.accept(bad));
    bad.not_finite = 1;
    EXPECT_FALSE(budget.accept(bad));
    EXPECT_THROW(budget.raise(bad, nothing_helps), Error);
}

TEST(Budget, CountsWhatHalfFloatsRoundOff) {
    TwoNoises made;
    made.scene.output.half = true;
    made.scene.budget.max_error = 0.02;
    EXPECT_THROW(Budget(made.scene, CameraKind::pinhole, made.costs), Error);
    made.scene.budget.max_error = 1;
    Budget budget(made.scene, CameraKind::pinhole, made.costs);
    ErrorStats close;
    close.max = 0.98;
    EXPECT_FALSE(budget.accept(close));
}

TEST(Budget, DamagedTablesAreNamed) {
    const TempFolder folder;
    for (const char* text :
         {"", "{", "[]", "{\"devices\": [{}]}",
          "{\"devices\": [{\"class\": \"\", \"device\": \"\", \"driver\": \"\", \"kinds\": "
          "{\"noise\": {\"exact\": {\"ns\": -1, \"p99\": 0, \"max\": 0}}}}]}",
          R"({"devices": [{"class": "", "device": "", "driver": "", "kinds": {}, "areas": {"noise": )"
          R"([{"taps": 1e30, "ns": 1, "median": 0, "p99": 0}]}}]})"}) {
        write_text(folder / "costs.json", text);
        try {
            read_costs(folder / "costs.json");
            ADD_FAILURE() << text;
        } catch (const Error& error) { expect_mentions(error.what(), {"costs.json: "}); }
    }
    const TwoNoises made;
    write_costs(folder / "costs.json", {made.costs});
    const DeviceCosts again = read_costs(folder / "costs.json").at(0);
    EXPECT_EQ(again.device, "made up");
    EXPECT_EQ(again.find("noise perlin", Precision::exact).value().max, 0.01);
    EXPECT_FALSE(again.find("noise perlin", Precision::fast));
    EXPECT_FALSE(again.find_taps("noise perlin", 16)) << "none was measured";
}

TEST(Budget, TablesKnowTaps) {
    const TempFolder folder;
    TwoNoises made;
    made.costs.areas["noise perlin"] = {{2, {3, 0.5, 4}}, {8, {6, 0.25, 2}}};
    merge_costs(folder / "costs.json", made.costs);
    made.costs.areas = {{"decal", {{1, {1, 0, 9}}}}};
    merge_costs(folder / "costs.json", made.costs);  // adds a kind, and keeps the other
    const DeviceCosts read = read_costs(folder / "costs.json").at(0);
    EXPECT_EQ(read.find_taps("decal", 16).value().second.p99, 9);
    const auto most = read.find_taps("noise perlin", 16).value(), fewer = read.find_taps("noise perlin", 7).value();
    EXPECT_EQ(most.first, 8);
    EXPECT_EQ(most.second.ns, 6);
    EXPECT_EQ(most.second.median, 0.25);
    EXPECT_EQ(fewer.first, 2);
    EXPECT_FALSE(read.find_taps("noise perlin", 1)) << "fewer than were measured";
    EXPECT_FALSE(read.find_taps("volume", 16));
    const auto shipped = shipped_costs().at(0).areas;
    for (const LayerKind* kind : layer_kinds()) {
        const auto of_kind = [&](const auto& row) {
            return (row.first + ' ').starts_with(std::string(kind->name) + ' ');
        };
        EXPECT_TRUE(kind->ends_stage || kind->once_a_pixel || std::ranges::any_of(shipped, of_kind))
            << kind->name << ": kernels/precision.json does not say what it misses of areas";
    }
}

TEST(ErrorSample, NeedsDoublePrecision) {
    Device without = device();
    without.info.fp64 = false;
    const HostFrame frame = small_frame();
    try {
        ErrorSample(without, Scene{}, frame.frame, {});
        ADD_FAILURE();
    } catch (const Error& error) { expect_mentions(error.what(), {"max_error", "cl_khr_fp64", "--device"}); }
}

/// A pass whose normals are slightly wrong: the sample must measure by how much, whichever pixels are drawn.
TEST(ErrorSample, MeasuresAnglesOfASeededSample) {
    const HostFrame frame = small_frame();
    Scene scene, wrong;
    for (Scene* each : {&scene, &wrong}) {
        each->layers.resize(1);
        each->layers[0].name = "tilt";
        each->gbuffer.file = data_folder / "gbuffer/small.exr";
    }
    scene.layers[0].bump = ConstantLayer{{0.3, 0, 0}}, wrong.layers[0].bump = ConstantLayer{{0.31, 0, 0}};
    const Pixels right = evaluate_on(frame, scene), off = evaluate_on(frame, wrong);
    double largest = 0;
    for (std::size_t i = 0; i < frame.count(); ++i)
        largest = std::max(largest, angle_degrees(vec_at(right, "normal", i), vec_at(off, "normal", i)));
    const auto measured = [&](int sample, int seed) {
        ErrorSample errors(device(), scene, frame.frame, {.max_error = {}, .sample = sample, .seed = seed});
        Pass pass = evaluate(device(), wrong, frame.frame);
        const GBufferReader reader(scene.gbuffer.file);
        PhaseClock clock;
        FrameRun run(pass.impl(), reader, clock);
        run.check_bands(errors, frame.frame.camera);
        run.run();
        return errors.stats();
    };
    const ErrorStats all = measured(std::numeric_limits<int>::max(), 1), some = measured(1000, 1);
    EXPECT_NEAR(all.max, largest, 1e-4);
    EXPECT_GT(all.median, 0.01);
    EXPECT_LE(some.samples, 1008u);  // rounded up to whole work-items; background does not count
    EXPECT_GT(some.samples, 300u);
    EXPECT_LE(some.max, all.max);
    EXPECT_NEAR(some.median, all.median, 0.1);
    EXPECT_EQ(measured(1000, 1).median, some.median);
    EXPECT_NE(measured(1000, 2).median, some.median);
}

}  // namespace
}  // namespace wrinkle::test
