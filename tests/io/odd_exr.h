#pragma once

#include <zlib.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

/// EXR files byte by byte, for headers that no library would write.
namespace wrinkle::test {

template <class T>
std::string as_bytes(const T& value) {
    return {reinterpret_cast<const char*>(&value), sizeof value};
}

inline std::string exr_attribute(std::string_view name, std::string_view type, const std::string& value) {
    std::string out;
    out.append(name).append(1, '\0').append(type).append(1, '\0');
    return out + as_bytes(static_cast<std::int32_t>(value.size())) + value;
}

using ExrBox = std::array<std::int32_t, 4>;  ///< first and last column and row: x0, y0, x1, y1

struct ExrChannel {
    std::string name;
    std::int32_t type = 2;  ///< 0: whole numbers, 1: half, 2: float
};

struct ExrHeader {
    std::vector<ExrChannel> channels{{"N.X"}, {"N.Y"}, {"N.Z"}, {"Z"}};
    std::uint8_t compression = 3;  ///< ZIP
    ExrBox data{0, 0, 15, 15}, display{0, 0, 15, 15};
    std::string before, after;  ///< more attributes, as exr_attribute() makes them
    std::uint32_t version = 2;

    std::string bytes() const {
        std::string list;
        for (const auto& [name, type] : channels)
            list += name + '\0' + as_bytes(type) + std::string(4, '\0') + as_bytes(std::array<std::int32_t, 2>{1, 1});
        list += '\0';
        return as_bytes(std::uint32_t{20000630}) + as_bytes(version) + before +
               exr_attribute("channels", "chlist", list) +
               exr_attribute("compression", "compression", as_bytes(compression)) +
               exr_attribute("dataWindow", "box2i", as_bytes(data)) +
               exr_attribute("displayWindow", "box2i", as_bytes(display)) +
               exr_attribute("lineOrder", "lineOrder", std::string(1, '\0')) +
               exr_attribute("pixelAspectRatio", "float", as_bytes(1.0F)) +
               exr_attribute("screenWindowCenter", "v2f", as_bytes(std::array<float, 2>{})) +
               exr_attribute("screenWindowWidth", "float", as_bytes(1.0F)) + after + '\0';
    }
};

/// A header with one ZIP block behind it, of `rows` rows of `width` pixels whose bytes are all 0.
inline std::string exr_file(const ExrHeader& header, std::size_t width = 16, std::size_t rows = 16) {
    std::size_t pixel = 0;
    for (const auto& channel : header.channels) pixel += channel.type == 1 ? 2 : 4;
    // Predicted bytes: each is its difference from the one before, plus 128.
    std::string plain(width * rows * pixel, static_cast<char>(-128));
    if (!plain.empty()) plain[0] = 0;
    uLongf size = compressBound(plain.size());
    std::string packed(size, '\0');
    compress(reinterpret_cast<Bytef*>(packed.data()), &size, reinterpret_cast<const Bytef*>(plain.data()),
             plain.size());
    packed.resize(size);
    const std::string head = header.bytes();
    return head + as_bytes(std::uint64_t{head.size() + 8}) +
           as_bytes(std::array<std::int32_t, 2>{header.data[1], static_cast<std::int32_t>(packed.size())}) + packed;
}

}  // namespace wrinkle::test
