// The rooms of host/: each includes only itself and what stands before it in the list.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <regex>
#include <string>
#include <string_view>

namespace wrinkle {
namespace {

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 17> kRooms{"wrinkle",   "base",      "io",       "scene",  "plan",  "layers",
                                                  "device",    "resources", "run",      "budget", "tools", "look",
                                                  "functions", "python",    "selftest", "watch",  "cli"};

std::size_t place_of(std::string_view room) {
    return static_cast<std::size_t>(std::ranges::find(kRooms, room) - kRooms.begin());
}

/// The room that an include names; empty for a file without a folder, which is of kernels/ or generated.
std::string room_of(const std::string& include) {
    const std::size_t slash = include.find('/');
    return slash == std::string::npos ? std::string{} : include.substr(0, slash);
}

TEST(Rooms, IncludeOnlyWhatStandsBeforeThem) {
    const fs::path host = fs::path(WRINKLE_SOURCE_DIR) / "host";
    const std::regex pattern(R"re(^\s*#\s*include\s*"([^"]+)")re");
    std::size_t includes = 0;
    for (const auto& folder : fs::directory_iterator(host)) {
        if (!folder.is_directory()) continue;
        const std::string room = folder.path().filename().string();
        const std::size_t place = place_of(room);
        EXPECT_LT(place, kRooms.size()) << "host/" << room
                                        << " is in no list: say in this test and in DESIGN where it stands";
        for (const auto& file : fs::recursive_directory_iterator(folder)) {
            if (!file.is_regular_file()) continue;
            std::ifstream lines(file.path());
            std::string line;
            std::smatch found;
            for (int number = 1; std::getline(lines, line); ++number) {
                if (!std::regex_search(line, found, pattern)) continue;
                ++includes;
                const std::string include = found[1], other = room_of(include);
                const std::string where = fs::relative(file.path(), host).string() + ":" + std::to_string(number);
                if (other.empty())
                    EXPECT_FALSE(fs::exists(folder.path() / include))
                        << where << " includes \"" << include << "\" without its folder; write \"" << room << "/"
                        << include << "\"";
                else
                    EXPECT_LE(place_of(other), place)
                        << where << " includes \"" << include << "\": " << room << "/ may not know " << other << "/";
            }
        }
    }
    EXPECT_GT(includes, 500u) << "the includes were not found: has the folder moved?";
}

}  // namespace
}  // namespace wrinkle
