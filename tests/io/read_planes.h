#pragma once

#include "io/gbuffer_reader.h"
#include "tests/io/files.h"

namespace wrinkle::test {

/// Rows [begin, end) of some planes, a vector for each plane.
inline std::vector<std::vector<float>> read(const GBufferReader& reader, std::uint32_t begin, std::uint32_t end,
                                            const std::vector<std::string>& planes) {
    std::vector<std::vector<float>> values(planes.size());
    std::vector<float*> out;
    for (auto& plane : values) {
        plane.assign(std::size_t{end - begin} * reader.size().width, -1.0f);
        out.push_back(plane.data());
    }
    reader.read_rows(begin, end, planes, out);
    return values;
}

}  // namespace wrinkle::test
