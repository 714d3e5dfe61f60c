#include "io/deflate.h"

#include <gtest/gtest.h>
#include <zlib.h>

#include <cmath>
#include <cstring>
#include <random>
#include <string>
#include <vector>

namespace wrinkle {
namespace {

using Bytes = std::vector<std::uint8_t>;

/// A block of an EXR file of 16 rows, 1024 pixels wide, of sines and noise: all even bytes, then all odd ones, each as
/// its difference from the one before.
Bytes block_of(float noise, std::uint32_t seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> draw(-noise, noise);
    std::vector<float> pixels(16 * 1024);
    for (std::size_t i = 0; i < pixels.size(); ++i)
        pixels[i] = std::sin(static_cast<float>(i % 1024) / 97) + draw(random);
    Bytes plain(pixels.size() * sizeof(float)), block(plain.size());
    std::memcpy(plain.data(), pixels.data(), plain.size());
    for (std::size_t i = 0; i < plain.size(); ++i) block[i / 2 + i % 2 * (plain.size() / 2)] = plain[i];
    for (std::size_t i = block.size() - 1; i > 0; --i) block[i] = static_cast<std::uint8_t>(block[i] - block[i - 1]);
    return block;
}

Bytes unpacked(const Bytes& packed, std::size_t size) {
    Bytes out(size);
    uLongf found = size;
    EXPECT_EQ(uncompress(out.data(), &found, packed.data(), packed.size()), Z_OK);
    EXPECT_EQ(found, size);
    return out;
}

Bytes packed(io::Deflater& deflater, const Bytes& block) {
    Bytes out(2 * block.size() + 1000);
    out.resize(deflater.pack(block, out));
    return out;
}

TEST(Deflate, ZlibUnpacksBlocksOfEveryKindHardlyLargerThanItsOwn) {
    io::Deflater deflater;
    std::vector<std::pair<std::string, Bytes>> blocks{{"bytes of one value", Bytes(200000, 7)},
                                                      {"few bytes", Bytes(100, 7)}};
    for (const float noise : {0.0F, 1e-6F, 1e-4F, 1e-2F, 1.0F})
        blocks.emplace_back("noise of " + std::to_string(noise), block_of(noise, 3));
    for (const auto& [name, block] : blocks) {
        SCOPED_TRACE(name);
        const Bytes ours = packed(deflater, block);
        EXPECT_EQ(unpacked(ours, block.size()), block);
        Bytes theirs(2 * block.size() + 1000);
        uLongf size = theirs.size();
        ASSERT_EQ(compress2(theirs.data(), &size, block.data(), block.size(), 4), Z_OK);
        EXPECT_LE(static_cast<double>(ours.size()), 1.03 * static_cast<double>(size) + 100);
    }
}

TEST(Deflate, PacksABlockAsItDoesAfterOthers) {
    io::Deflater fresh, used;
    const Bytes block = block_of(1e-4F, 5);
    for (const float noise : {0.0F, 1.0F, 1e-3F}) packed(used, block_of(noise, 1));
    EXPECT_EQ(packed(used, block), packed(fresh, block));
}

TEST(Deflate, WhatDoesNotFitIsNotPacked) {
    io::Deflater deflater;
    for (const float noise : {0.0F, 1e-3F, 1.0F}) {
        const Bytes block = block_of(noise, 9);
        Bytes exact = packed(deflater, block), out(exact.size() / 2, 0xaa);
        EXPECT_EQ(deflater.pack(block, std::span(out).first(out.size() - 1)), 0U);
        EXPECT_EQ(out.back(), 0xaa) << "bytes behind the memory that was given";
    }
}

}  // namespace
}  // namespace wrinkle
