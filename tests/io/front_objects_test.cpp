// Which of the objects that a pixel shows its depth and normal are of, on rows that are made up.
#include "io/front_objects.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>

namespace wrinkle::io {
namespace {

constexpr std::uint32_t kGround = 0x3f800001u, kLeaf = 0x40000002u, kWall = 0x40400003u;

/// A pixel: how much two objects cover, the depth, and the object number.
struct Shown {
    std::uint32_t first = kGround;
    float covers = 1;
    std::uint32_t second = 0;
    float covers_too = 0;
    float depth = 10;
    float number = 0;
    float tilt = 0;  ///< of the normal, radians
};

constexpr Shown ground{};
Shown leaf_over_ground(float leaf, float depth = 8) {
    return leaf >= 0.5f ? Shown{kLeaf, leaf, kGround, 1 - leaf, depth} : Shown{kGround, 1 - leaf, kLeaf, leaf, depth};
}

RoleMap roles(bool position, bool object) {
    RoleMap map;
    for (const char* plane :
         {"crypto.id0", "crypto.coverage0", "crypto.id1", "crypto.coverage1", "normal.x", "normal.y", "normal.z"})
        map.channel_of[plane] = plane;
    for (const char* plane : {"position.x", "position.y", "position.z"})
        if (position) map.channel_of[plane] = plane;
    if (!position) map.channel_of["depth"] = "depth";
    if (object) map.channel_of["object"] = "object";
    map.cryptomatte_ranks = 2;
    return map;
}

/// The ids of those in front; 1: nobody knows.
std::vector<std::uint32_t> fronts(const std::vector<Shown>& row, bool position = false, bool object = false) {
    std::map<std::string, std::vector<float>> planes;
    for (std::size_t x = 0; x < row.size(); ++x) {
        const Shown& s = row[x];
        const std::pair<const char*, float> values[] = {{"crypto.id0", std::bit_cast<float>(s.first)},
                                                        {"crypto.coverage0", s.covers},
                                                        {"crypto.id1", std::bit_cast<float>(s.second)},
                                                        {"crypto.coverage1", s.covers_too},
                                                        {"normal.x", std::sin(s.tilt)},
                                                        {"normal.y", 0},
                                                        {"normal.z", std::cos(s.tilt)},
                                                        {"depth", s.depth},
                                                        {"position.x", 0.01f * static_cast<float>(x) * s.depth},
                                                        {"position.y", 3},
                                                        {"position.z", -s.depth},
                                                        {"object", s.number}};
        for (const auto& [name, value] : values) planes[name].push_back(value);
    }
    const FrontObjects all(roles(position, object));
    std::vector<const float*> needed;
    for (const std::string& name : all.needed()) needed.push_back(planes[name].data());
    std::vector<float> found(row.size(), -7);
    all.find(needed, row.size(), found);
    std::vector<std::uint32_t> ids;
    for (const float id : found) ids.push_back(id == 0 && std::signbit(id) ? 1 : std::bit_cast<std::uint32_t>(id));
    return ids;
}

/// A row of ground with a few pixels in its middle.
std::vector<Shown> amid_ground(const std::vector<Shown>& middle) {
    std::vector<Shown> row(6, ground);
    row.insert(row.end(), middle.begin(), middle.end());
    row.insert(row.end(), 6, ground);
    return row;
}

std::vector<std::uint32_t> ids_amid_ground(const std::vector<std::uint32_t>& middle) {
    std::vector<std::uint32_t> ids(6, kGround);
    ids.insert(ids.end(), middle.begin(), middle.end());
    ids.insert(ids.end(), 6, kGround);
    return ids;
}

TEST(FrontObjects, ALeafIsInFrontHoweverLittleItCoversWhereTheDepthJumps) {
    for (const bool position : {false, true})
        for (const float opacity : {0.1f, 0.3f, 0.5f, 0.51f, 0.9f}) {
            const std::vector<Shown> leaf(5, leaf_over_ground(opacity));
            EXPECT_EQ(fronts(amid_ground(leaf), position), ids_amid_ground(std::vector(5, kLeaf))) << opacity;
        }
}

TEST(FrontObjects, TheGroundIsInFrontWherePassesShowItThroughTheLeaf) {
    const std::vector<Shown> leaf(5, leaf_over_ground(0.45f, 10));
    EXPECT_EQ(fronts(amid_ground(leaf)), ids_amid_ground(std::vector(5, kGround)));
}

TEST(FrontObjects, ALeafBeforeTheSkyIsAloneThereAndSoInFrontOfTheGround) {
    std::vector<Shown> row(4, {.first = 0, .covers = 0, .depth = 1e10f});
    row.insert(row.end(), 4, {kLeaf, 0.5f, 0, 0, 8});
    row.insert(row.end(), 4, leaf_over_ground(0.4f));
    std::vector<std::uint32_t> wanted(4, 0);
    wanted.insert(wanted.end(), 8, kLeaf);
    EXPECT_EQ(fronts(row), wanted);
}

TEST(FrontObjects, EdgesOfOpaqueThingsBelongToTheSurfaceThatGoesOn) {
    std::vector<Shown> row(5, {kWall, 1, 0, 0, 5});
    row.push_back({kGround, 0.6f, kWall, 0.4f, 5});   // the sample in the middle hit the wall
    row.push_back({kWall, 0.7f, kGround, 0.3f, 10});  // ... and the ground
    row.insert(row.end(), 5, ground);
    std::vector<std::uint32_t> wanted(6, kWall);
    wanted.insert(wanted.end(), 6, kGround);
    EXPECT_EQ(fronts(row), wanted);
}

TEST(FrontObjects, AtACreaseOfOneObjectWhatIsSeenBesideItTakesNothing) {
    for (const bool position : {false, true}) {
        for (const float leaf : {0.1f, 0.3f}) {
            std::vector<Shown> row = amid_ground(std::vector(3, leaf_over_ground(leaf, 10)));
            for (std::size_t x = 6; x < 9; ++x) row[x].tilt = 1;
            EXPECT_EQ(fronts(row, position), std::vector(15, kGround)) << leaf;
        }
        for (const float sign : {-1.0f, 1.0f}) {  // a ridge or a trench with a flat middle, and sides of 45 degrees
            std::vector<Shown> row;
            for (int x = 0; x < 20; ++x) {
                const float from_middle = static_cast<float>(x) - 9.5f;
                row.push_back({.depth = 10 + sign * 0.1f * std::max(std::abs(from_middle) - 3, 0.0f)});
                if (std::abs(from_middle) > 3)
                    row.back().tilt = std::copysign(0.785f, sign * from_middle);
                else
                    row.back() = leaf_over_ground(0.3f, 10);
            }
            EXPECT_EQ(fronts(row, position), std::vector(20, kGround)) << sign;
        }
    }
}

TEST(FrontObjects, BetweenDenseLeavesATreeGoesOnFartherAway) {
    for (const bool position : {false, true}) {
        std::vector<Shown> row(6, {.first = kLeaf, .depth = 8});
        row.insert(row.end(), 3, {kLeaf, 0.6f, kGround, 0.4f, 9});
        row.insert(row.end(), 6, {.first = kLeaf, .depth = 8});
        EXPECT_EQ(fronts(row, position), std::vector(15, kLeaf));
        for (std::size_t x = 6; x < 9; ++x) row[x].covers = row[x].covers_too = 0.5f;
        EXPECT_EQ(fronts(row, position)[7], 1u) << "nobody knows";
    }
}

TEST(FrontObjects, ATreeAtItsLimbIsItsOwnHoweverItsLeavesJump) {
    std::vector<Shown> row(6, {.first = kLeaf, .depth = 8});
    row.insert(row.end(), 3, {kLeaf, 0.7f, kGround, 0.3f, 7});
    row.insert(row.end(), 6, {.first = kWall, .depth = 20});
    for (const bool position : {false, true}) EXPECT_EQ(fronts(row, position)[7], kLeaf);
}

TEST(FrontObjects, ALeafOverTheBorderOfTwoObjectsIsInFrontOfBoth) {
    std::vector<Shown> row(6, ground);
    row.insert(row.end(), 3, leaf_over_ground(0.2f));
    row.insert(row.end(), 3, {kWall, 0.8f, kLeaf, 0.2f, 8});
    row.insert(row.end(), 6, {.first = kWall});
    std::vector<std::uint32_t> wanted(6, kGround);
    wanted.insert(wanted.end(), 6, kLeaf);
    wanted.insert(wanted.end(), 6, kWall);
    for (const bool position : {false, true}) EXPECT_EQ(fronts(row, position), wanted);
}

TEST(FrontObjects, TwoLeavesOneBehindTheOtherAreBothInFrontOfTheGround) {
    std::vector<Shown> leaves(3, leaf_over_ground(0.3f));
    leaves.insert(leaves.end(), 3, leaf_over_ground(0.3f, 6));
    for (const bool position : {false, true})
        EXPECT_EQ(fronts(amid_ground(leaves), position), ids_amid_ground(std::vector(6, kLeaf)));
}

TEST(FrontObjects, SmoothSurfacesHaveNoEdge) {
    std::vector<Shown> ball;  // its depth falls ever more steeply towards its limb
    for (int x = 0; x < 40; ++x) ball.push_back({.depth = 10 - std::sqrt(1 - 0.0006f * static_cast<float>(x * x))});
    for (std::size_t x = 20; x < 40; ++x) ball[x] = {kGround, 0.6f, kLeaf, 0.4f, ball[x].depth};
    EXPECT_EQ(fronts(ball), std::vector(40, kGround));
}

TEST(FrontObjects, ObjectNumbersTellWhereNothingElseDoes) {
    std::vector<Shown> row(8, leaf_over_ground(0.5f, 10));  // no pixel beside it shows the ground alone
    EXPECT_EQ(fronts(row), std::vector<std::uint32_t>(8, 1)) << "nobody knows";
    row.insert(row.end(), 4, {.depth = 3});
    row.insert(row.end(), 4, {kWall, 1, 0, 0, 1, 5});
    for (std::size_t x = 0; x < 8; ++x) row[x].number = 2;
    EXPECT_EQ(fronts(row, false, true)[3], kLeaf) << "2 is not the ground's number";
    for (std::size_t x = 0; x < 8; ++x) row[x].number = 0;
    EXPECT_EQ(fronts(row, false, true)[3], kGround) << "0 is the ground's number";
}

TEST(FrontObjects, WhatCoversMostByFarIsInFrontWhereNothingElseTells) {
    EXPECT_EQ(fronts(std::vector(6, leaf_over_ground(0.7f))), std::vector(6, kLeaf));
    EXPECT_EQ(fronts(std::vector(6, leaf_over_ground(0.55f))), std::vector<std::uint32_t>(6, 1));
}

TEST(FrontObjects, OddNumbersDoNoHarm) {
    const float nan = std::nanf(""), inf = INFINITY;
    const std::vector<Shown> row{{.depth = nan},
                                 {.covers = nan, .number = nan},
                                 {kLeaf, 0.5f, kGround, 0.5f, inf, nan},
                                 {kLeaf, 0.5f, kGround, 0.5f, -1},
                                 {.tilt = nan},
                                 {kLeaf, inf, kGround, 0.5f, 0}};
    for (const bool position : {false, true})
        for (const bool object : {false, true}) EXPECT_EQ(fronts(row, position, object).size(), 6u);
    EXPECT_TRUE(fronts({}).empty());
    RoleMap bare = roles(false, false);
    bare.channel_of.erase("depth");
    EXPECT_TRUE(FrontObjects(bare).needed().empty());
}

}  // namespace
}  // namespace wrinkle::io
