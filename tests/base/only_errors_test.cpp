// Whatever work throws leaves as Error, and says what was being done.
#include "base/only_errors.h"

#include <gtest/gtest.h>

#include <vector>

namespace wrinkle {
namespace {

template <class Thrown>
std::string thrown_as_error(const Thrown& thrown) {
    try {
        only_errors("load a thing", [&]() -> int { throw thrown; });
    } catch (const Error& error) { return error.what(); }
    return "no Error";
}

TEST(OnlyErrors, Leave) {
    EXPECT_EQ(thrown_as_error(Error("thing.toml:3: no number")), "thing.toml:3: no number") << "is one as it is";
    EXPECT_EQ(thrown_as_error(std::bad_alloc()), "load a thing: out of memory");
    EXPECT_EQ(thrown_as_error(std::runtime_error("odd")), "load a thing: odd");
    const std::filesystem::filesystem_error loop("status", "a.exr", std::make_error_code(std::errc::permission_denied));
    EXPECT_EQ(thrown_as_error(loop), "load a thing: a.exr: Permission denied");
}

TEST(OnlyErrors, ResultsAsTheyAre) {
    std::vector<int> values{1, 2};
    EXPECT_EQ(only_errors("read", [&] { return values.size(); }), 2u);
    only_errors("find", [&]() -> int& { return values[1]; }) = 5;
    EXPECT_EQ(values[1], 5);
}

}  // namespace
}  // namespace wrinkle
