// The program cache, kernel files given by the user, and how build errors read.
#include "device/program.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <fstream>

#include "device/kernel_sources.h"
#include "tests/device/environment.h"
#include "tests/device/test_device.h"
#include "tests/io/files.h"
#include "wrinkle/error.h"
#include "wrinkle/passes.h"

namespace wrinkle {
namespace {

namespace fs = std::filesystem;
using test::TempFolder, test::Variable;

const Device& device() { return test::test_device(); }

const std::string text = "kernel void fill(global float *out) { out[get_global_id(0)] = 40 + get_global_id(0); }\n";

/// Runs a program's kernel on four work-items and gives what the last one wrote.
float filled(BuiltProgram& built) {
    cl::Kernel kernel(built.program, "fill");
    const cl::Buffer out(device().context, CL_MEM_WRITE_ONLY, 4 * sizeof(float));
    kernel.setArg(0, out);
    device().queue.enqueueNDRangeKernel(kernel, cl::NullRange, cl::NDRange(4));
    float values[4] = {};
    device().queue.enqueueReadBuffer(out, CL_TRUE, 0, sizeof values, values);
    return values[3];
}

void write(const fs::path& file, const std::string& content) { std::ofstream(file, std::ios::binary) << content; }

std::string read(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

/// Builds a program. Expects that it came from `source`, works, and is in the cache afterwards.
BuiltProgram expect_built(BuildSource source, const char* what) {
    BuiltProgram built = build_program(device(), text, {.lanes = 1});
    EXPECT_EQ(built.source == BuildSource::disk, source == BuildSource::disk) << what;
    EXPECT_EQ(filled(built), 43) << what;
    save_program(built);
    return built;
}

TEST(Cache, SecondBuildComesFromDisk) {
    const TempFolder folder;
    const Variable variable("WRINKLE_CACHE_DIR", folder / "cache");
    const fs::path file = expect_built(BuildSource::compiled, "first").cache_file;
    EXPECT_TRUE(fs::exists(file)) << file;
    EXPECT_EQ(file.parent_path(), folder / "cache");
    expect_built(BuildSource::disk, "second");
    EXPECT_EQ(build_program(device(), text, {.lanes = 4}).source, BuildSource::compiled) << "other options";
    EXPECT_EQ(build_program(device(), text + "\n", {.lanes = 1}).source, BuildSource::compiled) << "other source";
    EXPECT_EQ(std::distance(fs::directory_iterator(folder / "cache"), {}), 1) << "nothing is left beside the program";
}

TEST(Cache, DamagedFilesAreBuiltAnew) {
    const TempFolder folder;
    const Variable variable("WRINKLE_CACHE_DIR", folder / "cache");
    const fs::path file = expect_built(BuildSource::compiled, "first").cache_file;
    const std::string good = read(file);
    ASSERT_GT(good.size(), 200u);
    std::string flipped = good, foreign = good;
    flipped[good.size() / 2] ^= 1;
    foreign[0] = 'W';
    for (const auto& [what, bad] : std::map<std::string, std::string>{{"empty", ""},
                                                                      {"truncated", good.substr(0, good.size() / 2)},
                                                                      {"header only", good.substr(0, 50)},
                                                                      {"a bit flipped", flipped},
                                                                      {"another format", foreign},
                                                                      {"longer", good + "x"}}) {
        write(file, bad);
        expect_built(BuildSource::compiled, what.c_str());
        expect_built(BuildSource::disk, what.c_str());
    }
}

TEST(Cache, FoldersThatCannotBeWrittenAreNoError) {
    const TempFolder folder;
    write(folder / "file", "in the way");
    const Variable variable("WRINKLE_CACHE_DIR", folder / "file/cache");  // below a file, where even root cannot write
    expect_built(BuildSource::compiled, "first");
    expect_built(BuildSource::compiled, "second");
    EXPECT_EQ(read(folder / "file"), "in the way");
}

TEST(KernelSources, AreIncludedOnceAndKeepTheirLines) {
    const std::string twice = "#include \"vec.clh\"\nint a;\n#include \"vec.clh\"\nint b;\n";
    const std::string expanded = expand_includes(twice, "test.cl");
    const std::string vec = "#line 1 \"vec.clh\"\n";
    EXPECT_NE(expanded.find(vec), std::string::npos);
    EXPECT_EQ(expanded.find(vec), expanded.rfind(vec));
    EXPECT_NE(expanded.find("#line 2 \"test.cl\"\nint a;\n#line 4 \"test.cl\"\nint b;\n"), std::string::npos);
    EXPECT_EQ(expanded.find("#include \""), std::string::npos);
    EXPECT_THROW(expand_includes("#include \"no_such.clh\"\n", "test.cl"), Error);
}

TEST(KernelSources, EmbeddedOnesAreTheFiles) {
    for (const KernelSource& source : embedded_kernel_sources())
        EXPECT_EQ(source.text, read(fs::path(WRINKLE_SOURCE_DIR) / "kernels" / source.name)) << source.name;
}

TEST(KernelSources, FolderOfTheUserReplacesThem) {
    const TempFolder folder;
    const Variable cache("WRINKLE_CACHE_DIR", folder / "cache"), kernels("WRINKLE_KERNEL_DIR", folder / "kernels");
    fs::copy(fs::path(WRINKLE_SOURCE_DIR) / "kernels", folder / "kernels", fs::copy_options::recursive);
    Camera camera = Camera::look_at({0, 0, 5}, {0, 0, 0}, {0, 1, 0}, 1, 1);
    Scene scene;
    scene.layers.resize(1);
    scene.layers[0].bump = ConstantLayer{{1, 0, 0}};
    const std::vector<float> zero{0}, five{5}, one{1};
    const auto bumped = [&] {
        Pass pass = evaluate(device(), scene, {{1, 1}, camera, {"depth", "normal.x", "normal.y", "normal.z"}});
        float x = 0, y = 0, z = 0;
        const HostOutputs out{{"normal.x", {&x, 1}}, {"normal.y", {&y, 1}}, {"normal.z", {&z, 1}}};
        pass.run({{"depth", five}, {"normal.x", zero}, {"normal.y", zero}, {"normal.z", one}}, out);
        return x;
    };
    EXPECT_NEAR(bumped(), -std::sqrt(0.5), 1e-6);

    const fs::path resolve = folder / "kernels/compose/resolve.clh";
    std::string source = read(resolve);
    const std::string call = "wr_sub(n, g)";
    ASSERT_NE(source.find(call), std::string::npos);
    source.replace(source.find(call), call.size(), "wr_add(n, g)");
    write(resolve, source);
    EXPECT_NEAR(bumped(), std::sqrt(0.5), 1e-6) << "the edited file counts, not a cached program";

    const auto lines = std::count(source.begin(), source.end(), '\n');
    write(resolve, source + "this is no OpenCL;\n");
    try {
        bumped();
        FAIL() << "broken source was built";
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find(fmt::format("compose/resolve.clh:{}", lines + 1)), std::string::npos)
            << error.what();
    }
    fs::remove(resolve);
    EXPECT_THROW(bumped(), Error);
}

TEST(Devices, AreFoundByNumberTypeAndName) {
    const std::vector<DeviceInfo> list = list_devices();
    ASSERT_FALSE(list.empty());
    EXPECT_EQ(Device::open("0").info.name, list[0].name);
    EXPECT_EQ(Device::open(list[0].type).info.type, list[0].type);
    EXPECT_EQ(Device::open(list[0].name).info.name, list[0].name);
    try {
        Device::open("no such device");
        FAIL() << "opened";
    } catch (const Error& error) { EXPECT_NE(std::string(error.what()).find(list[0].name), std::string::npos); }
}

}  // namespace
}  // namespace wrinkle
