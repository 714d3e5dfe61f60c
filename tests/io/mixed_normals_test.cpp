#include "io/mixed_normals.h"

#include "tests/io/files.h"

namespace wrinkle::test {
namespace {

/// The share of a frame whose normals have these lengths, from left to right.
double share_of(const std::vector<float>& lengths) {
    const TempFolder folder;
    write_exr(folder / "n.exr", static_cast<int>(lengths.size()), 40, {"N.X", "N.Y", "N.Z"}, [&](int c, int x, int) {
        return lengths[static_cast<std::size_t>(x)] * (c == 0 ? -0.6f : c == 1 ? 0 : 0.8f);
    });
    return io::mixed_normals(GBufferReader(folder / "n.exr"));
}

TEST(MixedNormals, AreShortWhereOthersAreNot) {
    std::vector<float> lengths(50, 1);
    EXPECT_EQ(share_of(lengths), 0);
    lengths[7] = 0.7f, lengths[30] = 0.4f, lengths[31] = 0.97f, lengths[40] = 0;
    EXPECT_NEAR(share_of(lengths), 0.04, 1e-9);
    for (float& length : lengths) length *= 2;
    EXPECT_EQ(share_of(lengths), 0) << "normals of any length are allowed";
    EXPECT_EQ(share_of(std::vector<float>(50, 0)), 0);
    EXPECT_EQ(share_of(std::vector<float>(50, NAN)), 0);
}

TEST(MixedNormals, AFrameNeedsNone) {
    const TempFolder folder;
    write_exr(folder / "z.exr", 4, 4, {"Z"});
    EXPECT_EQ(io::mixed_normals(GBufferReader(folder / "z.exr")), 0);
}

}  // namespace
}  // namespace wrinkle::test
