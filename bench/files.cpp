#include <OpenImageIO/imageio.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <cstdlib>
#include <fstream>

#include "contests.h"
#include "error.h"
#include "plain_files.h"
#include "resident.h"
#include "shell.h"
#include "temporary_folder.h"
#include "wrinkle/error.h"

namespace wrinkle::bench {

namespace {

namespace fs = std::filesystem;

constexpr int kChannels = 27;

constexpr const char* kLit =
    "[lighting]\nrelight = \"lit\"\n[[light]]\nkind = \"sun\"\ndirection = [0.66, 0.42, -0.62]\n";

/// Values that compress like a rendered pass: smooth, a little grain, and no more digits than a half has.
float other_pass(int channel, std::size_t x, std::size_t y) {
    const std::uint32_t grain = static_cast<std::uint32_t>(x * 0x9e3779b1u ^ y * 0x85ebca6bu) * 0x27d4eb2du >> 30;
    const float smooth = 0.5F + 0.3F * std::sin(0.002F * static_cast<float>(x) * static_cast<float>(channel));
    return (std::floor(1024 * smooth) + static_cast<float>(grain)) / 1024;
}

/// Writes a ZIP EXR of 27 float channels: depth, normals, texture coordinates, and passes that the scene does not need.
void write_frame(const fs::path& file, const BenchFrame& frame) {
    const Size size = frame.frame.size;
    const std::pair<const char*, const char*> known[] = {{"N.X", "normal.x"}, {"N.Y", "normal.y"}, {"N.Z", "normal.z"},
                                                         {"UV.U", "uv.u"},    {"UV.V", "uv.v"},    {"Z", "depth"}};
    OIIO::ImageSpec spec(static_cast<int>(size.width), static_cast<int>(size.height), kChannels, OIIO::TypeDesc::FLOAT);
    spec.attribute("compression", "zip");
    spec.channelnames.clear();
    std::vector<float> pixels(frame.pixels() * kChannels);
    for (int c = 0; c < kChannels; ++c) {
        const bool given = c < static_cast<int>(std::size(known));
        spec.channelnames.push_back(given ? known[c].first : fmt::format("pass{:02}.{}", c / 3, "RGB"[c % 3]));
        const float* plane = given ? frame.planes.at(known[c].second).data() : nullptr;
        for (std::size_t i = 0; i < frame.pixels(); ++i)
            pixels[i * kChannels + static_cast<std::size_t>(c)] =
                given ? plane[i] : other_pass(c, i % size.width, i / size.width);
    }
    const auto out = OIIO::ImageOutput::create(file.string());
    if (!out || !out->open(file.string(), spec) || !out->write_image(OIIO::TypeDesc::FLOAT, pixels.data()))
        throw Error(fmt::format("cannot write {}", file.string()));
}

/// The channels PREFIX.X and so on.
Normals read_normals(const fs::path& file, std::size_t pixels, const std::string& prefix = "normal") {
    const auto in = OIIO::ImageInput::open(file.string());
    Normals n(pixels);
    if (!in) throw Error(fmt::format("cannot read {}", file.string()));
    const std::vector<std::string>& names = in->spec().channelnames;
    std::vector<float> all(pixels * names.size());
    in->read_image(0, 0, 0, -1, OIIO::TypeDesc::FLOAT, all.data());
    for (auto [axis, plane] : {std::pair{".X", &n.x}, {".Y", &n.y}, {".Z", &n.z}}) {
        std::size_t c = 0;
        while (c < names.size() && names[c] != prefix + axis) ++c;
        if (c == names.size())
            throw Error(fmt::format("{} holds {}, no normals", file.string(), fmt::join(names, ", ")));
        for (std::size_t i = 0; i < pixels; ++i) (*plane)[i] = all[i * names.size() + c];
    }
    return n;
}

}  // namespace

void measure_files(Size size, Run& run) {
    if (std::system("oiiotool --help >/dev/null 2>&1") != 0) {
        fmt::print("files: not measured, there is no oiiotool (package openimageio-tools)\n");
        return;
    }
    const fs::path data = WRINKLE_SOURCE_DIR "/data";
    const TemporaryFolder folder;
    const fs::path exr = folder.path() / "frame.exr";
    const BenchFrame frame = Resampler(load_scene(data / "scenes/courtyard.toml")).frame(size);
    write_frame(exr, frame);
    const auto run_of = [&](const std::string& name, const std::string& more) {
        const fs::path scene = folder.path() / (name + ".toml");
        std::ofstream(scene) << "[gbuffer]\nfile = \"frame.exr\"\ndepth = \"planar\"\n[camera]\nfile = \""
                             << (data / "gbuffer/courtyard.camera.json").string()
                             << "\"\n[[layer]]\nkind = \"height_map\"\ntexture = \""
                             << (data / "textures/weave_normal.png").string()
                             << "\"\nscale = 0.002\nuv = { scale = 12 }\n"
                             << more;
        return fmt::format("'{}' run '{}' -o '{}' --quiet", WRINKLE_CLI, scene.string(),
                           (folder.path() / name).string());
    };
    const std::string wrinkle_run = run_of("resolve", "[output]\npng = false\n");
    const std::string pictures = run_of("pictures", kLit),
                      passes = run_of("passes", "[output]\npng = false\npassthrough = true\n");
    const std::string copy =
        fmt::format("oiiotool -i:ch=N.X,N.Y,N.Z,UV.U,UV.V,Z '{}' --ch N.X,N.Y,N.Z --compression zip -o '{}'",
                    exr.string(), (folder.path() / "copied.exr").string());
    const std::string copy_all =
        fmt::format("oiiotool '{}' --compression zip -o '{}'", exr.string(), (folder.path() / "all.exr").string());
    call(pictures);
    PlainFiles plain(exr, {"N.X", "N.Y", "N.Z", "UV.U", "UV.V", "Z"}, folder.path() / "pictures");
    std::vector<Contender> contenders{
        {"wrinkle run", [&] { call(wrinkle_run); }}, {"oiiotool", [&] { call(copy); }},
        {"with pictures", [&] { call(pictures); }},  {"plain files", [&] { plain.run(folder.path() / "plain"); }},
        {"with passes", [&] { call(passes); }},      {"oiiotool, all", [&] { call(copy_all); }}};
    race(contenders, few(run.rounds));

    const Scene scene = load_scene(folder.path() / "resolve.toml");
    const ReferenceSample reference(scene, frame, kErrorSamples, kSeed);
    Measurement m{.group = "files",
                  .name = "resolve",
                  .variant = "wrinkle run",
                  .pixels = frame.pixels(),
                  .seconds = contenders[0].seconds,
                  .bytes = 4.0 * (kChannels + 3)};
    m.error = reference.compare(read_normals(folder.path() / "resolve/normal.exr", frame.pixels()));
    run.measurements.push_back(m);
    m.variant = "oiiotool", m.seconds = contenders[1].seconds;
    const Normals copied = read_normals(folder.path() / "copied.exr", frame.pixels(), "N");
    m.error = {}, m.error.samples = frame.pixels();
    for (std::size_t i = 0; i < frame.pixels(); ++i)
        m.error.not_finite += copied.x[i] == frame.planes.at("normal.x")[i] ? 0 : 1;
    run.measurements.push_back(m);

    m.bytes = 0;  // of several files, not counted
    const auto add = [&](const char* name, const char* variant, const Contender& contender, const fs::path& normals) {
        m.name = name, m.variant = variant, m.seconds = contender.seconds;
        m.error = reference.compare(read_normals(folder.path() / normals, frame.pixels()));
        run.measurements.push_back(m);
    };
    add("pictures", "wrinkle run", contenders[2], "pictures/normal.exr");
    add("pictures", "OpenEXR and libpng", contenders[3], "plain/normal.exr");
    add("all passes", "wrinkle run", contenders[4], "passes/normal.exr");
    m.name = "all passes", m.variant = "oiiotool", m.seconds = contenders[5].seconds, m.error = {};
    run.measurements.push_back(m);
}

}  // namespace wrinkle::bench
