#include "io/cryptomatte.h"

#include <bit>
#include <cmath>

#include "io/metadata.h"
#include "tests/io/files.h"

namespace wrinkle {
namespace {

using namespace test;

TEST(Cryptomatte, ManifestsOfHashesMeanTheFloatsThatChannelsHold) {
    // The hash of "Box" has an exponent of 0, which would make a denormal; Blender writes it into the manifest as it
    // is.
    EXPECT_EQ(cryptomatte_hash("Box"), 0x80bb1009u);
    Metadata header;
    header.set("cryptomatte/1/name", "CryptoObject");
    for (const char* manifest : {R"({"Box":"803b1009"})", R"({"Box":"80bb1009"})", R"({"Box":"803b1009")"}) {
        header.set("cryptomatte/1/manifest", manifest);
        EXPECT_EQ(CryptomatteManifest(header, "CryptoObject", "f.exr").id("Box"), 0x80bb1009u) << manifest;
    }
}

TEST(Cryptomatte, HashesAsBlenderDoes) {
    EXPECT_EQ(cryptomatte_hash("Suzanne"), 0xcb432898u);
    EXPECT_EQ(cryptomatte_hash("Torus"), 0x789a1936u);
    EXPECT_EQ(cryptomatte_hash("Rock"), 0xf9fa0452u);
    EXPECT_EQ(cryptomatte_hash("Ground"), 0x24950135u);
    for (int i = 0; i < 2000; ++i) {
        EXPECT_TRUE(std::isnormal(std::bit_cast<float>(cryptomatte_hash("object" + std::to_string(i)))));
    }
    const CryptomatteManifest none;
    EXPECT_EQ(none.id("Rock"), 0xf9fa0452u);
    EXPECT_EQ(none.id("#24950135"), 0x24950135u);
}

TEST(Cryptomatte, ManifestBesideTheFile) {
    TempFolder folder;
    write_text(folder / "names.json", R"({"Rock":"f9fa0452"})");
    Metadata header;
    header.set("cryptomatte/1/name", "CryptoObject");
    header.set("cryptomatte/1/manif_file", "names.json");
    EXPECT_EQ(CryptomatteManifest(header, "ViewLayer.CryptoObject", folder / "f.exr").names(),
              std::vector<std::string>{"Rock"});
    header.set("cryptomatte/1/manif_file", "../names.json");  // not beside the frame: names are hashed
    EXPECT_TRUE(CryptomatteManifest(header, "CryptoObject", folder / "f.exr").names().empty());
    std::filesystem::create_symlink(folder / "names.json", folder / "link.json");
    header.set("cryptomatte/1/manif_file", "link.json");
    EXPECT_TRUE(CryptomatteManifest(header, "CryptoObject", folder / "f.exr").names().empty());
}

// Blender does not escape quotes, and other programs write Latin-1: one odd name must not take all others away.
TEST(Cryptomatte, DamagedManifestsKeepWhatCanBeRead) {
    Metadata header;
    header.set("cryptomatte/1/name", "CryptoObject");
    header.set("cryptomatte/1/manifest",
               "{\"Column\":\"8ff21816\",\"B\xf6"
               "den \"plane\".001\":\"9c1ab2c0\", \"Kugel, rot\" : \"438da8f6\",\"odd\":7}");
    const CryptomatteManifest manifest(header, "CryptoObject", "f.exr");
    EXPECT_EQ(manifest.names(), (std::vector<std::string>{"B\xf6"
                                                          "den \"plane\".001",
                                                          "Column", "Kugel, rot"}));
    EXPECT_EQ(manifest.id("Kugel, rot"), 0x438da8f6u);
    EXPECT_EQ(manifest.id("Torus"), 0x789a1936u);  // lost, so hashed
    header.set("cryptomatte/1/manifest", "{oops");
    const CryptomatteManifest lost(header, "CryptoObject", "f.exr");
    EXPECT_EQ(lost.id("Rock"), 0xf9fa0452u);
    EXPECT_EQ(lost.id("#12345678"), 0x12345678u);
}

}  // namespace
}  // namespace wrinkle
