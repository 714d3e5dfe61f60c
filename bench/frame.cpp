#include "frame.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "io/gbuffer_reader.h"
#include "run/open_frame.h"

namespace wrinkle::bench {

namespace {

/// Planes whose values are labels, never blended.
bool is_label(const std::string& plane) { return plane == "object" || plane.starts_with("crypto."); }

}  // namespace

std::map<std::string, std::span<const float>> BenchFrame::spans() const {
    std::map<std::string, std::span<const float>> spans;
    for (const auto& [name, plane] : planes) spans.emplace(name, plane);
    return spans;
}

Resampler::Resampler(const Scene& scene) : frame_(describe_frame(scene)) {
    const GBufferReader reader(scene.gbuffer.file, scene.gbuffer);
    size_ = reader.size();
    const std::vector<std::string> names = reader.planes();
    std::vector<float*> pointers;
    for (const std::string& name : names) {
        planes_[name].resize(std::size_t{size_.width} * size_.height);
        pointers.push_back(planes_[name].data());
    }
    reader.read_rows(0, size_.height, names, pointers);
    frame_.planes = {names.begin(), names.end()};
}

bool Resampler::smooth(const std::array<std::size_t, 4>& i) const {
    const auto range = [&](const std::string& plane) {
        const auto& v = planes_.at(plane);
        return std::minmax({v[i[0]], v[i[1]], v[i[2]], v[i[3]]});
    };
    const auto spread = [&](const std::string& plane) { return range(plane).second - range(plane).first; };
    const auto [near, far] = range("depth");
    return spread("object") == 0 && spread("uv.u") < 0.3f && spread("uv.v") < 0.3f && far < 1e9f && far < 2 * near;
}

std::map<std::string, std::vector<float>> Resampler::rows(Size size, std::uint32_t first, std::uint32_t count,
                                                          const std::vector<std::string>& names) const {
    std::map<std::string, std::vector<float>> out;
    std::vector<std::pair<const std::vector<float>*, float*>> planes;
    for (const std::string& name : names) {
        std::vector<float>& to = out[name];
        to.resize(std::size_t{size.width} * count);
        planes.emplace_back(&planes_.at(name), to.data());
    }
    const auto place = [](std::size_t i, std::size_t from, std::size_t to) {
        const double v = (static_cast<double>(i) + 0.5) * static_cast<double>(from) / static_cast<double>(to) - 0.5;
        return std::clamp(v, 0.0, static_cast<double>(from - 1));
    };
    const auto source = [&](std::size_t x, std::size_t y) { return y * size_.width + x; };
    for (std::size_t y = 0, i = 0; y < count; ++y) {
        const double v = place(y + first, size_.height, size.height);
        const std::size_t y0 = static_cast<std::size_t>(v), y1 = std::min<std::size_t>(y0 + 1, size_.height - 1);
        const auto fy = static_cast<float>(v - static_cast<double>(y0));
        for (std::size_t x = 0; x < size.width; ++x, ++i) {
            const double u = place(x, size_.width, size.width);
            const std::size_t x0 = static_cast<std::size_t>(u), x1 = std::min<std::size_t>(x0 + 1, size_.width - 1);
            const auto fx = static_cast<float>(u - static_cast<double>(x0));
            const std::array<std::size_t, 4> four{source(x0, y0), source(x1, y0), source(x0, y1), source(x1, y1)};
            const std::size_t nearest = source(fx < 0.5f ? x0 : x1, fy < 0.5f ? y0 : y1);
            const bool blend = smooth(four);
            for (std::size_t k = 0; k < names.size(); ++k) {
                const std::vector<float>& in = *planes[k].first;
                float value = in[nearest];
                if (blend && !is_label(names[k])) {
                    const bool reciprocal = names[k] == "depth";
                    std::array<float, 4> v4{};
                    for (std::size_t c = 0; c < 4; ++c) v4[c] = reciprocal ? 1 / in[four[c]] : in[four[c]];
                    value = std::lerp(std::lerp(v4[0], v4[1], fx), std::lerp(v4[2], v4[3], fx), fy);
                    if (reciprocal) value = 1 / value;
                }
                planes[k].second[i] = value;
            }
        }
    }
    return out;
}

BenchFrame Resampler::frame(Size size) const {
    BenchFrame out{frame_, {}};
    out.frame.size = size;
    out.planes = rows(size, 0, size.height, {frame_.planes.begin(), frame_.planes.end()});
    return out;
}

Scene without_lighting(Scene scene, const Frame& frame) {
    scene.lighting.relight = Relight::off;
    scene.lighting.lights.clear();
    scene.filter.taps = 1;
    for (Layer& layer : scene.layers)
        for (std::string& name : layer.mask.cryptomatte)
            if (const auto hash = frame.cryptomatte.find(name); hash != frame.cryptomatte.end())
                name = fmt::format("#{:08x}", hash->second);
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
