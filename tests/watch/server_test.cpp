// Who may ask the page's server for anything.
#include "watch/server.h"

#include <gtest/gtest.h>

namespace wrinkle {
namespace {

constexpr int kPort = 8080;

TEST(WatchServer, AnswersUnderItsOwnNameOnly) {
    for (const char* host : {"127.0.0.1:8080", "localhost:8080"})
        EXPECT_EQ(why_refused({"GET", host, "", ""}, kPort), "") << host;
    for (const char* host : {"", "127.0.0.1", "127.0.0.1:80", "evil.example:8080", "127.0.0.1:8080.evil.example",
                             "localhost:8081", "127.0.0.1:8080 "})
        EXPECT_NE(why_refused({"GET", host, "", ""}, kPort), "") << host;
}

TEST(WatchServer, OnlyThePageItselfChangesAnything) {
    const std::string here = "127.0.0.1:8080";
    EXPECT_EQ(why_refused({"POST", here, "http://127.0.0.1:8080", "same-origin"}, kPort), "");
    EXPECT_EQ(why_refused({"POST", here, "http://127.0.0.1:8080", ""}, kPort), "");
    for (const char* origin :
         {"", "null", "http://evil.example", "http://localhost:8080", "https://127.0.0.1:8080", "http://127.0.0.1"})
        EXPECT_NE(why_refused({"POST", here, origin, ""}, kPort), "") << origin;
    EXPECT_NE(why_refused({"POST", here, "http://127.0.0.1:8080", "cross-site"}, kPort), "");
    EXPECT_NE(why_refused({"PUT", here, "http://127.0.0.1:8080", "same-origin"}, kPort), "");
}

TEST(WatchServer, PicturesAreNotForOtherSites) {
    EXPECT_EQ(why_refused({"GET", "localhost:8080", "", "none"}, kPort), "");
    EXPECT_EQ(why_refused({"GET", "localhost:8080", "", "same-origin"}, kPort), "");
    for (const char* site : {"cross-site", "same-site"})
        EXPECT_NE(why_refused({"GET", "localhost:8080", "", site}, kPort), "") << site;
}

}  // namespace
}  // namespace wrinkle
