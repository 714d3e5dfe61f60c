#include "frame.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "io/gbuffer_reader.h"
#include "run/render.h"

namespace wrinkle::bench {

namespace {

/// Planes whose values are labels, never blended.
bool is_label(const std::string& plane) { return plane == "object" || plane.starts_with("crypto."); }

struct Source {
    Size size;
    std::map<std::string, std::vector<float>> planes;

    std::size_t at(std::size_t x, std::size_t y) const { return y * size.width + x; }

    /// Whether four pixels may be blended.
    bool smooth(const std::array<std::size_t, 4>& i) const {
        const auto spread = [&](const std::string& plane) {
            const auto& v = planes.at(plane);
            const auto [low, high] = std::minmax({v[i[0]], v[i[1]], v[i[2]], v[i[3]]});
            return high - low;
        };
        const auto& depth = planes.at("depth");
        const auto [near, far] = std::minmax({depth[i[0]], depth[i[1]], depth[i[2]], depth[i[3]]});
        return spread("object") == 0 && spread("uv.u") < 0.3f && spread("uv.v") < 0.3f && far < 1e9f && far < 2 * near;
    }
};

}  // namespace

std::map<std::string, std::span<const float>> BenchFrame::spans() const {
    std::map<std::string, std::span<const float>> spans;
    for (const auto& [name, plane] : planes) spans.emplace(name, plane);
    return spans;
}

BenchFrame resampled_frame(const Scene& scene, Size size) {
    BenchFrame out;
    out.frame = describe_frame(scene);
    const GBufferReader reader(scene.gbuffer.file, scene.gbuffer);
    Source source{reader.size(), {}};
    const std::vector<std::string> names = reader.planes();
    std::vector<float*> pointers;
    for (const std::string& name : names) {
        source.planes[name].resize(std::size_t{source.size.width} * source.size.height);
        out.planes[name].resize(std::size_t{size.width} * size.height);
        pointers.push_back(source.planes[name].data());
    }
    reader.read_rows(0, source.size.height, names, pointers);

    out.frame.size = size;
    out.frame.planes = {names.begin(), names.end()};
    const auto place = [](std::size_t i, std::size_t from, std::size_t to) {
        const double v = (static_cast<double>(i) + 0.5) * static_cast<double>(from) / static_cast<double>(to) - 0.5;
        return std::clamp(v, 0.0, static_cast<double>(from - 1));
    };
    for (std::size_t y = 0, i = 0; y < size.height; ++y) {
        const double v = place(y, source.size.height, size.height);
        const std::size_t y0 = static_cast<std::size_t>(v), y1 = std::min<std::size_t>(y0 + 1, source.size.height - 1);
        const auto fy = static_cast<float>(v - static_cast<double>(y0));
        for (std::size_t x = 0; x < size.width; ++x, ++i) {
            const double u = place(x, source.size.width, size.width);
            const std::size_t x0 = static_cast<std::size_t>(u),
                              x1 = std::min<std::size_t>(x0 + 1, source.size.width - 1);
            const auto fx = static_cast<float>(u - static_cast<double>(x0));
            const std::array<std::size_t, 4> four{source.at(x0, y0), source.at(x1, y0), source.at(x0, y1),
                                                  source.at(x1, y1)};
            const std::size_t nearest = source.at(fx < 0.5f ? x0 : x1, fy < 0.5f ? y0 : y1);
            const bool smooth = source.smooth(four);
            for (const std::string& name : names) {
                const std::vector<float>& in = source.planes[name];
                float value = in[nearest];
                if (smooth && !is_label(name)) {
                    const bool reciprocal = name == "depth";
                    std::array<float, 4> v4{};
                    for (std::size_t k = 0; k < 4; ++k) v4[k] = reciprocal ? 1 / in[four[k]] : in[four[k]];
                    value = std::lerp(std::lerp(v4[0], v4[1], fx), std::lerp(v4[2], v4[3], fx), fy);
                    if (reciprocal) value = 1 / value;
                }
                out.planes[name][i] = value;
            }
        }
    }
    return out;
}

Scene without_lighting(Scene scene, const Frame& frame) {
    scene.lighting.relight = Relight::off;
    scene.lighting.lights.clear();
    for (Layer& layer : scene.layers)
        if (layer.mask.cryptomatte)
            if (const auto hash = frame.cryptomatte.find(*layer.mask.cryptomatte); hash != frame.cryptomatte.end())
                layer.mask.cryptomatte = fmt::format("#{:08x}", hash->second);
    return scene;
}

PlaneBuffers upload(const Device& device, const BenchFrame& frame, const std::vector<std::string>& names) {
    PlaneBuffers buffers(device, names, frame.pixels(), sizeof(float));
    for (const std::string& name : names) {
        const std::vector<float>& plane = frame.planes.at(name);
        std::memcpy(buffers.map<float>(name, CL_MAP_WRITE), plane.data(), plane.size() * sizeof(float));
    }
    buffers.unmap();
    return buffers;
}

}  // namespace wrinkle::bench
