#include "resources/texture_store.h"

#include "budget/error_sample.h"
#include "run/condition.h"
#include "tests/run/run_frame.h"

namespace wrinkle::test {
namespace {

PlannedTexture planned(const char* file, TexelKind kind = TexelKind::slope) {
    return {.use = {.file = data_folder / "textures" / file}, .kind = kind};
}

TEST(TextureStore, LoadsWhatSeveralPassesWantOnce) {
    TextureStore store(device());
    const auto first = store.get({planned("seal_height.png"), planned("rock_height.png")});
    PlannedTexture other = planned("seal_height.png");
    other.layer = "layer \"of another name\"";
    EXPECT_EQ(store.get({other, planned("rock_height.png")}), first);
    EXPECT_EQ(store.loads(), 1u);
}

TEST(TextureStore, TellsUsesApart) {
    TextureStore store(device());
    const auto slopes = store.get({planned("seal_height.png")});
    EXPECT_NE(store.get({planned("seal_height.png", TexelKind::height)}), slopes);
    PlannedTexture clamped = planned("seal_height.png"), part = clamped;
    clamped.use.wrap = Wrap::clamp;
    part.region = {0, 0, 0.5, 0.5};
    EXPECT_NE(store.get({clamped}), slopes);
    EXPECT_NE(store.get({part}), slopes);
    EXPECT_NE(store.get({planned("rock_height.png")}), slopes);
    EXPECT_EQ(store.loads(), 5u);
}

/// A pass, the one in double that measures it, and the condition of its normals.
TEST(TextureStore, IsSharedByThePassesOfARun) {
    TextureStore store(device());
    const HostFrame frame = small_frame();
    const Scene scene = data_scene("height_map");
    const Pass pass = evaluate(device(), scene, frame.frame, {}, &store);
    const ErrorSample sample(device(), scene, frame.frame, {.max_error = 1, .sample = 64, .seed = 1}, &store);
    const Condition condition(device(), scene, frame.frame, &store);
    EXPECT_EQ(store.loads(), 1u);
}

}  // namespace
}  // namespace wrinkle::test
