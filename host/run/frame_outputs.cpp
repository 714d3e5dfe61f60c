#include "run/frame_outputs.h"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>

#include "base/names.h"
#include "base/same_file.h"
#include "io/frame_path.h"
#include "layers/kinds.h"
#include "plan/own_gradient.h"
#include "run/output_names.h"
#include "run/shrink_rows.h"
#include "scene/check_scene.h"
#include "wrinkle/error.h"

namespace wrinkle {

namespace fs = std::filesystem;

namespace {

/// Channel name of an output plane. Components as .X .Y .Z, .XX .XY .YY: other programs show those as layers.
std::string channel_name(const std::string& of_pass, const Scene& scene) {
    constexpr std::string_view normal = "normal.";
    const ChannelNames names = scene.output.channel_names;
    std::string plane = of_pass;
    if (const auto layer = layer_of_output(plane))
        plane = "gradient." + scene.layers.at(*layer).name + plane.substr(plane.rfind('.'));
    if (names == ChannelNames::passes) return plane.starts_with(normal) ? "N." + plane.substr(normal.size()) : plane;
    std::string name = plane;
    for (std::size_t i = plane.rfind('.'); i < plane.size(); ++i)
        name[i] = static_cast<char>(std::toupper(static_cast<unsigned char>(name[i])));
    return name;
}

/// When the frame was made. OpenImageIO would take the time of writing, and no two files would be the same.
std::string date_of(const GBufferReader& reader) {
    if (const auto date = reader.metadata().text("DateTime")) return *date;
    struct stat status {};
    const bool known = ::stat(reader.path().c_str(), &status) == 0;
    return fmt::format("{:%Y:%m:%d %H:%M:%S}", fmt::gmtime(known ? status.st_mtim.tv_sec : 0));
}

Metadata header_of(const Scene& scene, const GBufferReader& reader, bool passthrough) {
    Metadata metadata = passthrough ? reader.metadata() : Metadata();
    metadata.set("DateTime", date_of(reader));
    metadata.set("Software", "wrinkle");
    metadata.set("wrinkle/gbuffer", reader.path().filename().string());
    if (!scene.file.empty()) metadata.set("wrinkle/scene", scene.file.filename().string());
    std::string layers;
    for (const Layer& layer : scene.layers) layers += (layers.empty() ? "" : ", ") + layer.name;
    metadata.set("wrinkle/layers", layers);
    return metadata;
}

/// A window of a picture that has one pixel where this has scale x scale.
FrameWindow shrunk(const FrameWindow& window, std::uint32_t scale) {
    const auto times = static_cast<int>(scale);
    return {window.x / times, window.y / times, {window.display.width / scale, window.display.height / scale}};
}

/// Throws Error where files that a scene wants would hold planes of two sizes.
void check_sizes(const Scene& scene, const GBufferReader& reader, const OutputNames& names) {
    if (reader.beauty_scale() == 1) return;
    const std::string sizes = fmt::format("{}: its beauty has one pixel where it has {} x {}", reader.path().string(),
                                          reader.beauty_scale(), reader.beauty_scale());
    if (names.is_single() && names.is_lit() && !scene.output.beauty_size)
        throw Error(sizes +
                    ", so one file cannot hold both normals and light; set size = \"beauty\" in [output], or put "
                    "<picture> into its name");
    if (scene.output.passthrough && scene.output.beauty_size)
        throw Error(sizes +
                    ", so what passthrough copies does not fit size = \"beauty\" in [output]; leave one of them "
                    "out");
}

}  // namespace

std::vector<fs::path> inputs_of(const Scene& scene, const GBufferReader& reader, int frame) {
    std::vector<fs::path> inputs = scene::files_of(layer_kinds(), scene);
    for (fs::path& file : inputs) file = frame_path(file, frame);
    inputs.push_back(reader.path());
    return inputs;
}

void check_outputs(const Scene& scene, const GBufferReader& reader, const fs::path& directory,
                   std::optional<int> frame) {
    const std::vector<fs::path> inputs = inputs_of(scene, reader, frame.value_or(0));
    for (const fs::path& file : OutputNames(scene, directory, frame).all()) refuse_to_replace(file, inputs);
}

FrameOutputs::FrameOutputs(const Scene& scene, const Pass::Impl& pass, const GBufferReader& reader,
                           const fs::path& directory, std::optional<int> frame, const std::string& provenance) {
    std::error_code failed;
    fs::create_directories(directory, failed);
    if (failed) throw Error(fmt::format("cannot make the output folder {}: {}", directory.string(), failed.message()));
    const Output& output = scene.output;
    const Metadata metadata = header_of(scene, reader, output.passthrough);
    const OutputNames names(scene, directory, frame);
    check_sizes(scene, reader, names);
    width_ = pass.size.width;
    const std::uint32_t lit_scale = reader.beauty_scale(), data_scale = output.beauty_size ? lit_scale : 1;
    const auto add = [&](const fs::path& path, std::uint32_t scale, std::vector<std::string> planes,
                         std::vector<std::string> channels, PngEncoding encoding, std::set<std::string> full = {},
                         std::set<std::string> whole = {}) {
        ImageOptions options{.half = output.half,
                             .full = std::move(full),
                             .whole = std::move(whole),
                             .compression = output.compression,
                             .window = shrunk(reader.window(), scale),
                             .metadata = metadata,
                             .provenance = provenance,
                             .png = encoding,
                             .png_bits = output.png,
                             .exposure = scene.lighting.exposure};
        const Size size{pass.size.width / scale, pass.size.height / scale};
        files_.push_back(
            {path, std::move(planes), ImageWriter(path, size, std::move(channels), std::move(options)), scale});
    };

    std::vector<std::string> planes, channels;
    for (const std::string& plane : pass.plan.outputs) {
        if (plane.starts_with("lit.")) continue;
        planes.push_back("out:" + plane);
        channels.push_back(channel_name(plane, scene));
    }
    if (output.condition) {
        planes.push_back("out:condition");
        channels.push_back("condition");
    }
    const std::vector<std::string> lit{"out:lit.r", "out:lit.g", "out:lit.b"}, colors{"R", "G", "B"};
    std::vector<std::string> with_alpha, colors_alpha;
    if (names.is_lit()) with_alpha = lit, colors_alpha = colors;
    if (scene.lighting.relight == Relight::ratio && reader.has_plane("beauty.a")) {
        passed_.emplace_back("beauty.a");  // colours are premultiplied, so factors leave it as it is
        with_alpha.push_back(passed_.back()), colors_alpha.emplace_back("A");
    }
    if (names.is_single()) {
        planes.insert(planes.end(), with_alpha.begin(), with_alpha.end());
        channels.insert(channels.end(), colors_alpha.begin(), colors_alpha.end());
    }
    std::set<std::string> full;   // depths, positions and ids of the input do not survive as half
    std::set<std::string> whole;  // integers, whose upper bits do not survive as floats
    if (output.passthrough) {
        std::set<std::string> replaced;  // the old normals too: who reads the file shall find the new ones
        for (const std::string& channel : channels) replaced.insert(lower(channel));
        for (const auto& [plane, channel] : reader.roles().channel_of)
            if (plane.starts_with("normal.")) replaced.insert(lower(channel));
        for (const std::string& channel : reader.channels()) {
            if (replaced.contains(lower(channel))) continue;
            const bool integers = reader.channel_type(channel) == ChannelType::whole;
            passed_.push_back((integers ? "bits:" : "channel:") + channel);
            if (integers) whole.insert(channel);
            planes.push_back(passed_.back());
            channels.push_back(channel);
            full.insert(channel);
        }
    }
    add(names.exr("normal"), data_scale, planes, channels, PngEncoding::linear, std::move(full), std::move(whole));
    if (names.is_lit() && !names.is_single())
        add(names.exr("lit"), lit_scale, with_alpha, colors_alpha, PngEncoding::linear);
    if (names.wants("normal"))
        add(names.png("normal"), data_scale, {"out:normal.x", "out:normal.y", "out:normal.z"}, colors,
            PngEncoding::normal);
    if (names.wants("lit")) add(names.png("lit"), lit_scale, lit, colors, PngEncoding::srgb);
    if (names.wants("before"))
        add(names.png("before"), lit_scale, {"beauty.r", "beauty.g", "beauty.b"}, colors, PngEncoding::srgb);
}

FrameOutputs FrameOutputs::single(const fs::path& file, const Scene& scene, const Pass::Impl& pass,
                                  const GBufferReader& reader, const std::string& provenance) {
    const Output& output = scene.output;
    ImageOptions options;
    options.half = output.half;
    options.compression = output.compression;
    options.window = reader.window();
    options.metadata = header_of(scene, reader, false);
    options.provenance = provenance;
    options.metadata.set("wrinkle/space", "world");
    std::vector<std::string> planes, channels;
    for (const std::string& plane : pass.plan.outputs) {
        planes.push_back("out:" + plane);
        channels.push_back(channel_name(plane, scene));
    }
    FrameOutputs outputs;
    outputs.files_.push_back(
        {file, std::move(planes), ImageWriter(file, pass.size, std::move(channels), std::move(options))});
    return outputs;
}

void FrameOutputs::write(std::uint32_t begin, std::uint32_t end, const std::map<std::string, const float*>& planes) {
    for (File& file : files_) {
        std::vector<const float*> rows;
        for (const std::string& plane : file.planes) rows.push_back(planes.at(plane));
        if (file.scale == 1) {
            file.writer.write_rows(begin, end, rows);
            continue;
        }
        const std::vector<std::vector<float>> few = shrink_rows(file.planes, rows, width_, end - begin, file.scale);
        std::ranges::transform(few, rows.begin(), [](const std::vector<float>& plane) { return plane.data(); });
        file.writer.write_rows(begin / file.scale, end / file.scale, rows);
    }
}

void FrameOutputs::finish(std::vector<fs::path>& files) {
    for (File& file : files_) file.writer.complete();  // a full disk shows here, while every old file is in place
    for (File& file : files_) {
        file.writer.finish();
        files.push_back(file.path);
    }
}

}  // namespace wrinkle
