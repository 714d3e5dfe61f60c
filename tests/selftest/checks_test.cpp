// What "devices --check" asks is right here, and wrong where a kernel is. (The command:
// tests/cli/device_check_test.cpp.)
#include "selftest/checks.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "selftest/errors.h"
#include "tests/device/test_device.h"

namespace wrinkle::test {
namespace {

using selftest::Check;
using selftest::Finding;

void expect_good(const std::vector<Check>& checks) {
    ASSERT_FALSE(checks.empty());
    for (const Check& check : checks) {
        const std::vector<Finding> findings = check.run(test_device());
        EXPECT_FALSE(findings.empty()) << check.name;
        for (const Finding& f : findings)
            EXPECT_TRUE(f.good()) << check.name << ", " << f.what << ": " << f.error << ' ' << f.unit << ", " << f.bound
                                  << " at most";
    }
}

TEST(Checks, FindNothingWrongWithTransfersAndLaunches) {
    expect_good(selftest::transfer_checks());
    expect_good(selftest::launch_checks());
}

// Scenes are those whose kernels no other test has; functions' kernels, each a build, are those that their own tests
// have built.
TEST(Checks, FindNothingWrongWithScenes) { expect_good(selftest::scene_checks()); }

TEST(Checks, FindNothingWrongWithSomeFunctions) {
    std::vector<Check> some = selftest::function_checks(true);
    std::erase_if(some, [](const Check& check) {
        return !check.name.starts_with("function resolve") && !check.name.starts_with("function projector");
    });
    expect_good(some);
}

TEST(Checks, CoverEveryFunctionInEveryPrecision) {
    std::size_t variants = 0;
    for (const Function& function : functions())
        if (function.file != "sources/volume.clh") variants += function.variants.size();
    EXPECT_EQ(selftest::function_checks(true).size() + selftest::function_checks(false).size(), variants);
}

TEST(Finding, IsNotGoodWhereNothingIsFinite) {
    EXPECT_TRUE((Finding{"normal", "degrees", 1, 1}.good()));
    EXPECT_FALSE((Finding{"normal", "degrees", 2, 1}.good()));
    EXPECT_FALSE((Finding{"normal", "degrees", std::numeric_limits<double>::quiet_NaN(), 1}.good()));
}

TEST(Errors, AreThoseOfTheDocumentation) {
    const Vec3 x{1, 0, 0}, y{0, 2, 0}, none{};
    EXPECT_NEAR(selftest::error_of(ErrorMeasure::degrees, x, y, none), 90, 1e-12);
    EXPECT_EQ(selftest::error_of(ErrorMeasure::degrees, none, x, none), 180);
    EXPECT_EQ(selftest::error_of(ErrorMeasure::degrees, none, none, none), 0);
    EXPECT_NEAR(selftest::error_of(ErrorMeasure::relative, {0, 3, 0}, y, none), 0.5, 1e-15);
    EXPECT_NEAR(selftest::error_of(ErrorMeasure::relative, y, none, none), 2, 1e-15);
    EXPECT_NEAR(selftest::error_of(ErrorMeasure::absolute, x, y, none), std::sqrt(5), 1e-15);
    EXPECT_NEAR(selftest::error_of(ErrorMeasure::resolved_degrees, x, none, {0, 0, 1}), 45, 1e-12);
}

}  // namespace
}  // namespace wrinkle::test
