#include "io/provenance.h"

#include "io/image_writer.h"
#include "tests/io/files.h"

namespace wrinkle::io {
namespace {

using namespace wrinkle::test;

std::string hash_of(const std::vector<std::string>& texts, const std::filesystem::path& file = {}) {
    Provenance hash;
    for (const std::string& text : texts) hash.add(text);
    if (!file.empty()) hash.add_file(file);
    return hash.digest();
}

TEST(Provenance, DiffersWithTextsAndFiles) {
    EXPECT_EQ(hash_of({"ab", "c"}), hash_of({"ab", "c"}));
    EXPECT_NE(hash_of({"ab", "c"}), hash_of({"a", "bc"}));
    const TempFolder folder;
    write_text(folder / "a.txt", "one");
    const std::string before = hash_of({}, folder / "a.txt");
    EXPECT_EQ(hash_of({}, folder / "a.txt"), before);
    std::filesystem::last_write_time(folder / "a.txt",
                                     std::filesystem::last_write_time(folder / "a.txt") + std::chrono::seconds(1));
    EXPECT_NE(hash_of({}, folder / "a.txt"), before);
    EXPECT_EQ(hash_of({}, folder / "missing.txt"), hash_of({}));
}

void write(const std::filesystem::path& file, const std::string& provenance) {
    ImageOptions options;
    options.provenance = provenance;
    ImageWriter writer(file, {64, 40}, {"R", "G", "B"}, options);
    std::vector<float> plane(std::size_t{64} * 40);
    for (std::size_t i = 0; i < plane.size(); ++i) plane[i] = static_cast<float>(i * i % 97) / 97;
    writer.write_rows(0, 40, std::array<const float*, 3>{plane.data(), plane.data(), plane.data()});
    writer.finish();
}

TEST(Provenance, PicturesAreFinishedIfTheyAreWholeAndOfThatProvenance) {
    const TempFolder folder;
    for (const char* name : {"a.exr", "a.png"}) {
        EXPECT_FALSE(is_finished(folder / name, "of this"));
        write(folder / name, "of this");
        EXPECT_TRUE(is_finished(folder / name, "of this")) << name;
        EXPECT_FALSE(is_finished(folder / name, "of that")) << name;
        std::filesystem::resize_file(folder / name, std::filesystem::file_size(folder / name) - 20);
        EXPECT_FALSE(is_finished(folder / name, "of this")) << name;
        write(folder / name, "");
        EXPECT_FALSE(is_finished(folder / name, "of this")) << name;
        write_text(folder / name, "no picture");
        EXPECT_FALSE(is_finished(folder / name, "of this")) << name;
    }
}

}  // namespace
}  // namespace wrinkle::io
