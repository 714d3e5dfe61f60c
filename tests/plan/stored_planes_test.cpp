// Formats of planes: which cannot be, what is read, and that planes of floats stay as they were.
#include <algorithm>

#include "tests/plan/planned.h"

namespace wrinkle::test {
namespace {

using enum PlaneEncoding;

Scene noise_scene() { return scene_of({layer(NoiseLayer{})}); }

std::string refused(const PlaneFormats& formats) {
    Available available = everything();
    available.formats = formats;
    return refusal(noise_scene(), available);
}

TEST(PlanOfStoredPlanes, LeavesPlanesOfFloatsAsTheyWere) {
    Available available = everything();
    const Plan before = make_plan(noise_scene(), available);
    available.formats = {{"depth", {}}, {"normal.x", {.stride = 4, .memory = "normal.x"}}};
    const Plan after = make_plan(noise_scene(), available);
    EXPECT_EQ(before.source, after.source);
    EXPECT_EQ(before.inputs, after.input_memories);
    EXPECT_FALSE(mentions(after, "wr_stored"));
}

TEST(PlanOfStoredPlanes, GivesPlanesThatShareAMemoryOneArgument) {
    Available available = everything();
    available.formats = interleaved("gbuffer0", half, {"normal.x", "normal.y", "normal.z", "roughness"});
    available.formats["depth"] = {.encoding = unorm16, .scale = 100};
    const Plan plan = make_plan(noise_scene(), available);
    EXPECT_EQ(plan.input_memories, (Names{"depth", "gbuffer0"}));
    EXPECT_EQ(plan.inputs, (Names{"depth", "normal.x", "normal.y", "normal.z"}));
    EXPECT_EQ(plan.bytes, 2 + 8 + 3 * 4);
    EXPECT_TRUE(mentions(plan, "WR_STORED_HALF, 2, 8, 4, 0, 1.00000000f, 0.00000000f"));
    available.formats = interleaved("other name", half, {"normal.x", "normal.y", "normal.z", "roughness"});
    available.formats["depth"] = {.encoding = unorm16, .scale = 100};
    EXPECT_EQ(make_plan(noise_scene(), available).source, plan.source);
}

TEST(PlanOfStoredPlanes, RefusesWhatCannotBe) {
    expect_mentions(refused({{"dept", {.encoding = half}}}), {"no plane \"dept\"", "nearest: \"depth\""});
    expect_mentions(refused({{"depth", {.encoding = half, .offset = 3, .stride = 8}}}),
                    {"\"depth\", as half", "byte 3", "multiples of 2"});
    expect_mentions(refused({{"depth", {.encoding = half, .offset = 8, .stride = 8}}}),
                    {"beyond its pixels", "8 bytes"});
    expect_mentions(refused({{"depth", {.encoding = unorm8, .scale = 0}}}), {"scale 0", "not 0"});
    expect_mentions(refused({{"object", {.encoding = uint32, .scale = 2}}}),
                    {"\"object\", as uint32", "scale or a bias"});
    expect_mentions(refused({{"uv.u", {.encoding = octahedral8, .memory = "n"}}}), {"no part of the normal"});
    expect_mentions(refused({{"crypto.id0", {.encoding = half}}}), {"crypto.id0", "bits of Cryptomatte's ids"});
    PlaneFormats two = interleaved("n", octahedral16, {"normal.x", "normal.y", "normal.z"});
    two.erase("normal.z");
    expect_mentions(refused(two), {"\"normal.z\" must have the same format"});
    two = interleaved("a", half, {"uv.u", "uv.v"});
    two["uv.v"].stride = 8;
    expect_mentions(refused(two), {"\"uv.u\" and \"uv.v\" share the memory \"a\"", "4 and 8 bytes"});
    expect_mentions(refused(interleaved("depth", half, {"uv.u", "uv.v"})), {"called \"depth\"", "lies elsewhere"});
    EXPECT_THROW(interleaved("n", octahedral16, {"normal.x", "normal.y", "normal.z", ""}), Error);
    const auto output = [](const PlaneFormats& formats) {
        try {
            make_plan(noise_scene(), everything(), {.output_formats = formats});
        } catch (const Error& error) { return std::string(error.what()); }
        return std::string("nothing was refused");
    };
    expect_mentions(output({{"marked", {.encoding = unorm8}}}), {"formats of outputs", "no plane \"marked\""});
    two = interleaved("a", half, {"normal.x", "normal.y"});
    two["normal.y"].offset = 0;
    expect_mentions(output(two), {"same bytes", "\"a\""});
}

}  // namespace
}  // namespace wrinkle::test
