// The page: hostile names stay text, and messages find their lines.
#include "look/page.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "look/look_data.h"

namespace wrinkle {
namespace {

using nlohmann::json;

std::size_t count(const std::string& text, const std::string& part) {
    std::size_t found = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
    return found;
}

TEST(Page, NamesEndNothing) {
    const std::string hostile = "</script><script>alert(1)</script><!-- @JS@ @CSS@ \xff \xe2\x80\xa8";
    const std::string harmless = page_of({{"title", "scene"}}, false), page = page_of({{"title", hostile}}, false);
    EXPECT_EQ(count(page, "<script"), count(harmless, "<script"));
    EXPECT_EQ(count(page, "</script"), count(harmless, "</script"));
    EXPECT_EQ(count(page, "<!--"), count(harmless, "<!--"));
    EXPECT_EQ(count(page, "\"use strict\""), 1u);
    const std::string begin = "<script type=\"application/json\" id=\"data\">";
    const std::size_t at = page.find(begin) + begin.size();
    const json data = json::parse(page.substr(at, page.find("</script>", at) - at));
    EXPECT_EQ(data["title"].get<std::string>().substr(0, 8), "</script");
}

TEST(Page, IsOneFileAndOnlyTheLiveOneAsksForMore) {
    const std::string report = page_of({}, false), live = page_of({}, true);
    EXPECT_EQ(report.find("fetch("), std::string::npos);
    EXPECT_NE(live.find("fetch("), std::string::npos);
    for (const char* other : {"src=\"", "href=\"http", "@import", "@CSS@", "@DATA@", "@JS@"})
        EXPECT_EQ(live.find(other), std::string::npos) << other;
}

TEST(Page, MessagesBelongToLines) {
    const json problems =
        problems_of("a:b/scene.toml:12: no such key\na:b/scene.toml:7:3: not TOML\nother.cl:1: odd", "a:b/scene.toml");
    ASSERT_EQ(problems.size(), 3u);
    EXPECT_EQ(problems[0], (json{{"line", 12}, {"text", "no such key"}}));
    EXPECT_EQ(problems[1]["line"], 7);
    EXPECT_EQ(problems[2], (json{{"line", 0}, {"text", "other.cl:1: odd"}}));
    EXPECT_EQ(problems_of("", "scene.toml"), json::array());
}

}  // namespace
}  // namespace wrinkle
