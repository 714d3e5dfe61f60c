#include "tools/draw_figure.h"

#include <algorithm>
#include <cmath>

#include "device/guarded.h"
#include "io/camera_file.h"
#include "io/gbuffer_reader.h"
#include "io/image_writer.h"
#include "io/montage.h"
#include "io/whole_planes.h"
#include "run/condition.h"
#include "run/open_frame.h"
#include "tools/frame_lights.h"
#include "tools/metal_pictures.h"
#include "tools/render.h"

namespace wrinkle {

namespace {

using Planes = std::map<std::string, std::vector<float>>;

Planes read_planes(const GBufferReader& reader, const std::vector<std::string>& names) {
    reader.require(names);
    return io::read_whole_planes(reader, names);
}

/// What a panel shows, whole frame, and how a PNG holds it.
struct Shown {
    Planes planes;
    std::array<const char*, 3> names;
    PngEncoding encoding = PngEncoding::srgb;
};

/// Condition as a grey, per whole frame.
Planes show_condition(const Device& device, const Scene& scene, const GBufferReader& reader,
                      const FrameCamera& camera) {
    constexpr float kWhite = 6;  // powers of ten
    const Size size = reader.size();
    Condition condition(device, scene, frame_of(scene, reader, camera));
    const Planes in = read_planes(reader, condition.inputs());
    PlaneBuffers buffers(device, condition.inputs(), std::size_t{size.width} * size.height, sizeof(float));
    for (const auto& [name, plane] : in) std::ranges::copy(plane, buffers.map<float>(name, CL_MAP_WRITE));
    buffers.unmap();
    std::vector<float> grey = condition.evaluate(buffers, {.first = 0, .count = size.height});
    for (float& v : grey) v = std::log10(std::max(v, 1.0f)) / kWhite;
    return {{"condition", std::move(grey)}};
}

Shown show(const Device& device, const Scene& scene, const GBufferReader& reader, const FrameCamera& camera,
           PanelPicture picture) {
    if (picture == PanelPicture::before)
        return {read_planes(reader, {"beauty.r", "beauty.g", "beauty.b"}), {"beauty.r", "beauty.g", "beauty.b"}};
    if (picture == PanelPicture::condition)
        return {show_condition(device, scene, reader, camera),
                {"condition", "condition", "condition"},
                PngEncoding::linear};
    Scene lit = wants_lights(scene) ? with_lights(scene, find_lights(scene, 0)) : scene;
    if (wants_metals(lit)) lit = with_metals(lit, metals_of_frame(lit, 0));
    Pass pass = evaluate(device, lit, frame_of(scene, reader, camera));
    const Planes in = read_planes(reader, pass.inputs());
    Planes out;
    HostOutputs spans;
    for (const std::string& name : pass.outputs())
        spans[name] = out[name] = std::vector<float>(std::size_t{reader.size().width} * reader.size().height);
    pass.run({in.begin(), in.end()}, spans);
    pass.impl().save();
    if (picture == PanelPicture::normal)
        return {std::move(out), {"normal.x", "normal.y", "normal.z"}, PngEncoding::normal};
    return {std::move(out), {"lit.r", "lit.g", "lit.b"}};
}

/// The part of a frame that `crop` names, one pixel at least.
MontagePart cut(const Shown& shown, Size frame, const std::array<double, 4>& crop, float exposure) {
    const auto from = [](double share, std::uint32_t count) {
        return std::min(static_cast<std::uint32_t>(std::floor(share * count)), count - 1);
    };
    const auto to = [](double share, std::uint32_t count, std::uint32_t least) {
        return std::clamp(static_cast<std::uint32_t>(std::lround(share * count)), least, count);
    };
    const std::uint32_t left = from(crop[0], frame.width), right = to(crop[2], frame.width, left + 1);
    const std::uint32_t top = from(crop[1], frame.height), bottom = to(crop[3], frame.height, top + 1);
    MontagePart part{{right - left, bottom - top}, {}, {}};
    for (std::uint32_t y = top; y < bottom; ++y)
        for (std::uint32_t x = left; x < right; ++x)
            for (const char* name : shown.names)
                part.rgb.push_back(
                    png_value(shown.planes.at(name)[std::size_t{y} * frame.width + x], shown.encoding, exposure));
    return part;
}

}  // namespace

void draw_figure(const Device& device, const Figure& figure, const std::filesystem::path& file) {
    guarded("draw a figure", [&] {
        GBufferReader reader(figure.scene.gbuffer.file, figure.scene.gbuffer);
        const FrameCamera camera = camera_of_frame(figure.scene, reader, 0);
        const auto exposure = static_cast<float>(std::exp2(figure.scene.lighting.exposure));
        std::vector<MontagePart> parts;
        for (const Panel& panel : figure.panels) {
            const Shown shown = show(device, panel_scene(figure, panel), reader, camera, panel.picture);
            parts.push_back(cut(shown, reader.size(), figure.crop, exposure));
            parts.back().caption = panel.caption;
        }
        write_montage(file, parts, figure.columns);
    });
}

}  // namespace wrinkle
