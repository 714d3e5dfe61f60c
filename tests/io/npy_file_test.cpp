#include "io/npy_file.h"

#include <gtest/gtest.h>

#include "tests/io/files.h"

namespace wrinkle::io {
namespace {

using test::TempFolder;

/// A file as numpy writes it.
template <class T>
void write_npy(const std::filesystem::path& file, const std::string& dict, const std::vector<T>& values) {
    std::string text = "\x93NUMPY";
    const std::string padded = dict + std::string(117 - dict.size(), ' ') + "\n";
    text += {'\x01', '\x00', static_cast<char>(padded.size()), '\x00'};
    text += padded;
    text.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
    test::write_text(file, text);
}

TEST(Npy, ReadsFloatsAndDoublesOfAnyShape) {
    const TempFolder folder;
    write_npy<float>(folder / "a.npy", "{'descr': '<f4', 'fortran_order': False, 'shape': (2, 3), }",
                     {1, 2, 3, 4, 5, 6});
    EXPECT_EQ(read_npy<float>(folder / "a.npy").shape, (std::vector<std::size_t>{2, 3}));
    EXPECT_EQ(read_npy<double>(folder / "a.npy").values, (std::vector<double>{1, 2, 3, 4, 5, 6}));
    write_npy<double>(folder / "b.npy", "{'descr': '<f8', 'fortran_order': False, 'shape': (2,), }", {0.1, 1e300});
    EXPECT_EQ(read_npy<double>(folder / "b.npy").values, (std::vector<double>{0.1, 1e300}));
    test::expect_mentions(test::error_of([&] { read_npy<float>(folder / "b.npy"); }),
                          {"b.npy", "element 1", "--precision double"});
    write_npy<float>(folder / "c.npy", "{'descr': '<f4', 'fortran_order': False, 'shape': (), }", {7});
    EXPECT_EQ(read_npy<float>(folder / "c.npy").values, std::vector<float>{7});
    write_npy<float>(folder / "d.npy", "{'descr': '<f4', 'fortran_order': False, 'shape': (0, 3), }", {});
    EXPECT_TRUE(read_npy<float>(folder / "d.npy").values.empty());
}

TEST(Npy, WritesWhatNumpyReads) {
    const std::size_t shape[] = {4, 3}, row[] = {5};
    const std::string header = npy_header<float>(shape);
    EXPECT_EQ(header.size() % 64, 0u);
    EXPECT_EQ(header.back(), '\n');
    EXPECT_EQ(static_cast<std::size_t>(header[8]) + 10, header.size());
    EXPECT_NE(header.find("{'descr': '<f4', 'fortran_order': False, 'shape': (4, 3), }"), std::string::npos) << header;
    EXPECT_NE(npy_header<double>(row).find("'<f8', 'fortran_order': False, 'shape': (5,), }"), std::string::npos);
    const TempFolder folder;
    const double values[] = {1, 2, 3, 4, 5};
    test::write_text(folder / "a.npy",
                     npy_header<double>(row) + std::string(reinterpret_cast<const char*>(values), 40));
    EXPECT_EQ(read_npy<double>(folder / "a.npy").values, (std::vector<double>{1, 2, 3, 4, 5}));
}

TEST(Npy, SaysWhatItCannotRead) {
    const TempFolder folder;
    const auto refused = [&](const std::string& dict, const std::vector<std::string>& parts) {
        write_npy<float>(folder / "a.npy", dict, {1, 2, 3, 4});
        test::expect_mentions(test::error_of([&] { read_npy<float>(folder / "a.npy"); }), parts);
    };
    refused("{'descr': '<f4', 'fortran_order': True, 'shape': (2, 2), }", {"a.npy", "Fortran", "ascontiguousarray"});
    refused("{'descr': '<i8', 'fortran_order': False, 'shape': (2,), }", {"<i8", "astype"});
    refused("{'descr': '>f4', 'fortran_order': False, 'shape': (2,), }", {">f4"});
    refused("{'descr': [('x', '<f4')], 'fortran_order': False, 'shape': (2,), }", {"records"});
    refused("{'descr': '<f4', 'fortran_order': False, 'shape': (5,), }", {"cut short", "4 of 5"});
    refused("{'descr': '<f4', 'fortran_order': False, 'shape': (99999999, 99999999, 9999), }", {"damaged"});
    refused("{'descr': '<f4', 'fortran_order': False, 'shape': (99999999999999999999,), }", {"damaged"});
    for (const char* text : {"", "x,y\n1,2\n", "\x93NUMPY", "\x93NUMPY\x01\x01\xff\xff{'descr'"}) {
        test::write_text(folder / "b.npy", text);
        test::expect_mentions(test::error_of([&] { read_npy<float>(folder / "b.npy"); }), {"b.npy"});
    }
}

}  // namespace
}  // namespace wrinkle::io
