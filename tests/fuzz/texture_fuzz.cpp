#include "io/texture_file.h"
#include "tests/fuzz/fuzz.h"

WRINKLE_HARNESS(texture_fuzz)(const std::uint8_t* data, std::size_t size) {
    return wrinkle::fuzz::with_file(data, size, ".png", [](const std::filesystem::path& file) {
        wrinkle::load_texture(file, wrinkle::ImageUse::scalar);
        wrinkle::load_texture(file, wrinkle::ImageUse::normal);
    });
}
