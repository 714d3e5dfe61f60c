// Every name that the kernel files bring into a program is prefixed, so that an engine's own names stay its own.
#include <gtest/gtest.h>

#include <regex>

#include "device/kernel_sources.h"

namespace wrinkle::test {
namespace {

std::string without_comments(const std::string& text) { return std::regex_replace(text, std::regex("//[^\n]*"), ""); }

bool is_prefixed(const std::string& name) { return name.starts_with("wr_") || name.starts_with("WR_"); }

/// Words of the language that stand outside of braces and parentheses.
bool is_language(const std::string& word) {
    static const std::regex words(
        "typedef|struct|static|inline|const|constant|global|void|bool|__attribute__|"
        "(u?(char|short|int|long)|float|double|half|size_t)[0-9]*");
    return std::regex_match(word, words);
}

TEST(KernelNames, MacrosArePrefixed) {
    const std::regex macro("#\\s*define\\s+(\\w+)");
    for (const KernelSource& source : embedded_kernel_sources()) {
        const std::string text = without_comments(source.text);
        for (std::sregex_iterator at(text.begin(), text.end(), macro), end; at != end; ++at)
            EXPECT_TRUE(is_prefixed((*at)[1])) << source.name << ": " << (*at)[1];
    }
}

TEST(KernelNames, FunctionsTypesAndTablesArePrefixed) {
    const std::regex directive("#([^\n]*\\\\\n)*[^\n]*");
    for (const KernelSource& source : embedded_kernel_sources()) {
        if (std::string(source.name).ends_with(".json")) continue;
        const std::string text = std::regex_replace(without_comments(source.text), directive, "");
        int depth = 0;
        std::string word;
        for (const char c : text) {
            if (std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_') {
                word += c;
                continue;
            }
            const bool name = !word.empty() && std::isdigit(static_cast<unsigned char>(word[0])) == 0;
            EXPECT_TRUE(depth != 0 || !name || is_prefixed(word) || is_language(word)) << source.name << ": " << word;
            word.clear();
            if (c == '{' || c == '(' || c == '[') ++depth;
            if (c == '}' || c == ')' || c == ']') --depth;
        }
        EXPECT_EQ(depth, 0) << source.name;
    }
}

}  // namespace
}  // namespace wrinkle::test
