#pragma once

#include <fmt/format.h>
#include <sys/wait.h>

#include <cstdlib>
#include <regex>
#include <set>

#include "tests/device/test_device.h"
#include "tests/io/files.h"

/// Runs the built program as a user would.
namespace wrinkle::test {

namespace fs = std::filesystem;

inline const fs::path data_folder = fs::path(WRINKLE_SOURCE_DIR) / "data";

inline std::string read_text(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

/// The bytes of a picture's pixels: files differ by their provenance as well.
inline std::vector<unsigned char> pixels_of(const fs::path& file) {
    const auto input = OIIO::ImageInput::open(file.string());
    if (!input) return {};
    std::vector<unsigned char> bytes(input->spec().image_pixels() * static_cast<std::size_t>(input->spec().nchannels));
    EXPECT_TRUE(input->read_image(0, 0, 0, -1, OIIO::TypeUInt8, bytes.data())) << input->geterror();
    return bytes;
}

struct Ran {
    int code = -1;    ///< exit status; 128 + the signal's number when a signal ended it
    std::string out;  ///< what it printed
    std::string err;
};

/// A folder to run the program in, with a scene to run.
class Workplace {
public:
    /// `before`: shell text in front of the program, such as "ulimit -f 8;" or "NAME=value". `input`: standard input.
    Ran run(const std::string& arguments, const std::string& before = {},
            const std::string& input = "/dev/null") const {
        const std::string command =
            fmt::format("cd '{}' && {} '{}' {} > stdout.txt 2> stderr.txt < {}", (folder_ / "").string(), before,
                        WRINKLE_CLI, on_test_device(arguments), input);
        const int status = std::system(command.c_str());
        const int code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
        Ran ran{code, read_text(folder_ / "stdout.txt"), read_text(folder_ / "stderr.txt")};
        fs::remove(folder_ / "stdout.txt");
        fs::remove(folder_ / "stderr.txt");
        return ran;
    }

    fs::path operator/(const std::string& name) const { return folder_ / name; }

    /// A scene on the small sample frame; `layers` is TOML text.
    void write_scene(const std::string& layers, const std::string& gbuffer = data_file("gbuffer/small.exr"),
                     const std::string& camera = "file = \"" + data_file("gbuffer/small.camera.json") + "\"",
                     const std::string& name = "scene.toml") const {
        write_text(folder_ / name,
                   fmt::format("[gbuffer]\nfile = \"{}\"\n[camera]\n{}\n{}\n", gbuffer, camera, layers));
    }

    /// The sorted names of what the folder `name` holds. Empty when there is no such folder.
    std::vector<std::string> files(const std::string& name) const {
        std::vector<std::string> names;
        if (fs::is_directory(folder_ / name))
            for (const auto& entry : fs::directory_iterator(folder_ / name)) names.push_back(entry.path().filename());
        std::ranges::sort(names);
        return names;
    }

    static std::string data_file(const std::string& name) { return (data_folder / name).string(); }

private:
    /// Commands that need a device get the one of all tests, unless a test chooses.
    static std::string on_test_device(const std::string& arguments) {
        const std::string command = arguments.substr(0, arguments.find(' '));
        const std::set<std::string> need_one{"run", "eval", "figures", "bake-volume", "bake-frame", "tune", "decals"};
        if (test_device_name().empty() || !need_one.contains(command) ||
            arguments.find("--device") != std::string::npos)
            return arguments;
        return command + " --device '" + test_device_name() + "'" + arguments.substr(command.size());
    }

    TempFolder folder_;
};

inline const std::string tilt = "[[layer]]\nname = \"tilt\"\nkind = \"constant\"\ngradient = [0.3, 0, 0]\n";
inline const std::string lit =
    "[lighting]\nrelight = \"lit\"\n[[light]]\nkind = \"sun\"\ndirection = [0.66, 0.42, -0.62]\n";

/// Expects that a run failed by itself, not by a signal, with a message of wrinkle's own that contains `parts`, and
/// printed nothing to stdout.
inline void expect_failed(const Ran& ran, const std::vector<std::string>& parts) {
    EXPECT_TRUE(ran.code == 1 || ran.code == 2) << ran.code << ": " << ran.err;
    EXPECT_TRUE(ran.err.starts_with("wrinkle: ")) << ran.err;
    EXPECT_EQ(ran.out, "");
    expect_mentions(ran.err, parts);
    for (const char* raw : {"std::", "terminate", "what()", "defect", "basic_string", "filesystem error", "CL_", "clB",
                            "clE", "exception", "json.", "Iex", "OIIO"})
        EXPECT_EQ(ran.err.find(raw), std::string::npos) << "\"" << raw << "\" of a library in: " << ran.err;
}

}  // namespace wrinkle::test
