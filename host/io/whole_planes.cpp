#include "io/whole_planes.h"

#include <fmt/format.h>

#include "base/limits.h"

namespace wrinkle::io {

std::map<std::string, std::vector<float>> read_whole_planes(const GBufferReader& reader,
                                                            std::span<const std::string> names) {
    const Size size = reader.size();
    const std::size_t pixels = std::size_t{size.width} * size.height;
    check_memory(reader.path().string(),
                 sizeof(float) * static_cast<double>(pixels) * static_cast<double>(names.size()),
                 fmt::format("{} planes of {} x {} pixels", names.size(), size.width, size.height));
    std::map<std::string, std::vector<float>> planes;
    std::vector<float*> into;
    for (const std::string& name : names) into.push_back((planes[name] = std::vector<float>(pixels)).data());
    reader.read_rows(0, size.height, names, into);
    return planes;
}

}  // namespace wrinkle::io
