// A bump of the user's own whose gradient duals compute, against the same formula with its gradient written by hand.
#include "tests/io/files.h"
#include "tests/run/run_frame.h"

namespace wrinkle::test {
namespace {

Pixels dented(const HostFrame& frame, const std::filesystem::path& file) {
    Scene scene;
    scene.filter.taps = 1;
    scene.layers.resize(1);
    scene.layers[0].scale = 0.05;
    scene.layers[0].bump = KernelLayer{
        .file = file, .function = "dents", .parameters = {{"spacing", 0.35}, {"radius", 0.45}, {"depth", 1.0}}};
    return evaluate_on(frame, scene);
}

TEST(UserKernel, DualsGiveTheGradientWrittenByHand) {
    const Camera camera = reference::tilted_camera();
    const V up{0, 0, 1};
    const HostFrame frame(plane_frame(camera, {96, 64}, up), camera);
    const std::filesystem::path source = WRINKLE_SOURCE_DIR;
    const Pixels duals = dented(frame, source / "data/kernels/dents.clh");
    const Pixels by_hand = dented(frame, source / "bench/kernels/dents_by_hand.clh");
    double apart = 0, bumped = 0;
    for (std::size_t i = 0; i < frame.count(); ++i) {
        const V a = vec_at(duals, "normal", i), b = vec_at(by_hand, "normal", i);
        const auto angle = [](V v, V w) { return std::atan2(length(cross(v, w)), dot(v, w)) * 57.29577951308232; };
        apart = std::max(apart, angle(a, b));
        bumped = std::max(bumped, angle(b, up));
    }
    EXPECT_GT(bumped, 5) << "the dents show";
    EXPECT_LE(apart, 1e-3);
}

/// A layer whose function is `text`.
Scene written(const TempFolder& folder, const std::string& function, const std::string& text) {
    write_text(folder / "own.clh", text);
    Scene scene;
    scene.filter.taps = 1;
    scene.layers.resize(1);
    scene.layers[0].name = "own";
    scene.layers[0].scale = 0.1;
    scene.layers[0].bump = KernelLayer{.file = folder / "own.clh", .function = function, .parameters = {{"k", 2.0}}};
    return scene;
}

TEST(UserKernel, MayBeCalledAsVariablesOfTheKernelAre) {
    const TempFolder folder;
    const HostFrame frame = small_frame();
    const auto bumped = [&](const std::string& name) {
        return evaluate_on(frame, written(folder, name,
                                          "wr_fn wr_dual " + name + "(wr_bump_point at, " + name +
                                              "_parameters k)\n{\n    wr_point q = wr_scale(wr_point_of(at.p), "
                                              "(wr_real)(k.k));\n    return wr_sin(q.x);\n}\n"));
    };
    const Pixels plain = bumped("waves");
    for (const char* name : {"p", "point", "numbers"}) EXPECT_EQ(bumped(name), plain) << name;
}

TEST(UserKernel, MistakesAreToldWithItsOwnLines) {
    const TempFolder folder;
    const HostFrame frame = small_frame();
    const auto message = [&](const std::string& text) {
        return error_of([&] { evaluate_on(frame, written(folder, "waves", text)); });
    };
    const std::string head = "// one\nwr_fn wr_dual waves(wr_bump_point at, waves_parameters k)\n";
    expect_mentions(message(head + "{\n    return nothing;\n}\n"), {"own.clh:4", "nothing"});
    expect_mentions(message("\nwr_fn wr_dual waves(wr_bump_point at)\n{\n    return wr_point_of(at.p).x;\n}\n"),
                    {"own.clh:2"});
    expect_mentions(message(head + "{ /* { */\n    return wr_point_of(at.p).x;\n"), {"own.clh:3", "no partner"});
    expect_mentions(message(head + "{\n    return wr_point_of(at.p).x;  // }\n}\n}\n"), {"own.clh:6", "no partner"});
    expect_mentions(message("// waves\n"), {"own.clh has no function \"waves\""});
}

}  // namespace
}  // namespace wrinkle::test
