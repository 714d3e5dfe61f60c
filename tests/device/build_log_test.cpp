#include "device/build_log.h"

#include <gtest/gtest.h>

namespace wrinkle {
namespace {

TEST(BuildLog, TellsFileLineAndWhatIsWrong) {
    EXPECT_EQ(build_errors("error: /a b/dents.clh:24:52: no member named 'deep' in 'dents_parameters'\nDevice X failed"),
              "/a b/dents.clh:24: no member named 'deep' in 'dents_parameters'");
    EXPECT_EQ(build_errors("dents.clh:3:1: warning: unused\ndents.clh:7:9: error: expected ';': here\n  x\n  ^"),
              "dents.clh:7: expected ';': here");
    EXPECT_EQ(build_errors("dents.clh:1:2: error: a\nevaluate.cl:3:4: error: b\n2 errors generated."),
              "dents.clh:1: a\nevaluate.cl:3: b");
}

TEST(BuildLog, IsToldWholeWhereItIsOfAnotherForm) {
    EXPECT_EQ(build_errors("(3) : something else"), "(3) : something else");
    EXPECT_EQ(build_errors(""), "");
    EXPECT_EQ(build_errors("error: linking failed"), "error: linking failed");
}

}  // namespace
}  // namespace wrinkle
