// kernel_listing.h: what the reference page says of the kernel files is what stands in them, and nothing public is left
// out of it.
#include "functions/kernel_listing.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <regex>
#include <set>

#include "device/kernel_sources.h"

namespace wrinkle::test {
namespace {

std::string without_spaces(std::string text) {
    std::erase_if(text, [](char c) { return c == ' ' || c == '\n' || c == ';'; });
    return text;
}

std::string name_of(const std::string& declaration) {
    static const std::regex name("(wr_\\w+)\\(");
    std::smatch found;
    return std::regex_search(declaration, found, name) ? found[1].str() : "";
}

std::set<std::string> words(const std::string& text) {
    static const std::regex word("\\bwr_\\w+");
    std::set<std::string> found;
    for (std::sregex_iterator at(text.begin(), text.end(), word), end; at != end; ++at) found.insert(at->str());
    return found;
}

std::string without_comments(const std::string& text) { return std::regex_replace(text, std::regex("//[^\n]*"), ""); }

TEST(KernelItems, AreOverloadsTogetherAndWhatMacrosDefine) {
    const std::vector<KernelItem> items = kernel_items(
        "// A file.\n\n/// Twice\n///   v  a number\nwr_fn wr_real twice(wr_real v) { return 2 * v; }\n"
        "wr_fn wr_vec2 twice(wr_vec2 v,\n                    wr_vec2 unused)\n{\n    return v;\n}\n\n"
        "wr_fn int inner(int v) { return v; }\n\n/// By macro.\n#define WR_MAKE(NAME, BY)   \\\n"
        "    wr_fn int NAME(int v,   \\\n                   int w)   \\\n    {                       \\\n    }\n"
        "WR_MAKE(first, 1)\nWR_MAKE(second, 2)\n\n/// A struct.\ntypedef struct {\n    int a;\n} wr_thing;\n");
    ASSERT_EQ(items.size(), 3U);
    EXPECT_EQ(items[0].comment, "/// Twice\n///   v  a number\n");
    EXPECT_EQ(items[0].declarations, (std::vector<std::string>{"wr_real twice(wr_real v);",
                                                               "wr_vec2 twice(wr_vec2 v,\n"
                                                               "              wr_vec2 unused);"}));
    EXPECT_EQ(items[1].declarations, (std::vector<std::string>{"int first(int v,\n          int w);",
                                                               "int second(int v,\n           int w);"}));
    EXPECT_EQ(items[2].declarations, (std::vector<std::string>{"typedef struct {\n    int a;\n} wr_thing;"}));
    EXPECT_FALSE(items[2].function);
}

TEST(KernelItems, StandInTheFilesAsTheyAreListed) {
    for (const KernelSource& source : embedded_kernel_sources()) {
        const std::string text = without_spaces(source.text);
        for (const KernelItem& item : kernel_items(source.text)) {
            const bool macro = std::string(source.text).find("(NAME") != std::string::npos;
            for (const std::string& declaration : item.declarations) {
                EXPECT_FALSE(declaration.starts_with("#if")) << source.name << ": " << item.comment;
                EXPECT_TRUE(macro || text.find(without_spaces(declaration)) != std::string::npos)
                    << source.name << ": " << declaration;
            }
        }
    }
}

TEST(KernelItems, DescribeEveryFunctionThatAnotherFileUses) {
    std::map<std::string, std::string> code;
    for (const KernelSource& source : embedded_kernel_sources())
        if (std::string(source.name).ends_with(".clh")) code[source.name] = without_comments(source.text);
    static const std::regex function("\n(?:wr_fn|wr_long_fn|wr_rare_fn)\\s[^({=]*?(wr_\\w+)\\(");
    for (const auto& [file, text] : code) {
        std::set<std::string> described;
        for (const KernelItem& item : kernel_items(kernel_source(file)))
            for (const std::string& declaration : item.declarations) described.insert(name_of(declaration));
        for (std::sregex_iterator at(text.begin(), text.end(), function), end; at != end; ++at)
            for (const auto& [other, used] : code)
                EXPECT_TRUE(other == file || described.contains((*at)[1]) || !words(used).contains((*at)[1]))
                    << file << ": " << (*at)[1] << " has no comment, but " << other << " uses it";
    }
}

/// Text of the host that plans kernels: all but the functions that eval offers.
std::string planning_text() {
    std::string text;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(WRINKLE_SOURCE_DIR "/host")) {
        const std::string path = entry.path().string();
        if (!entry.is_regular_file() || path.find("/functions/") != std::string::npos) continue;
        std::ifstream in(path);
        text += std::string(std::istreambuf_iterator<char>(in), {});
    }
    return text;
}

TEST(KernelItems, SayWhereNoLayerUsesThem) {
    const std::set<std::string> planned = words(planning_text());
    int unused = 0;
    for (const KernelSource& source : embedded_kernel_sources())
        for (const KernelItem& item : kernel_items(source.text))
            if (item.comment.find("No layer uses") != std::string::npos)
                for (const std::string& declaration : item.declarations) {
                    ++unused;
                    EXPECT_FALSE(planned.contains(name_of(declaration))) << source.name << ": " << declaration;
                }
    EXPECT_GT(unused, 4);
}

TEST(LayoutStructs, CountMembersInNumbers) {
    const std::vector<LayoutStruct> structs = layout_structs(
        "// About it.\n// And more.\ntypedef struct {\n    WR_SCALAR a, b[3];  // both\n    // what follows\n"
        "    WR_SCALAR c[2];\n} wr_thing;\n");
    ASSERT_EQ(structs.size(), 1U);
    EXPECT_EQ(structs[0].name, "wr_thing");
    EXPECT_EQ(structs[0].meaning, "About it. And more.");
    EXPECT_EQ(structs[0].size, 6U);
    ASSERT_EQ(structs[0].members.size(), 3U);
    EXPECT_EQ(structs[0].members[1].offset, 1U);
    EXPECT_EQ(structs[0].members[1].count, 3U);
    EXPECT_EQ(structs[0].members[1].meaning, "both");
    EXPECT_EQ(structs[0].members[2].offset, 4U);
    EXPECT_EQ(structs[0].members[2].meaning, "what follows");
}

}  // namespace
}  // namespace wrinkle::test
