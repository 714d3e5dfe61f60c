#pragma once

#include "io/gbuffer_reader.h"
#include "io/image_writer.h"
#include "tests/io/files.h"

/// A picture that is written in bands of rows.
namespace wrinkle::test {

inline constexpr std::uint32_t width = 45, height = 67;

/// Planes of a whole picture, from which bands are written.
inline std::vector<std::vector<float>> planes_of(int channels) {
    std::vector<std::vector<float>> planes(static_cast<std::size_t>(channels));
    for (int c = 0; c < channels; ++c)
        for (std::uint32_t y = 0; y < height; ++y)
            for (std::uint32_t x = 0; x < width; ++x)
                planes[static_cast<std::size_t>(c)].push_back(numbered(c, static_cast<int>(x), static_cast<int>(y)));
    return planes;
}

inline void write_band(ImageWriter& writer, const std::vector<std::vector<float>>& planes, std::uint32_t begin,
                       std::uint32_t end) {
    std::vector<const float*> band;
    for (const auto& plane : planes) band.push_back(plane.data() + begin * width);
    writer.write_rows(begin, end, band);
}

inline std::vector<float> read_channel(const std::filesystem::path& file, const std::string& channel) {
    const GBufferReader reader(file);
    std::vector<float> values(std::size_t{reader.size().width} * reader.size().height);
    float* out[] = {values.data()};
    reader.read_rows(0, reader.size().height, std::vector<std::string>{"channel:" + channel}, out);
    return values;
}

}  // namespace wrinkle::test
