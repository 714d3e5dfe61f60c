#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "io/gbuffer_reader.h"
#include "wrinkle/camera.h"

namespace wrinkle {

/// Planes of a frame that the host looks at, those of some rows.
class ReadRows {
public:
    /// wanted: planes, or layers of them.
    ReadRows(const GBufferReader& reader, const std::vector<std::string>& wanted) : reader_(reader) {
        for (const std::string& layer : wanted)
            for (const std::string& plane : reader.planes())
                if (plane == layer || plane.starts_with(layer + ".")) names_.push_back(plane);
        for (const std::string& name : names_) planes_[name];
    }

    bool has(const std::string& plane) const { return planes_.contains(plane); }

    std::size_t read(std::uint32_t first, std::uint32_t end) {
        const std::size_t count = std::size_t{end - first} * reader_.size().width;
        std::vector<float*> into;
        for (const std::string& name : names_) {
            planes_[name].resize(count);
            into.push_back(planes_[name].data());
        }
        reader_.read_rows(first, end, names_, into);
        return count;
    }

    float at(const std::string& plane, std::size_t i) const { return planes_.at(plane)[i]; }
    Vec3 vec(const std::string& layer, const char* parts, std::size_t i) const {
        const auto part = [&](int k) { return static_cast<double>(at(layer + "." + parts[k], i)); };
        return {part(0), part(1), part(2)};
    }
    /// A part of the picture: by itself, or as direct and indirect light times a colour; black where none tells.
    Vec3 part(const std::string& name, std::size_t i) const {
        if (has(name + ".r")) return vec(name, "rgb", i);
        if (!has_parts(name)) return {};
        const Vec3 direct = vec(name + "_direct", "rgb", i), indirect = vec(name + "_indirect", "rgb", i),
                   color = vec(name + "_color", "rgb", i);
        Vec3 out{};
        for (std::size_t c = 0; c < 3; ++c) out[c] = (direct[c] + indirect[c]) * color[c];
        return out;
    }
    bool has_parts(const std::string& name) const {
        return has(name + "_direct.r") && has(name + "_indirect.r") && has(name + "_color.r");
    }

private:
    const GBufferReader& reader_;
    std::vector<std::string> names_;
    std::map<std::string, std::vector<float>> planes_;
};

}  // namespace wrinkle
