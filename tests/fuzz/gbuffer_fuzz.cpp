#include <algorithm>
#include <vector>

#include "io/camera_file.h"
#include "io/gbuffer_reader.h"
#include "tests/fuzz/fuzz.h"

/// Roles, cameras in headers, Cryptomatte manifests and the pixels of a frame: by ZIP blocks and by OpenImageIO.
WRINKLE_HARNESS(gbuffer_fuzz)(const std::uint8_t* data, std::size_t size) {
    return wrinkle::fuzz::with_file(data, size, ".exr", [](const std::filesystem::path& file) {
        const wrinkle::GBufferReader reader(file);
        const auto [width, height] = reader.size();
        if (std::uint64_t{width} * height > 1 << 16) return;
        const auto planes = reader.planes();
        std::vector<std::vector<float>> values(planes.size(), std::vector<float>(std::size_t{width} * height));
        std::vector<float*> out;
        for (auto& plane : values) out.push_back(plane.data());
        reader.cryptomatte().names();
        reader.read_rows(0, height, planes, out);
        try {
            wrinkle::CameraSource from;
            from.exr = true;
            wrinkle::read_frame_camera(from, reader, 0);
        } catch (const wrinkle::Error&) {}  // most have no camera
    });
}
