#include "io/cryptomatte.h"

#include <bit>
#include <cmath>

#include "io/metadata.h"
#include "tests/io/files.h"

namespace wrinkle {
namespace {

using namespace test;

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
    header.set("cryptomatte/1/manifest", "{oops");
    const CryptomatteManifest damaged(header, "CryptoObject", folder / "f.exr");
    expect_mentions(error_of([&] { damaged.id("Rock"); }), {"f.exr", "manifest", "CryptoObject", "hex digits"});
    EXPECT_EQ(damaged.id("#f9fa0452"), 0xf9fa0452u);
}

}  // namespace
}  // namespace wrinkle
