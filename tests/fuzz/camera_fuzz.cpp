#include "io/camera_json.h"

#include "tests/fuzz/fuzz.h"

WRINKLE_HARNESS(camera_fuzz)(const std::uint8_t* data, std::size_t size) {
    return wrinkle::fuzz::with_file(data, size, ".json", [](const std::filesystem::path& file) {
        wrinkle::io::read_camera_json(file, {1920, 1080});
    });
}
