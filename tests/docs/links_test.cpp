#include <gtest/gtest.h>

#include <cctype>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;

const fs::path kRoot = WRINKLE_SOURCE_DIR;

/// The lines of a page without its code. Lines of code blocks become empty, so that line numbers stay right.
std::vector<std::string> text_lines(const fs::path& file) {
    static const std::regex code_span("`[^`]*`");
    std::vector<std::string> lines;
    bool fenced = false;
    std::ifstream in(file);
    for (std::string line; std::getline(in, line);) {
        const bool fence = line.starts_with("```");
        fenced ^= fence;
        const bool code = fence || fenced || line.starts_with("    ");
        lines.push_back(code ? "" : std::regex_replace(line, code_span, ""));
    }
    return lines;
}

/// The anchor that GitHub gives a heading: lower case, blanks as hyphens, no punctuation.
std::string anchor_of(const std::string& heading) {
    std::string anchor;
    for (const char c : heading) {
        const auto byte = static_cast<unsigned char>(c);
        if (c == ' ')
            anchor += '-';
        else if (std::isalnum(byte) != 0 || c == '-' || c == '_' || byte >= 128)
            anchor += static_cast<char>(std::tolower(byte));
    }
    return anchor;
}

std::set<std::string> anchors_of(const fs::path& file) {
    static const std::regex title("#+ +(.*)"), link("\\[([^\\]]*)\\]\\([^)]*\\)");
    std::set<std::string> anchors;
    std::map<std::string, int> seen;
    std::ifstream in(file);
    for (std::string line; std::getline(in, line);) {
        std::smatch heading;
        if (!std::regex_match(line, heading, title)) continue;
        const std::string anchor = anchor_of(std::regex_replace(heading[1].str(), link, "$1"));
        const int before = seen[anchor]++;
        anchors.insert(before == 0 ? anchor : anchor + "-" + std::to_string(before));
    }
    return anchors;
}

/// The pages of the repository, without those in folders that are not part of it.
std::vector<fs::path> pages() {
    const std::set<std::string> foreign{"build", "out", "shared", ".git"};
    std::vector<fs::path> found;
    for (auto entry = fs::recursive_directory_iterator(kRoot); entry != fs::recursive_directory_iterator(); ++entry) {
        if (entry.depth() == 0 && foreign.contains(entry->path().filename().string()))
            entry.disable_recursion_pending();
        else if (entry->path().extension() == ".md")
            found.push_back(entry->path());
    }
    return found;
}

/// What is wrong with a link; empty when it leads somewhere.
std::string fault(const fs::path& page, const std::string& target) {
    const std::size_t hash = target.find('#');
    const std::string path = target.substr(0, hash);
    const fs::path file = path.empty() ? page : (page.parent_path() / path).lexically_normal();
    if (!fs::exists(file)) return "there is no " + file.string();
    if (file.lexically_relative(kRoot).string().starts_with("..")) return "it leads out of the repository";
    if (hash == std::string::npos) return "";
    const std::string anchor = target.substr(hash + 1);
    return anchors_of(file).contains(anchor) ? "" : "there is no heading #" + anchor + " in " + file.string();
}

TEST(Pages, LinkToWhatIsThere) {
    static const std::regex link("\\]\\(([^)\\s]+)\\)");
    std::size_t links = 0;
    for (const fs::path& page : pages()) {
        const std::vector<std::string> lines = text_lines(page);
        for (std::size_t i = 0; i < lines.size(); ++i)
            for (std::sregex_iterator match(lines[i].begin(), lines[i].end(), link), end; match != end; ++match) {
                const std::string target = (*match)[1];
                if (target.find("://") != std::string::npos) continue;
                ++links;
                EXPECT_EQ(fault(page, target), "") << page.string() << ":" << i + 1 << ": " << target;
            }
    }
    EXPECT_GT(links, 50u) << "pages were not found, or links are no longer recognised";
}

TEST(Pages, AnchorsAreGitHubs) {
    EXPECT_EQ(anchor_of("Your own frame, in five minutes"), "your-own-frame-in-five-minutes");
    EXPECT_EQ(anchor_of("How fast & how wrong?"), "how-fast--how-wrong");
}

TEST(Pages, ReadmeIsReadInOneGo) {
    std::ifstream in(kRoot / "README.md");
    std::size_t lines = 0;
    for (std::string line; std::getline(in, line);) ++lines;
    EXPECT_LE(lines, 200u) << "move details to the README of the folder that they are about";
    EXPECT_GT(lines, 0u);
}

}  // namespace
