#pragma once

#include "tests/reference/stored.h"
#include "tests/run/run_frame.h"

/// Frames whose planes are stored as engines hold them, beside what they then hold.
namespace wrinkle::test {

struct StoredFrame {
    HostFrame decoded;  ///< the numbers that the stored ones stand for, in planes of floats
    Frame frame;
    std::map<std::string, std::vector<std::byte>> memory;

    /// `formats` have strides and memories, but for planes that are alone.
    StoredFrame(const HostFrame& given, const PlaneFormats& formats) : decoded(given), frame(given.frame) {
        frame.formats = formats;
        const bool octahedral = formats.contains("normal.x") && bytes_of(formats.at("normal.x").encoding) != 0 &&
                                (formats.at("normal.x").encoding == PlaneEncoding::octahedral8 ||
                                 formats.at("normal.x").encoding == PlaneEncoding::octahedral16);
        for (auto& [name, plane] : decoded.pixels) {
            const auto found = formats.find(name);
            const PlaneFormat format = found == formats.end() ? PlaneFormat{} : found->second;
            auto& into = memory[format.memory.empty() ? name : format.memory];
            const std::uint32_t stride = format.stride == 0 ? bytes_of(format.encoding) : format.stride;
            into.resize(given.count() * stride, std::byte{0x5a});
            if (octahedral && name.starts_with("normal.")) continue;
            for (std::size_t i = 0; i < plane.size(); ++i) {
                const double number = (static_cast<double>(plane[i]) - format.bias) / format.scale;
                const std::uint32_t bits = reference::encoded(format.encoding, number);
                reference::put(into, format, i, bits);
                plane[i] = static_cast<float>(reference::decoded(format.encoding, bits) * format.scale + format.bias);
            }
        }
        if (!octahedral) return;
        const PlaneFormat& format = formats.at("normal.x");
        for (std::size_t i = 0; i < given.count(); ++i) {
            const std::uint32_t bits = reference::encoded_normal(format.encoding, vec_at(given.pixels, "normal", i));
            reference::put(memory.at(format.memory), format, i, bits);
            const V n = reference::decoded_normal(format.encoding, bits);
            decoded.pixels.at("normal.x")[i] = static_cast<float>(n.x);
            decoded.pixels.at("normal.y")[i] = static_cast<float>(n.y);
            decoded.pixels.at("normal.z")[i] = static_cast<float>(n.z);
        }
    }

    HostBytes planes() const { return {memory.begin(), memory.end()}; }
};

/// Runs a pass whose outputs are floats on the stored planes.
inline Pixels run(Pass& pass, const StoredFrame& frame) {
    Pixels out;
    HostByteOutputs spans;
    for (const std::string& name : pass.outputs()) {
        out[name] = std::vector<float>(frame.decoded.count(), -77);
        spans[name] = std::as_writable_bytes(std::span(out[name]));
    }
    pass.run(frame.planes(), spans);
    return out;
}

inline PlaneFormats merged(std::initializer_list<PlaneFormats> all) {
    PlaneFormats out;
    for (const PlaneFormats& each : all) out.insert(each.begin(), each.end());
    return out;
}

}  // namespace wrinkle::test
