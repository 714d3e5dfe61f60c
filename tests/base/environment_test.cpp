#include "base/environment.h"

#include <gtest/gtest.h>

#include <cstdlib>

#include "wrinkle/error.h"
#include "wrinkle/limits.h"

namespace wrinkle {
namespace {

TEST(Environment, VariablesAreReplacedAndFrameNumbersAreNot) {
    ::setenv("WRINKLE_TEST_SHOW", "show", 1);
    EXPECT_EQ(with_environment("/$WRINKLE_TEST_SHOW/a"), "/show/a");
    EXPECT_EQ(with_environment("${WRINKLE_TEST_SHOW}_2/$F4.$F.exr"), "show_2/$F4.$F.exr");
    EXPECT_EQ(with_environment("costs 5$, $1"), "costs 5$, $1");
}

TEST(Environment, WhatIsNotSetIsRefused) {
    ::unsetenv("WRINKLE_TEST_SHOW");
    EXPECT_THROW(with_environment("$WRINKLE_TEST_SHOW/a"), Error);
}

TEST(Environment, NothingIsToldInASandbox) {
    ::setenv("WRINKLE_TEST_SHOW", "show", 1);
    set_limits({.memory = 0, .sandbox = "/tmp", .volume_reader = {}});
    EXPECT_THROW(with_environment("$WRINKLE_TEST_SHOW/a"), Error);
    set_limits({});
    EXPECT_NO_THROW(with_environment("$WRINKLE_TEST_SHOW/a"));
}

}  // namespace
}  // namespace wrinkle
