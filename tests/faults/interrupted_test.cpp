// A full disk, or a signal in the middle of a run: older pictures stay as they were, and nothing else is left behind.
#include <fcntl.h>
#include <signal.h>
#include <spawn.h>

#include <chrono>
#include <thread>

#include "tests/cli/cli.h"

namespace wrinkle::test {
namespace {

using Names = std::vector<std::string>;
const Names pictures{"lit.exr", "lit.png", "normal.exr", "normal.png"};

/// Runs the scene, then overwrites each picture with a line of text, to find out whether a later run touches them.
void run_then_mark(const Workplace& place) {
    place.write_scene(
        "[[layer]]\nname = \"dunes\"\nkind = \"noise\"\nfrequency = 3\noctaves = 8\nfootprint = false\nscale = 0.1\n" +
        lit);
    const Ran ran = place.run("run scene.toml");
    ASSERT_EQ(ran.code, 0) << ran.err;
    for (const std::string& name : pictures) write_text(place / ("out/" + name), "old " + name);
}

void expect_unchanged(const Workplace& place, const std::string& when) {
    EXPECT_EQ(place.files("out"), pictures) << when;
    for (const std::string& name : pictures) EXPECT_EQ(read_text(place / ("out/" + name)), "old " + name) << when;
}

TEST(Interrupted, ByAFullDisk) {
    const Workplace place;
    run_then_mark(place);
    // Limits in blocks of 512 bytes: the first is too small for any file, the others for the EXR files only.
    for (const int blocks : {1, 64, 128}) {
        const Ran ran = place.run("run scene.toml", fmt::format("ulimit -f {};", blocks));
        expect_failed(ran, {"cannot write", ".exr", "unchanged"});
        expect_unchanged(place, fmt::format("{} blocks", blocks));
    }
    EXPECT_EQ(place.run("run scene.toml").code, 0);
    EXPECT_GT(fs::file_size(place / "out/normal.exr"), 1000u);
}

TEST(Interrupted, BySignals) {
    const Workplace place;
    run_then_mark(place);
    for (const int signal : {SIGTERM, SIGINT, SIGKILL}) {
        for (const int milliseconds : {30, 150, 600}) {
            const std::string when = fmt::format("signal {} after {} ms", signal, milliseconds);
            const std::string scene = (place / "scene.toml").string(), out = (place / "out").string();
            std::string words[] = {WRINKLE_CLI, "run", scene, "-o", out, "--repeat", "10000", "--quiet"};
            std::vector<char*> arguments;
            for (std::string& word : words) arguments.push_back(word.data());
            arguments.push_back(nullptr);
            pid_t child = 0;
            ASSERT_EQ(posix_spawn(&child, WRINKLE_CLI, nullptr, nullptr, arguments.data(), environ), 0);
            std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds));
            ASSERT_EQ(kill(child, signal), 0) << when;
            int status = 0;
            ASSERT_EQ(waitpid(child, &status, 0), child);
            EXPECT_TRUE(WIFSIGNALED(status)) << when << ": it had ended before";
            expect_unchanged(place, when);
        }
    }
}

}  // namespace
}  // namespace wrinkle::test
