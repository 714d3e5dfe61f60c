#include "tests/reference/mask.h"

#include <gtest/gtest.h>

namespace wrinkle::reference {
namespace {

TEST(Mask, Murmur3KnownAnswers) {
    EXPECT_EQ(murmur3_32(""), 0u);
    EXPECT_EQ(murmur3_32("hello"), 0x248bfa47u);
    EXPECT_EQ(murmur3_32("hello, world"), 0x149bbb7fu);
    EXPECT_EQ(murmur3_32("The quick brown fox jumps over the lazy dog"), 0x2e4ff723u);
}

TEST(Mask, CryptomatteBitsAreAlwaysNormalFloats) {
    for (int i = 0; i < 5000; ++i) {
        const float id = std::bit_cast<float>(cryptomatte_bits("object" + std::to_string(i)));
        EXPECT_TRUE(std::isnormal(id)) << i;
    }
    EXPECT_EQ(cryptomatte_bits("#deadbeef"), 0xdeadbeefu);
}

TEST(Mask, CoverageSumsTheRanksOfOneId) {
    const std::uint32_t bits = cryptomatte_bits("Rock");
    const float rock = std::bit_cast<float>(bits), other = std::bit_cast<float>(cryptomatte_bits("Moss"));
    const std::pair<float, float> ranks[] = {{rock, 0.5f}, {other, 0.25f}, {rock, 0.125f}};
    EXPECT_EQ(cryptomatte_coverage<double>(ranks, bits), 0.625);
}

}  // namespace
}  // namespace wrinkle::reference
