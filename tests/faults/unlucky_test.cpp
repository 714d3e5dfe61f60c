// Whatever stands where a file, a stream or a folder is expected: one clear line, soon, and nothing lost.
#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <chrono>

#include "tests/cli/cli.h"
#include "tests/io/odd_exr.h"

namespace wrinkle::test {
namespace {

/// Runs the program for at most 20 s and with little memory to waste, so that what hangs or eats memory fails.
Ran run(const Workplace& place, const std::string& arguments, const std::string& before = {}) {
    return place.run(arguments, "ulimit -v 6000000; " + before + " timeout -s KILL 20");
}

/// Expects a failure with one line that has these parts. The program needs less than 2 s of the processor and 300 MB.
void expect_refused(const Workplace& place, const std::string& arguments, const std::vector<std::string>& parts) {
    SCOPED_TRACE(arguments);
    rusage before{}, after{};
    getrusage(RUSAGE_CHILDREN, &before);
    const Ran ran = run(place, arguments);
    getrusage(RUSAGE_CHILDREN, &after);
    expect_failed(ran, parts);
    EXPECT_LE(std::ranges::count(ran.err, '\n'), 2) << ran.err;  // what is wrong with a table stands on its own
    const auto seconds = [](const rusage& usage) {
        return static_cast<double>(usage.ru_utime.tv_sec + usage.ru_stime.tv_sec) +
               1e-6 * static_cast<double>(usage.ru_utime.tv_usec + usage.ru_stime.tv_usec);
    };
    EXPECT_LT(seconds(after) - seconds(before), 2);
}

TEST(Unlucky, PipesAndDevicesAreNoFiles) {
    const Workplace place;
    ASSERT_EQ(::mkfifo((place / "pipe").c_str(), 0600), 0);
    for (const std::string& name : std::vector<std::string>{"pipe", "/dev/zero", "/dev/full", "."}) {
        const std::vector<std::string> parts{"cannot be read: it is a"};
        expect_refused(place, "run " + name, parts);
        expect_refused(place, "info " + name, parts);
        expect_refused(place, "eval resolve --in " + name, parts);
        place.write_scene(tilt, name);
        expect_refused(place, "explain scene.toml", {name == "." ? "is a folder" : "it is a"});
        place.write_scene(tilt, Workplace::data_file("gbuffer/small.exr"), "file = \"" + name + "\"");
        expect_refused(place, "run scene.toml", {name == "." ? "is a folder" : "it is a"});
    }
    for (const std::string& kind :
         std::vector<std::string>{"height_map\"\ntexture", "volume\"\nvolume", "decals\"\nfile"}) {
        place.write_scene("[[layer]]\nkind = \"" + kind + " = \"pipe\"\nscale = 1\n" +
                          (kind[0] == 'd' ? "textures = [{file = \"pipe\"}]\n" : ""));
        expect_refused(place, "run scene.toml", {"pipe", "it is a pipe"});
    }
}

TEST(Unlucky, ASceneMayComeThroughStandardInput) {
    const Workplace place;
    place.write_scene(tilt);
    const Ran ran = place.run("run - --quiet", "", "scene.toml");
    EXPECT_EQ(ran.code, 0) << ran.err;
    EXPECT_TRUE(fs::exists(place / "out/normal.exr"));
    write_text(place / "bad.toml", "[gbuffer]\nfiel = 1\n");
    expect_failed(place.run("run - --quiet", "", "bad.toml"), {"standard input:2", "\"fiel\""});
}

TEST(Unlucky, InputsAreNoOutputs) {
    const Workplace place;
    const auto copy = [&](const char* to) {
        fs::copy_file(Workplace::data_file("gbuffer/small.exr"), place / to, fs::copy_options::overwrite_existing);
    };
    copy("normal.exr"), copy("frame.exr");
    const std::string bytes = read_text(place / "normal.exr");
    place.write_scene(tilt, "normal.exr");
    expect_failed(place.run("run scene.toml -o ."), {"cannot write ./normal.exr", "normal.exr, which is read"});
    place.write_scene(tilt, "frame.exr");
    fs::create_directory(place / "out");
    fs::create_symlink("../frame.exr", place / "out/normal.exr");
    expect_failed(place.run("run scene.toml"), {"out/normal.exr", "frame.exr, which is read"});
    fs::remove(place / "out/normal.exr");
    fs::create_hard_link(place / "frame.exr", place / "out/normal.exr");
    expect_failed(place.run("run scene.toml"), {"out/normal.exr", "frame.exr, which is read"});
    EXPECT_EQ(read_text(place / "normal.exr"), bytes);
    EXPECT_EQ(read_text(place / "frame.exr"), bytes);
    const std::string scene = read_text(place / "scene.toml");
    expect_failed(place.run("scatter scene.toml -o scene.toml"), {"cannot write scene.toml"});
    expect_failed(place.run("scatter scene.toml -o ./frame.exr"), {"cannot write ./frame.exr"});
    EXPECT_EQ(read_text(place / "scene.toml"), scene);
    fs::copy_file(Workplace::data_file("textures/rock_height.png"), place / "normal.png");
    place.write_scene("[[layer]]\nkind = \"triplanar\"\ntexture = \"normal.png\"\nscale = 0.1\n", "frame.exr");
    const Ran ran = place.run("run scene.toml -o .");
    expect_failed(ran, {"normal."});
    EXPECT_EQ(read_text(place / "normal.png"), read_text(Workplace::data_file("textures/rock_height.png")));
    write_text(place / "in.csv", "n.x,n.y,n.z,g.x,g.y,g.z\n0,0,1,0,0,0\n");
    expect_failed(place.run("eval resolve --in in.csv --out in.csv"), {"cannot write in.csv"});
}

TEST(Unlucky, ASandboxHoldsWhateverAScenesNames) {
    const Workplace place;
    fs::create_directory(place / "inside");
    fs::copy_file(Workplace::data_file("gbuffer/small.exr"), place / "inside/frame.exr");
    fs::copy_file(Workplace::data_file("gbuffer/small.camera.json"), place / "inside/camera.json");
    fs::create_symlink(Workplace::data_file("gbuffer/small.exr"), place / "inside/link.exr");
    const std::string camera = "file = \"camera.json\"";
    const auto scene = [&](const std::string& layers, const std::string& frame) {
        place.write_scene(layers, frame, camera, "inside/scene.toml");
    };
    scene(tilt, "frame.exr");
    Ran ran = place.run("run inside/scene.toml --sandbox inside --quiet");
    EXPECT_EQ(ran.code, 0) << ran.err;
    for (const std::string& outside : {Workplace::data_file("gbuffer/small.exr"), std::string("link.exr")}) {
        scene(tilt, outside);
        expect_refused(place, "run inside/scene.toml --sandbox inside", {"outside of the folder"});
    }
    scene("[[layer]]\nkind = \"kernel\"\nfile = \"" + Workplace::data_file("kernels/dents.clh") + "\"\n", "frame.exr");
    expect_failed(run(place, "run inside/scene.toml --sandbox inside"), {"outside of the folder"});
    fs::copy_file(Workplace::data_file("kernels/dents.clh"), place / "inside/dents.clh");
    scene("[[layer]]\nkind = \"kernel\"\nfile = \"dents.clh\"\nfunction = \"dents\"\nscale = 0.01\n", "frame.exr");
    expect_failed(run(place, "run inside/scene.toml --sandbox inside"), {"kernel", "sandbox"});
    expect_failed(run(place, "run inside/scene.toml --sandbox nowhere"), {"the sandbox nowhere"});
}

TEST(Unlucky, MemoryIsLimitedByName) {
    const Workplace place;
    place.write_scene(tilt);
    EXPECT_EQ(place.run("run scene.toml --quiet --memory 2").code, 0);
    expect_failed(run(place, "info scene.toml", "WRINKLE_MEMORY=lots"), {"WRINKLE_MEMORY is \"lots\""});
    // No file is too large by itself: what the program has taken counts, and what becomes of a picture.
    write_image(place / "flat.png", {{make_spec(3000, 3000, {"Y"}, OIIO::TypeUInt8), [](int, int, int) { return 0; }}});
    place.write_scene("[[layer]]\nkind = \"height_map\"\ntexture = \"flat.png\"\nscale = 1\n");
    expect_refused(
        place, "run scene.toml --memory 0.25",
        {"flat.png: its mips from 3000 x 3000 texels on would take", "in use; the limit of --memory is 250 MB"});
    expect_failed(run(place, "run scene.toml", "WRINKLE_MEMORY=0.25"), {"flat.png", "the limit of WRINKLE_MEMORY is"});
    // Files of limits where the kernel shows them, in both versions, for a process that may mount some.
    const std::string mount = "unshare -m sh -c 'mount -t tmpfs none /sys/fs/cgroup && mkdir /sys/fs/cgroup/memory";
    if (std::system((mount + "' 2> /dev/null").c_str()) != 0) return;
    write_text(place / "limited.sh",
               "cd /sys/fs/cgroup && echo 250000000 | tee memory.max > memory/memory.limit_in_bytes");
    expect_failed(place.run("run scene.toml", mount + " && sh limited.sh && exec \"$0\" \"$@\"'"),
                  {"flat.png", "the limit of the cgroup is 250 MB"});
}

TEST(Unlucky, NothingAroundItAbortsIt) {
    const Workplace place;
    place.write_scene(tilt);
    fs::create_directory(place / "home");
    const std::string scene = "run scene.toml --quiet";
    EXPECT_EQ(place.run(scene).code, 0);
    // sh does not let the test close a stream of the program's but by redirection behind it.
    for (const char* closed : {"<&-", ">&-", "2>&-"}) {
        const Ran ran = place.run("run none.toml " + std::string(closed) + " ; true");
        EXPECT_LE(ran.code, 1) << closed;
    }
    const Ran ends = place.run("eval --reference | head -n 1", "");
    EXPECT_EQ(ends.err.find("terminate"), std::string::npos) << ends.err;
    const std::string fresh = "env WRINKLE_CACHE_DIR=" + (place / "home/cache").string();
    const Ran no_path = place.run(scene, fresh + " PATH=/nowhere");
    EXPECT_TRUE(no_path.code == 0 || no_path.code == 1) << no_path.code << no_path.err;
    const Ran no_home = place.run(scene, "env -u WRINKLE_CACHE_DIR -u XDG_CACHE_HOME HOME=/proc/nowhere");
    EXPECT_EQ(no_home.code, 0) << no_home.err;
    for (const int megabytes : {100, 200, 400, 700, 740, 780, 800, 840}) {
        const Ran little = place.run(scene, fmt::format("ulimit -v {};", megabytes << 10));
        EXPECT_TRUE(little.code == 0 || little.code == 1 || little.code == 127) << megabytes << ": " << little.code;
        EXPECT_EQ(little.err.find("terminate"), std::string::npos) << little.err;
    }
}

TEST(Unlucky, WhatStandsInTheCacheIsNoProgram) {
    const Workplace place;
    place.write_scene(tilt);
    const std::string cache = "env WRINKLE_CACHE_DIR=" + (place / "cache").string() + " timeout -s KILL 60";
    const auto program = [&] {
        for (const auto& entry : fs::directory_iterator(place / "cache"))
            if (entry.path().extension() == ".program") return entry.path();
        return fs::path();
    };
    ASSERT_EQ(place.run("run scene.toml --quiet", cache).code, 0);
    const fs::path file = program();
    fs::remove(file), fs::create_directory(file);
    EXPECT_EQ(place.run("run scene.toml --quiet", cache).code, 0);
    fs::remove_all(file), ::mkfifo(file.c_str(), 0600);
    EXPECT_EQ(place.run("run scene.toml --quiet", cache).code, 0);
    fs::permissions(place / "cache", fs::perms::none);
    EXPECT_EQ(place.run("run scene.toml --quiet", cache).code, 0);
    fs::permissions(place / "cache", fs::perms::owner_all);
}

TEST(Unlucky, ASidecarIsAFileBesideTheFrame) {
    const Workplace place;
    fs::create_directory(place / "frames");
    ASSERT_EQ(::mkfifo((place / "frames/pipe").c_str(), 0600), 0);
    write_text(place / "secret.json", "{\"somebody else's\": \"deadbeef\"}");
    write_text(place / "frames/own.json", "{\"our own\": \"deadbeef\"}");
    const auto frame = [&](const std::string& sidecar) {
        ExrHeader header;
        header.channels = {{"N.X"},        {"N.Y"},        {"N.Z"},        {"Z"},
                           {"crypto00.A"}, {"crypto00.B"}, {"crypto00.G"}, {"crypto00.R"}};
        for (const auto& [key, value] : {std::pair<std::string, std::string>{"name", "crypto"},
                                         {"hash", "MurmurHash3_32"},
                                         {"conversion", "uint32_to_float32"},
                                         {"manif_file", sidecar}})
            header.after += exr_attribute("cryptomatte/abc/" + key, "string", value);
        write_text(place / "frames/f.exr", exr_file(header));
        return run(place, "info frames/f.exr");
    };
    EXPECT_NE(frame("own.json").out.find("our own"), std::string::npos);
    for (const std::string sidecar :
         {"../secret.json", (place / "secret.json").c_str(), "pipe", "/dev/zero", "..", "."}) {
        const Ran ran = frame(sidecar);
        EXPECT_EQ(ran.code, 0) << sidecar << ": " << ran.err;
        EXPECT_EQ(ran.out.find("somebody"), std::string::npos) << sidecar;
    }
}

TEST(Unlucky, TextsOfAnyShape) {
    const Workplace place;
    std::string deep = "[gbuffer]\na", unknown = "[gbuffer]\n";
    for (int i = 0; i < 1'000'000; ++i) deep += ".a";
    for (int i = 0; i < 200'000; ++i) unknown += fmt::format("key{} = 1\n", i);
    write_text(place / "deep.toml", deep + " = 1\n");
    write_text(place / "unknown.toml", unknown);
    expect_refused(place, "run deep.toml", {"deep.toml:2", "a key of more than 16 parts"});
    const Ran many = run(place, "run unknown.toml");
    EXPECT_EQ(many.code, 1) << many.err;
    expect_mentions(many.err, {"unknown.toml:2: unknown key \"key0\"", "and 1998"});
    EXPECT_LT(many.err.size(), 1u << 20);
}

}  // namespace
}  // namespace wrinkle::test
