#include "io/exr_header.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <chrono>
#include <limits>
#include <random>

#include "io/gbuffer_reader.h"
#include "tests/cases/sanitized.h"
#include "tests/io/files.h"
#include "tests/io/odd_exr.h"

namespace wrinkle {
namespace {

using namespace test;

/// What reading a whole frame throws; empty when all of it can be read.
std::string outcome(const std::filesystem::path& file) {
    try {
        const GBufferReader reader(file);
        const auto [width, height] = reader.size();
        std::vector<std::string> planes = reader.planes();
        const std::uint32_t rows = std::min(height, 64U);
        std::vector<std::vector<float>> values(planes.size(), std::vector<float>(std::size_t{rows} * width));
        std::vector<float*> out;
        for (auto& plane : values) out.push_back(plane.data());
        reader.read_rows(0, rows, planes, out);
        return {};
    } catch (const Error& error) { return error.what(); }
}

std::string outcome_of(const TempFolder& folder, const std::string& bytes) {
    write_text(folder / "odd.exr", bytes);
    return outcome(folder / "odd.exr");
}

TEST(ExrHeader, ASoundOneIsRead) {
    const TempFolder folder;
    EXPECT_EQ(outcome_of(folder, exr_file({})), "");
    ExrHeader more;
    more.after = exr_attribute("comments", "string", "any") + exr_attribute("owner", "string", std::string(40000, 'x'));
    EXPECT_EQ(outcome_of(folder, exr_file(more)), "");
}

/// OpenEXR takes the last of two, OpenEXRCore the first.
TEST(ExrHeader, AttributesOfTheLayoutStandThereOnce) {
    const TempFolder folder;
    const ExrBox wide{0, 0, 4095, 15};
    for (const bool before : {false, true}) {
        ExrHeader header;
        (before ? header.before : header.after) = exr_attribute("dataWindow", "box2i", as_bytes(wide));
        expect_mentions(outcome_of(folder, exr_file(header)),
                        {"odd.exr: the header has two attributes \"dataWindow\""});
    }
    ExrHeader header;
    header.after = exr_attribute("compression", "compression", std::string(1, '\1'));
    expect_mentions(outcome_of(folder, exr_file(header)), {"two attributes \"compression\""});
}

/// Which is of tiled files, and OpenEXR passes over.
TEST(ExrHeader, TilesOfAScanlineFileDivideNothing) {
    const TempFolder folder;
    for (const std::uint32_t side : {0U, 16U}) {
        ExrHeader header;
        header.after =
            exr_attribute("tiles", "tiledesc", as_bytes(std::array<std::uint32_t, 2>{side, side}) + std::string(1, 0));
        outcome_of(folder, exr_file(header));
    }
}

/// OpenEXR reads what a type takes whatever size is stated, then some byte as the next attribute's size: gigabytes.
TEST(ExrHeader, SizesAreThoseOfTheTypes) {
    const TempFolder folder;
    const std::string short_string = as_bytes(std::int32_t{2}) + "ab", long_string = as_bytes(std::int32_t{1 << 30});
    for (const auto& [type, value] : std::vector<std::pair<const char*, std::string>>{
             {"int", std::string(5, '\0')},
             {"m44f", std::string(16, '\0')},
             {"preview", as_bytes(std::array<std::uint32_t, 2>{1U << 15, 1U << 15})},
             {"stringvector", short_string + long_string},
             {"chlist", std::string(3, '\0')},
             {"chlist", "A" + std::string(17, '\0')}}) {  // a channel, and no empty name behind it
        ExrHeader header;
        header.after = exr_attribute("odd", type, value);
        expect_mentions(outcome_of(folder, exr_file(header)),
                        {"odd.exr: the attribute \"odd\" is of type", type, "whose values do not take"});
    }
    ExrHeader sound;
    sound.after = exr_attribute("names", "stringvector", short_string + short_string) +
                  exr_attribute("preview", "preview", as_bytes(std::array<std::uint32_t, 3>{1, 1, 0})) +
                  exr_attribute("own", "of a program's", "any");
    EXPECT_EQ(outcome_of(folder, exr_file(sound)), "");
}

TEST(ExrHeader, ClaimsAreNoMemory) {
    const TempFolder folder;
    constexpr int kFar = 100'000'000;
    ExrHeader wide, flat, tall, frame, tiles, longest;
    wide.data[2] = kFar;
    expect_mentions(outcome_of(folder, exr_file(wide)),
                    {"odd.exr: it claims rows of 100000001 pixels", "in a file of"});
    flat.data[2] = 6'000'000, flat.data[3] = flat.data[1];
    expect_mentions(outcome_of(folder, exr_file(flat)), {"odd.exr: it claims rows of 6000001 pixels", "in a file of"});
    tall.display = {0, 0, 131071, 131071};
    expect_mentions(outcome_of(folder, exr_file(tall)), {"odd.exr: it claims a frame of 131072x131072 pixels"});
    tiles.version |= 0x200;
    tiles.after = exr_attribute("tiles", "tiledesc",
                                as_bytes(std::array<std::uint32_t, 2>{1U << 31, 1U << 31}) + std::string(1, '\0'));
    expect_mentions(outcome_of(folder, exr_file(tiles)), {"odd.exr: it claims tiles of 2147483648x2147483648 pixels"});
    longest.after = exr_attribute("comments", "string", "any");
    std::string bytes = exr_file(longest);
    const std::int32_t size = std::numeric_limits<std::int32_t>::max();
    std::memcpy(bytes.data() + bytes.find("comments") + sizeof "comments" + sizeof "string", &size, sizeof size);
    expect_mentions(outcome_of(folder, bytes), {"the attribute \"comments\" claims 2147483647 bytes"});
}

/// Any header is read or refused, in little time and memory.
TEST(ExrHeader, TwoThousandOddOnes) {
    const TempFolder folder;
    std::mt19937 random(7);
    const auto below = [&](std::uint32_t end) { return static_cast<std::uint32_t>(random() % end); };
    constexpr std::int32_t kSides[] = {0,
                                       -1,
                                       1,
                                       7,
                                       15,
                                       16,
                                       255,
                                       65535,
                                       1 << 17,
                                       1 << 24,
                                       1 << 30,
                                       -(1 << 30),
                                       std::numeric_limits<std::int32_t>::max(),
                                       std::numeric_limits<std::int32_t>::min(),
                                       100'000'000};
    const auto side = [&] { return kSides[below(std::size(kSides))]; };
    const auto box = [&] { return below(3) != 0 ? ExrBox{0, 0, 15, 15} : ExrBox{side(), side(), side(), side()}; };
    const auto attribute = [&]() -> std::string {
        const char* const names[] = {"dataWindow", "displayWindow", "channels", "tiles",     "type",
                                     "chunkCount", "view",          "preview",  "multiView", "envmap",
                                     "name",       "worldToCamera", "x"};
        const char* const types[] = {"box2i", "chlist", "tiledesc", "string", "int", "m44f", "preview", "stringvector"};
        std::string value(below(70), '\0');
        for (char& c : value) c = static_cast<char>(below(4) == 0 ? random() : 0);
        if (below(3) == 0) value = as_bytes(box());
        if (below(5) == 0) value = below(2) == 0 ? "scanlineimage" : "tiledimage";
        return exr_attribute(names[below(std::size(names))], types[below(std::size(types))], value);
    };
    rusage before{}, after{};
    getrusage(RUSAGE_SELF, &before);
    int read = 0;
    for (int trial = 0; trial < 2000; ++trial) {
        ExrHeader header;
        header.data = box(), header.display = box();
        header.compression = static_cast<std::uint8_t>(below(3) == 0 ? below(12) : 3);
        header.channels[0].type = static_cast<std::int32_t>(below(4));
        if (below(4) == 0) header.channels.push_back({"N.X"});
        if (below(8) == 0) header.channels.clear();
        if (below(8) == 0) header.version |= 1U << (8 + below(6));
        for (std::uint32_t count = below(3); count > 0; --count)
            (below(2) == 0 ? header.before : header.after) += attribute();
        std::string bytes = exr_file(header);
        if (below(4) == 0) bytes[8 + below(static_cast<std::uint32_t>(bytes.size() - 8))] = static_cast<char>(random());
        const auto began = std::chrono::steady_clock::now();
        const std::string text = outcome_of(folder, bytes);
        read += text.empty() ? 1 : 0;
        if (!test::kSanitized) {
            EXPECT_LT(std::chrono::steady_clock::now() - began, std::chrono::seconds(2)) << trial << ": " << text;
        }
        if (!text.empty()) { EXPECT_EQ(text.find(folder / "odd.exr"), 0U) << text; }
    }
    getrusage(RUSAGE_SELF, &after);
    constexpr long kMost = 300 << 10;  // kB
    if (!test::kSanitized) { EXPECT_LT(after.ru_maxrss - before.ru_maxrss, kMost); }
    EXPECT_GT(read, 100) << "nearly all were refused, which proves little";
}

}  // namespace
}  // namespace wrinkle
