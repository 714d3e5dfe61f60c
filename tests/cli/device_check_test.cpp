// "devices --check": right here, wrong where a kernel is, and alive where a driver is not. (The checks:
// tests/selftest.)
#include <nlohmann/json.hpp>

#include "tests/cli/cli.h"

namespace wrinkle::test {
namespace {

/// The kernels as they are, with `text` in place of what resolve() computes.
std::string kernels_that_resolve(const Workplace& place, const std::string& text) {
    fs::copy(fs::path(WRINKLE_SOURCE_DIR) / "kernels", place / "kernels", fs::copy_options::recursive);
    const fs::path file = place / "kernels/compose/resolve.clh";
    std::string source = read_text(file);
    const std::string right = "{ return wr_normalize(wr_sub(n, g)); }";
    const std::size_t at = source.find(right);
    if (at == std::string::npos) throw std::runtime_error("resolve.clh is another");
    write_text(file, source.replace(at, right.size(), text));
    return "WRINKLE_KERNEL_DIR=kernels";
}

std::string on_device(const std::string& arguments) {
    return "devices --check " + arguments + (test_device_name().empty() ? "" : " --device " + test_device_name());
}

TEST(DeviceCheck, TellsOfTheDeviceAndOfEveryError) {
    const Workplace place;
    const Ran ran = place.run(on_device("--only resolve"));
    EXPECT_EQ(ran.code, 0) << ran.err;
    expect_mentions(ran.out, {"wrinkle ", "driver", "OpenCL C", "ok     function resolve, standard",
                              "degrees, 1e-05 at most", "ok     scene resolve", "are within their bounds, 0 are not"});
    const auto json = nlohmann::json::parse(place.run(on_device("--only transfers --json")).out);
    EXPECT_EQ(json.at("wrong"), 0);
    EXPECT_EQ(json.at("not_checked"), 0);
    EXPECT_EQ(json.at("checks").at(0).at("findings").at(0).at("error"), 0);
    EXPECT_FALSE(json.at("device").at("driver").get<std::string>().empty());
}

TEST(DeviceCheck, FailsWhereAKernelIsWrong) {
    const Workplace place;
    const std::string wrong =
        kernels_that_resolve(place, "{ return wr_normalize(wr_sub(n, wr_scale(g, WR_R(1.001)))); }");
    const Ran ran = place.run(on_device("--only 'function resolve,'"), wrong);
    EXPECT_EQ(ran.code, 1);
    expect_mentions(ran.out, {"WRONG  function resolve, standard", "0 of 1 checks are within their bounds, 1 are not"});
    expect_mentions(ran.err, {"wrinkle: the device is out of bounds in 1 of 1 checks"});
}

TEST(DeviceCheck, FailsWhereSomeResultsAreNotFinite) {
    const Workplace place;
    const std::string some = kernels_that_resolve(
        place, "{ wr_vec3 r = wr_normalize(wr_sub(n, g)); r.x = g.x < 0 ? (wr_real)(NAN) : r.x; return r; }");
    const Ran ran = place.run(on_device("--only 'function resolve,'"), some);
    EXPECT_EQ(ran.code, 1);
    expect_mentions(ran.out, {"WRONG  function resolve, standard", "not finite"});
}

TEST(DeviceCheck, GoesOnWhereADriverCrashes) {
    const Workplace place;
    const std::string crash =
        kernels_that_resolve(place, "{ *(global volatile int *)8 = 1; return wr_normalize(wr_sub(n, g)); }");
    const Ran ran = place.run(on_device("--only 'function resolve'"), crash);
    EXPECT_EQ(ran.code, 1);
    expect_mentions(ran.out, {"WRONG  function resolve, standard", "the driver crashed (signal 11)",
                              "ok     function resolve_object"});
}

TEST(DeviceCheck, SaysWhatItDoesNotKnow) {
    const Workplace place;
    expect_failed(place.run("devices --check --device nothing"), {"nothing", "0: "});
    expect_failed(place.run("devices --check --only nothing"), {"no check has \"nothing\" in its name"});
    expect_failed(place.run("devices --only scene"), {"--check"});
}

}  // namespace
}  // namespace wrinkle::test
