#include "base/text_file.h"

#include <gtest/gtest.h>

#include "tests/io/files.h"

namespace wrinkle {
namespace {

using test::error_of, test::expect_mentions;

TEST(TextFile, IsReadWhole) {
    const test::TempFolder folder;
    std::string bytes(std::size_t{3} << 20, 'x');  // beyond any buffer
    bytes[7] = '\0', bytes.back() = '\n';
    for (const std::string& text : {std::string{}, std::string{"a\r\n1\n"}, bytes}) {
        test::write_text(folder / "a", text);
        EXPECT_TRUE(read_text(folder / "a") == text) << text.size() << " bytes";
    }
    EXPECT_FALSE(read_text("/proc/self/status").empty()) << "a file that does not know its size";
}

TEST(TextFile, SaysWhyItCannotBeRead) {
    const test::TempFolder folder;
    test::write_text(folder / "a", "");
    expect_mentions(error_of([&] { read_text(folder / "b.csv"); }), {"b.csv: there is no such file"});
    expect_mentions(error_of([&] { read_text(folder / "a/b.csv"); }), {"b.csv: there is no such file"});
    expect_mentions(error_of([&] { read_text(folder / ".", "a scene file"); }),
                    {"cannot be read: it is a folder; a scene file was expected"});
}

}  // namespace
}  // namespace wrinkle
