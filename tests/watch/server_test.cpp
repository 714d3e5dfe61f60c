// Who may ask the page's server for anything.
#include "watch/server.h"

#include <gtest/gtest.h>
#include <httplib.h>

#include <fmt/format.h>

#include <thread>

#include "watch/board.h"

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

/// The same over a socket: nothing of the above helps a server that does not ask.
TEST(WatchServer, RefusesOthersOverItsSocket) {
    WatchBoard board;
    board.show({1, "{}", nullptr});
    WatchServer server(board, 0);
    std::jthread serving([&] { server.serve(); });
    httplib::Client client("127.0.0.1", server.port());
    const std::string here = fmt::format("127.0.0.1:{}", server.port());
    const auto status = [](const httplib::Result& result) { return result ? result->status : 0; };
    EXPECT_EQ(status(client.Get("/state?after=0")), 200);
    EXPECT_EQ(status(client.Get("/state?after=0", {{"Host", "evil.example"}})), 403);
    EXPECT_EQ(status(client.Get("/state?after=0", {{"Sec-Fetch-Site", "cross-site"}})), 403);
    EXPECT_EQ(status(client.Post("/numbers", "{}", "application/json")), 403);
    EXPECT_EQ(status(client.Post("/numbers", {{"Origin", "http://evil.example"}}, "{}", "application/json")), 403);
    EXPECT_EQ(status(client.Post("/numbers", {{"Origin", "http://" + here}}, "nonsense", "application/json")), 400);
    for (const char* path :
         {"/picture/../scene.toml", "/scene.toml", "/picture/%2e%2e%2fscene.toml", "/picture/normal"})
        EXPECT_EQ(status(client.Get(path)), 404) << path;
    board.stop();
    server.stop();
}

}  // namespace
}  // namespace wrinkle
