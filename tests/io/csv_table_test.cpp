#include "io/csv_table.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <random>

#include "wrinkle/error.h"

namespace wrinkle::io {
namespace {

std::string message_of(std::string_view text, const std::string& column = "b") {
    try {
        CsvTable(text, "in.csv").numbers<float>(column);
    } catch (const Error& error) { return error.what(); }
    return "";
}

TEST(CsvTable, HasCellsByRowAndColumn) {
    const CsvTable table("a,b\n1,2\n3,4\n", "in.csv");
    EXPECT_EQ(table.names(), (std::vector<std::string>{"a", "b"}));
    ASSERT_EQ(table.rows(), 2u);
    EXPECT_EQ(table.cell(1, 0), "3");
    EXPECT_EQ(table.numbers<float>("b"), (std::vector<float>{2, 4}));
}

TEST(CsvTable, TakesWhatSpreadsheetsWrite) {
    for (const char* text :
         {"a,b\r\n1,2\r\n3,4",
          "\xef\xbb\xbf"
          "a,b\n1,2\n3,4\n",
          "\"a\",\"b\"\n\"1\",\"2\"\n\"3\",\"4\"\n", " a , b \n 1 ,\t2\n3,  4 \n", "a,b\t\n1,2\n3,4\n",
          "a,b\r1,2\r3,4\r", "\na,b\n\n1,2\n  \n3,4\n\n", "a,b\n+1,2e0\n3,.4e1\n"}) {
        const CsvTable table(text, "in.csv");
        EXPECT_EQ(table.numbers<double>("a"), (std::vector<double>{1, 3})) << text;
        EXPECT_EQ(table.numbers<double>("b"), (std::vector<double>{2, 4})) << text;
    }
    const CsvTable quoted("name,b\n\"rock, \"\"wet\"\"\nand old\",2\n", "in.csv");
    EXPECT_EQ(quoted.cell(0, 0), "rock, \"wet\"\nand old");
}

TEST(CsvTable, NamesRowLineAndColumnOfWhatIsNoNumber) {
    EXPECT_EQ(message_of("a,b\n1,2\n3,x\n"), "in.csv:3: row 2, column \"b\": \"x\" is no number");
    EXPECT_EQ(message_of("a,b\r\n1,2\r\n\r\n3,\r\n"), "in.csv:4: row 2, column \"b\" is empty");
    EXPECT_EQ(message_of("a,b\n\"x\ny\",2\n3,4 5\n"), "in.csv:4: row 2, column \"b\": \"4 5\" is no number");
    for (const char* cell : {"1,5", "0x10", "1e", "--1", "+-1", "1.2.3", "ten", "1f"})
        EXPECT_NE(message_of(std::string("b\n\"") + cell + "\"\n").find("is no number"), std::string::npos) << cell;
    EXPECT_NE(message_of("b\n1e39\n").find("too large for a float; use --precision double"), std::string::npos);
    EXPECT_NE(message_of("b\n1e999\n").find("is no number"), std::string::npos);
    EXPECT_EQ(message_of("b\n1e-50\n-nan\ninf\n"), "") << "numbers all the same";
}

TEST(CsvTable, RefusesRaggedRowsAndEmptyText) {
    EXPECT_EQ(message_of("a,b\n1,2\n3\n"), "in.csv:3: row 2 has 1 cell, the header 2 columns");
    EXPECT_EQ(message_of("a,b\n1,2,3\n"), "in.csv:2: row 1 has 3 cells, the header 2 columns");
    EXPECT_EQ(message_of("b\n1,2\n"), "in.csv:2: row 1 has 2 cells, the header 1 column");
    for (const char* text : {"", "\n\n", "\xef\xbb\xbf"})
        EXPECT_EQ(message_of(text), "in.csv is empty; its first row must name the columns");
    EXPECT_EQ(message_of("a,b\n1,\"2\n3,4\n"), "in.csv:2: a quote is not closed");
    EXPECT_EQ(message_of("a,b\n1,2\n5\" pipe,4\n"), "in.csv:3: a quote within a cell; quote the cell and double it");
    EXPECT_NE(message_of(std::string_view("a\0b", 3)).find("zero bytes"), std::string::npos);
    EXPECT_EQ(message_of("a;b\n1,5;2\n"),
              "in.csv:1: separated by ';': save with commas between columns, and points in numbers");
    EXPECT_NE(message_of("\n\"a\";\"b\"\n").find("in.csv:2: separated by ';'"), std::string::npos);
    EXPECT_NE(message_of("a\tb\n1\t2\n").find("in.csv:1: separated by tabs"), std::string::npos);
    EXPECT_EQ(message_of("a,c\n1,2\n"), "in.csv has no column \"b\"");
    EXPECT_EQ(message_of("b,b\n1,2\n"), "in.csv has two columns \"b\"");
    EXPECT_EQ(CsvTable("a,b\n", "in.csv").rows(), 0u);
}

TEST(Csv, NumbersReadBackAsTheyWere) {
    std::mt19937 random(1);
    for (int i = 0; i < 20000; ++i) {
        const std::uint32_t bits = random();
        float single;
        std::memcpy(&single, &bits, sizeof single);
        const std::uint64_t more = (std::uint64_t{random()} << 32) | random();
        double twice;
        std::memcpy(&twice, &more, sizeof twice);
        if (!std::isfinite(single) || !std::isfinite(twice)) continue;
        std::string text = "a,b\n";
        append_number(text, single), text += ',', append_number(text, twice);
        const CsvTable table(text, "in.csv");
        EXPECT_EQ(table.numbers<float>("a")[0], single) << text;
        EXPECT_EQ(table.numbers<double>("b")[0], twice) << text;
    }
    std::string text;
    append_number(text, 0.1f), text += ' ', append_number(text, 0.1);
    EXPECT_EQ(text, "0.1 0.1") << "the shortest text";
}

TEST(Csv, CellsReadBackAsTheyWere) {
    for (const char* cell : {"plain", "", "a,b", "\"", "two\nlines", " blank ", "\t", "caf\xc3\xa9"}) {
        std::string text = "first,second\nx,";
        append_csv_cell(text, cell);
        EXPECT_EQ(CsvTable(text + "\n", "in.csv").cell(0, 1), cell);
    }
}

}  // namespace
}  // namespace wrinkle::io
