#include "wrinkle/scene.h"

#include "tests/fuzz/fuzz.h"

WRINKLE_HARNESS(scene_fuzz)(const std::uint8_t* data, std::size_t size) {
    return wrinkle::fuzz::with_file(data, size, ".toml",
                                    [](const std::filesystem::path& file) { wrinkle::load_scene(file); });
}
