#include "tools/farm_job.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace wrinkle {
namespace {

const FarmJob job{.name = "wall \"west\"",
                  .command = {"wrinkle", "run", "/shots/it's/wall.toml", "--frames"},
                  .frames = {1, 2, 3, 4, 5, 6, 7},
                  .chunk = 3};

TEST(FarmJob, FramesAreWrittenAsRanges) {
    EXPECT_EQ(frames_text({7}), "7");
    EXPECT_EQ(frames_text({1, 2}), "1-2");
    EXPECT_EQ(frames_text({1, 3}), "1,3");
    EXPECT_EQ(frames_text({1, 3, 5, 6, 7, 20}), "1-5x2,6-7,20");
    EXPECT_EQ(frames_text({5, 4, 3}), "5,4,3");
    EXPECT_EQ(frames_text({1, 11, 21}, ":"), "1-21:10");
}

TEST(FarmJob, SlurmGetsATaskAChunk) {
    const std::string script = slurm_script(job);
    EXPECT_NE(script.find("#SBATCH --array=0-2\n"), std::string::npos) << script;
    EXPECT_NE(script.find("chunks=(1-3 4-6 7)\n"), std::string::npos) << script;
    EXPECT_NE(script.find(R"('/shots/it'\''s/wall.toml' '--frames' "${chunks[$SLURM_ARRAY_TASK_ID]}")"),
              std::string::npos)
        << script;
}

TEST(FarmJob, OpenJobDescriptionIsJson) {
    const auto text = nlohmann::json::parse(openjd_template(job));
    EXPECT_EQ(text.at("specificationVersion"), "jobtemplate-2023-09");
    EXPECT_EQ(text.at("name"), job.name);
    const auto& step = text.at("steps").at(0);
    const auto& frames = step.at("parameterSpace").at("taskParameterDefinitions").at(0);
    EXPECT_EQ(frames.at("range"), "1-7");
    EXPECT_EQ(frames.at("chunks").at("defaultTaskCount"), 3);
    EXPECT_EQ(frames.at("chunks").at("rangeConstraint"), "CONTIGUOUS");
    const auto& run = step.at("script").at("actions").at("onRun");
    EXPECT_EQ(run.at("command"), "wrinkle");
    EXPECT_EQ(run.at("args"), (nlohmann::json{"run", "/shots/it's/wall.toml", "--frames", "{{Task.Param.Frames}}"}));
    FarmJob odd = job;
    odd.frames = {1, 3, 5};
    EXPECT_NE(openjd_template(odd).find("\"NONCONTIGUOUS\""), std::string::npos);
}

TEST(FarmJob, OutlinesQuoteForPythonAndTheShell) {
    const std::string outline = opencue_outline(job);
    EXPECT_NE(outline.find(R"(Outline("wall \"west\"",)"), std::string::npos) << outline;
    EXPECT_NE(
        outline.find(R"(command=["'wrinkle'", "'run'", "'/shots/it'\\''s/wall.toml'", "'--frames'", "#FRAMESPEC#"])"),
        std::string::npos)
        << outline;
    EXPECT_NE(outline.find("range=\"1-7\",\n        chunk=3,"), std::string::npos) << outline;
}

}  // namespace
}  // namespace wrinkle
