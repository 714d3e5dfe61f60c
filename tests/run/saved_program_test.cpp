// A pass that is only ever enqueued leaves its program in the cache as well.
#include "tests/device/environment.h"
#include "tests/io/files.h"
#include "tests/run/run_frame.h"

namespace wrinkle::test {
namespace {

TEST(SavedProgram, OfAPassThatIsOnlyEnqueued) {
    const TempFolder cache;
    const Variable folder("WRINKLE_CACHE_DIR", cache / "");
    const HostFrame frame = small_frame();
    Scene scene;
    scene.filter.taps = 1;
    scene.layers.resize(1);
    scene.layers[0].name = "tilt";
    scene.layers[0].bump = ConstantLayer{{0.1, 0, 0}};
    std::vector<std::string> kept;
    {
        Pass pass = evaluate(device(), scene, frame.frame);
        DevicePlanes in, out;
        for (const std::string& name : pass.inputs())
            in[name] = cl::Buffer(device().context, CL_MEM_READ_ONLY | CL_MEM_COPY_HOST_PTR,
                                  frame.count() * sizeof(float), const_cast<float*>(frame.pixels.at(name).data()));
        for (const std::string& name : pass.outputs())
            out[name] = cl::Buffer(device().context, CL_MEM_READ_WRITE, (frame.count() + 64) * sizeof(float));
        pass.enqueue(in, out).wait();
        EXPECT_TRUE(cache.files().empty());
        pass.enqueue(in, out).wait();
        kept = cache.files();
        EXPECT_EQ(kept.size(), 1u);
    }
    EXPECT_EQ(cache.files(), kept);
}

}  // namespace
}  // namespace wrinkle::test
