#include "stored_pass.h"

#include <bit>
#include <cmath>
#include <cstring>

#include "plan/stored_planes.h"
#include "run/pass_impl.h"
#include "tests/reference/stored.h"

namespace wrinkle::bench {

namespace {

using Vector = reference::Vec<double>;
using enum PlaneEncoding;

/// The nearest IEEE half.
std::uint16_t half_of(float v) {
    const auto bits = std::bit_cast<std::uint32_t>(v);
    const float size = std::abs(v);
    const auto sign = static_cast<std::uint16_t>(bits >> 16 & 0x8000u);
    if (!(size < 65520)) return static_cast<std::uint16_t>(sign | 0x7c00u);
    if (size < 6.103515625e-05F)  // denormal halves are multiples of 2^-24
        return static_cast<std::uint16_t>(sign | static_cast<std::uint32_t>(std::nearbyint(size * 16777216.0F)));
    const std::uint32_t magnitude = (bits & 0x7fffffffu) - (112u << 23);
    return static_cast<std::uint16_t>(sign | (magnitude + 0xfffu + (magnitude >> 13 & 1u)) >> 13);
}

std::uint32_t bits_of(PlaneEncoding encoding, float v) {
    return encoding == half ? half_of(v) : std::bit_cast<std::uint32_t>(v);
}

void pack(std::byte* memory, const PlaneFormat& format, const BenchFrame& frame, const std::string& plane) {
    const std::uint32_t bytes = bytes_of(format.encoding);
    const std::vector<float>& values = frame.planes.at(plane);
    for (std::size_t i = 0; i < frame.pixels(); ++i) {
        const std::uint32_t bits = format.encoding == octahedral16
                                       ? reference::encoded_normal(octahedral16, vector_at(frame, "normal.", i))
                                       : bits_of(format.encoding, values[i]);
        std::memcpy(memory + i * format.stride + format.offset, &bits, bytes);
    }
}

/// The number that a memory holds of a plane.
double number_at(const std::byte* memory, const PlaneFormat& format, std::size_t i) {
    std::uint32_t bits = 0;
    std::memcpy(&bits, memory + i * format.stride + format.offset, bytes_of(format.encoding));
    return reference::decoded(format.encoding, bits);
}

PassOptions options(const StoredWay& way) {
    PassOptions out;
    out.output_formats = way.out;
    return out;
}

Frame stored(Frame frame, const StoredWay& way) {
    frame.formats = way.in;
    return frame;
}

}  // namespace

Vector vector_at(const BenchFrame& frame, const std::string& role, std::size_t i) {
    return {frame.planes.at(role + "x")[i], frame.planes.at(role + "y")[i], frame.planes.at(role + "z")[i]};
}

PlaneFormats united(std::initializer_list<PlaneFormats> all) {
    PlaneFormats out;
    for (const PlaneFormats& each : all) out.insert(each.begin(), each.end());
    return out;
}

PlaneFormats planar(PlaneEncoding encoding, const std::vector<std::string>& planes) {
    PlaneFormats out;
    for (const std::string& plane : planes) out[plane] = {.encoding = encoding};
    return out;
}

StoredPass::StoredPass(const Device& device, const Scene& scene, const BenchFrame& frame, const StoredWay& way)
    : pass(evaluate(device, scene, stored(frame.frame, way), options(way))) {
    const Plan& plan = pass.impl().plan;
    const auto bytes = [](const PlaneFormats& formats) {
        return [&formats](const std::string& name) { return std::size_t{pixel_bytes(name, formats)}; };
    };
    in = PlaneBuffers(device, pass.inputs(), frame.pixels(), bytes(plan.formats));
    out = PlaneBuffers(device, pass.outputs(), frame.pixels(), bytes(plan.output_formats));
    for (const std::string& name : pass.inputs()) {
        auto* memory = in.map<std::byte>(name, CL_MAP_WRITE);
        std::memset(memory, 0, frame.pixels() * pixel_bytes(name, plan.formats));
        for (const std::string& plane : plan.inputs) {
            const auto found = plan.formats.find(plane);
            const PlaneFormat format =
                found == plan.formats.end() ? PlaneFormat{.stride = 4, .memory = plane} : found->second;
            if (format.memory == name) pack(memory, format, frame, plane);
        }
    }
    in.unmap();
}

StoredVectors::StoredVectors(PlaneBuffers& buffers, const PlaneFormats& formats, std::string x) {
    for (const char axis : {'x', 'y', 'z'}) {
        x.back() = axis;
        const auto found = formats.find(x);
        formats_.push_back(found == formats.end() ? PlaneFormat{.stride = 4, .memory = x} : found->second);
        memory_.push_back(buffers.map<const std::byte>(formats_.back().memory, CL_MAP_READ));
    }
}

Vector StoredVectors::at(std::size_t i) const {
    if (formats_[0].encoding == octahedral16) {
        std::uint32_t bits = 0;
        std::memcpy(&bits, memory_[0] + i * formats_[0].stride, sizeof bits);
        return reference::decoded_normal(octahedral16, bits);
    }
    return {number_at(memory_[0], formats_[0], i), number_at(memory_[1], formats_[1], i),
            number_at(memory_[2], formats_[2], i)};
}

}  // namespace wrinkle::bench
