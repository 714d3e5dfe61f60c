#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>

#include "base/atomic_file.h"
#include "cli/commands.h"
#include "io/image_writer.h"
#include "tools/bake.h"

namespace wrinkle::cli {

namespace {

constexpr std::uint32_t kBandPixels = 1u << 18, kBlockRows = 16;  // whole ZIP blocks

struct BakeArguments {
    std::string kind;
    std::filesystem::path output;
    int size = 64;
    std::uint32_t width = 512, height = 512;
    std::string device;
};

void bake_a_volume(const BakeArguments& arguments) {
    const BakedVolume kind = arguments.kind == "noise"    ? BakedVolume::noise
                             : arguments.kind == "golden" ? BakedVolume::golden
                                                          : BakedVolume::golden_gradient;
    check_volume_name(arguments.output, kind == BakedVolume::golden_gradient ? 3 : 1);
    DenseVolume volume = bake_volume(Device::open(arguments.device), kind, arguments.size);
    volume.half = true;
    save_volume(arguments.output, volume);
    fmt::print("{}: grid \"{}\", {}^3 voxels\n", arguments.output.string(), volume.grid, arguments.size);
}

void bake_a_frame(const BakeArguments& arguments) {
    const Size size{arguments.width, arguments.height};
    const Camera camera =
        Camera::look_at({3, -13, 6}, {0, 0, 0}, {0, 0, 1}, 0.75, static_cast<double>(size.width) / size.height);
    const Device device = Device::open(arguments.device);
    const std::uint32_t band = std::max<std::uint32_t>(kBandPixels / size.width / kBlockRows, 1) * kBlockRows;
    std::optional<ImageWriter> writer;
    for (std::uint32_t row = 0; row < size.height; row += band) {
        const std::uint32_t end = std::min(row + band, size.height);
        const auto planes = bake_golden_rows(device, camera, size, row, end);
        std::vector<std::string> names;
        std::vector<const float*> pixels;
        for (const auto& [name, values] : planes) names.push_back(name), pixels.push_back(values.data());
        if (!writer) writer.emplace(arguments.output, size, names);
        writer->write_rows(row, end, pixels);
    }
    ImageWriter& image = *writer;
    image.complete();
    std::filesystem::path camera_file = arguments.output;
    camera_file.replace_extension(".camera.json");
    AtomicFile json(camera_file);
    json.write(
        nlohmann::json{{"width", size.width}, {"height", size.height}, {"view", camera.view}, {"proj", camera.proj}}
            .dump(1) +
        "\n");
    json.sync();
    image.finish();
    json.commit();
    fmt::print("{}, {}\n", arguments.output.string(), camera_file.string());
}

}  // namespace

void add_bake(CLI::App& app) {
    auto arguments = std::make_shared<BakeArguments>();
    CLI::App* volume = app.add_subcommand("bake-volume", "Write a volume made from a formula (.vdb or .nvdb)");
    volume->add_option("KIND", arguments->kind, "noise, golden (a level set) or golden-gradient (vectors)")
        ->required()
        ->check(CLI::IsMember({"noise", "golden", "golden-gradient"}));
    volume->add_option("-o,--output", arguments->output, "the file to write")->required();
    volume->add_option("--size", arguments->size, "voxels along an edge")
        ->capture_default_str()
        ->check(CLI::Range(8, 1024));
    volume->add_option("--device", arguments->device, "OpenCL device; see \"wrinkle devices\"");
    volume->callback([arguments] { bake_a_volume(*arguments); });

    CLI::App* frame = app.add_subcommand(
        "bake-frame",
        "Write a G-buffer of the golden-ratio surface: depth, position and exact normals, and its camera");
    frame->add_option("-o,--output", arguments->output, "the EXR file to write; FILE.camera.json is put beside it")
        ->required();
    frame->add_option("--width", arguments->width, "pixels")->capture_default_str()->check(CLI::Range(1, 16384));
    frame->add_option("--height", arguments->height, "pixels")->capture_default_str()->check(CLI::Range(1, 16384));
    frame->add_option("--device", arguments->device, "OpenCL device; see \"wrinkle devices\"");
    frame->callback([arguments] { bake_a_frame(*arguments); });
}

}  // namespace wrinkle::cli
