#include "tests/cli/cli.h"

namespace wrinkle::test {
namespace {

/// A wall of 8 x 6 pixels as frame.0001.exr to frame.0005.exr, with a scene.
class Job : public testing::Test {
protected:
    Job() {
        for (int frame = 1; frame <= 5; ++frame)
            write_exr(place_ / fmt::format("frame.{:04}.exr", frame), 8, 6, {"N.X", "N.Y", "N.Z", "Z"},
                      [](int c, int, int) { return c == 2   ? 1.0f
                                                   : c == 3 ? 5.0f
                                                            : 0.0f; });
        write_scene("frame.####.exr");
    }
    void write_scene(const std::string& frame, const std::string& more = {}) const {
        write_text(place_ / "it's a wall.toml",
                   fmt::format("[gbuffer]\nfile = \"{}\"\n[camera]\neye = [0, 0, 5]\ntarget = [0, 0, 0]\n"
                               "up = [0, 1, 0]\nfov = 10\n{}{}",
                               frame, tilt, more));
    }
    const Workplace place_;
};

TEST_F(Job, ItsTasksAreRunsThatTogetherMakeTheSequence) {
    const Ran ran =
        place_.run(fmt::format("job \"it's a wall.toml\" --frames 1-5 --chunk 2 --for slurm -o out --program '{}' "
                               "--set layer.tilt.scale=0.5 -- --precision exact",
                               WRINKLE_CLI));
    ASSERT_EQ(ran.code, 0) << ran.err;
    EXPECT_EQ(ran.out, "wrote out/wrinkle.sbatch; start it with: sbatch out/wrinkle.sbatch\n");
    for (const int task : {2, 0, 1}) {
        const std::string command = fmt::format("cd / && SLURM_ARRAY_TASK_ID={} bash '{}' > /dev/null 2>&1", task,
                                                (place_ / "out/wrinkle.sbatch").string());
        EXPECT_EQ(std::system(command.c_str()), 0) << task;
    }
    const std::string same =
        "run \"it's a wall.toml\" --frames 1-5 --quiet --set layer.tilt.scale=0.5 --precision exact";
    ASSERT_EQ(place_.run(same + " -o whole").code, 0);
    for (const std::string& name : place_.files("whole"))
        EXPECT_EQ(read_text(place_ / ("out/" + name)), read_text(place_ / ("whole/" + name))) << name;
}

TEST_F(Job, WhatNoTaskCouldRunIsRefused) {
    const std::string job = "job \"it's a wall.toml\" --for openjd ";
    expect_failed(place_.run(job), {"--frames"});
    expect_failed(place_.run(job + "--frames 5-1"), {"\"5-1\" is no frame list"});
    expect_failed(place_.run(job + "--frames 1-5 --chunk 0"), {"--chunk"});
    expect_failed(place_.run(job + "--frames 1-5 --presicion exact"), {"--presicion"});
    expect_failed(place_.run(job + "--frames 1-5 --set layer.tlt.scale=1"), {"there is no layer \"tlt\""});
    expect_failed(place_.run("job none.toml --for openjd --frames 1-5"), {"none.toml"});
    expect_failed(place_.run("job \"it's a wall.toml\" --for deadline --frames 1-5"), {"openjd", "slurm", "opencue"});
    write_scene("frame.0001.exr");
    expect_failed(place_.run(job + "--frames 1-5"), {"--frames", "frame.0001.exr"});
    EXPECT_EQ(place_.files("out"), std::vector<std::string>{});
}

TEST_F(Job, LightsThatEachTaskWouldFitAreToldOf) {
    write_scene("frame.####.exr", "[lighting]\nrelight = \"ratio\"\n");
    const Ran ran = place_.run("job \"it's a wall.toml\" --frames 1-5 --for opencue");
    EXPECT_EQ(ran.code, 0) << ran.err;
    expect_mentions(ran.err, {"warning: ", "wrinkle fit-lights"});
    EXPECT_EQ(place_.files("out"), std::vector<std::string>{"wrinkle.outline.py"});
}

}  // namespace
}  // namespace wrinkle::test
