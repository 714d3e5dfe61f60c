// Tables of decals as records of numpy's, and how long tables take to load.
#include <cmath>
#include <cstring>
#include <ctime>
#include <limits>

#include "tests/scene/decal_forms.h"
#include "tests/scene/records.h"

namespace wrinkle {
namespace {

const std::string kPosition = "('x', '<f8'), ('y', '<f4'), ('z', '<f8')";

Records position(const std::string& more, std::size_t rows = 1) {
    return Records(kPosition + (more.empty() ? "" : ", " + more), rows).put(0.1).put(2.5f).put(-3.0);
}

class DecalRecords : public DecalFolder {
protected:
    std::vector<Projector> read(const std::string& bytes) const { return DecalFolder::read("decals.npy", bytes); }
    void expect_refused(const std::string& bytes, const std::vector<std::string>& parts) const {
        DecalFolder::expect_refused("decals.npy", bytes, parts);
    }
};

TEST_F(DecalRecords, HoldNumbersAndTextOfEveryType) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    Records table(kPosition +
                      ", ('shape', '<U6'), ('texture', '|u1'), ('', '|V3'), ('two_sided', '|b1'), ('object', '<f4'), "
                      "('mode', '|S7'), ('priority', '<i2'), ('cryptomatte', '|S4'), ('angle_full', '<u2'), "
                      "('angle_zero', '<i8'), ('half_x', '<f4'), ('wrap', '|S5')",
                  2);
    table.put(1.0).put(2.5f).put(-3e-1).wide_text(U"cone", 6).put(std::uint8_t{1}).text("pad", 3).put(true);
    table.put(3.0f).text("replace", 7).put(std::int16_t{-7}).text("", 4).put(std::uint16_t{10});
    table.put(std::int64_t{60}).put(0.25f).text("tile", 5);
    table.put(4.0).put(5.0f).put(6.0).wide_text(U"", 6).put(std::uint8_t{0}).text("pad", 3).put(false);
    table.put(nan).text("", 7).put(std::int16_t{0}).text("Rock", 4).put(std::uint16_t{10});
    table.put(std::int64_t{60}).put(0.5f).text("", 5);
    expect_two_decals(read(table.bytes()));
}

TEST_F(DecalRecords, NameRowAndColumnOfAMistake) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    expect_refused(position("('half_x', '<f4')", 2).put(1.0f).put(1.0).put(1.0f).put(1.0).put(0.0f).bytes(),
                   {"decals.npy: row 1: ", "\"half_x\" is 0", "a positive number"});
    expect_refused(Records(kPosition, 1).put(nan).put(1.0f).put(1.0).bytes(), {"row 0: ", "\"x\" is nan"});
    expect_refused(position("('s0', '<f8'), ('s1', '<f8')").put(0.5).put(0.5).bytes(), {"row 0: ", "\"s0\"", "\"s1\""});
    expect_refused(position("('texture', '<i4')").put(std::int32_t{-1}).bytes(), {"\"texture\" is -1", "whole number"});
    expect_refused(position("('texture', '<f4')").put(0.5f).bytes(), {"\"texture\" is 0.5", "whole number"});
    expect_refused(position("('texture', '<i4')").put(2).bytes(), {"\"texture\" is 2", "2 textures"});
    expect_refused(position("('shape', '|S4')").text("ball", 4).bytes(), {"\"shape\"", "\"ball\"", "\"sphere\""});
    expect_refused(position("('shape', '<i4')").put(1).bytes(), {"\"shape\" is 1", "holds text"});
    expect_refused(position("('two_sided', '<f4')").put(0.5f).bytes(), {"\"two_sided\" is 0.5", "0 or 1"});
    expect_refused(position("('half', '<f4')").put(1.0f).bytes(), {"unknown column \"half\"", "half_x"});
    expect_refused(Records("('x', '<f8'), ('y', '<f8')", 0).bytes(), {"\"z\" is missing"});
    Records many(kPosition, 100);
    for (int i = 0; i < 100; ++i) many.put(nan).put(1.0f).put(1.0);
    expect_refused(many.bytes(), {"row 19: ", "row 99: and 80 more mistakes"});
}

TEST_F(DecalRecords, OfOtherKindsAreToldHowToBeConverted) {
    const auto head = [](const std::string& dict) {
        std::string out = "\x93NUMPY";
        out += {'\x01', '\x00', static_cast<char>(dict.size()), '\x00'};
        return out + dict;
    };
    expect_refused(head("{'descr': '<f4', 'fortran_order': False, 'shape': (2, 3), }"),
                   {"decals.npy holds plain numbers", "unstructured_to_structured"});
    expect_refused(head("{'descr': [('x', '>f4')], 'fortran_order': False, 'shape': (0,), }"),
                   {"\"x\"", "\">f4\"", "big-endian"});
    expect_refused(head("{'descr': [('x', '<f4', (3,))], 'fortran_order': False, 'shape': (0,), }"),
                   {"cannot read its fields", "(3,)", "one number or text"});
    expect_refused(head("{'descr': [('x', '<c8')], 'fortran_order': False, 'shape': (0,), }"),
                   {"\"<c8\"", "needs numbers"});
    expect_refused(head("{'descr': [('x', '<f4')], 'fortran_order': False, 'shape': (2, 2), }"), {"2 dimensions"});
    expect_refused(head("{'descr': [('x', '<f4')], 'fortran_order': False, 'shape': (3,), }") + "12345",
                   {"cut short: 1 of 3 records"});
    expect_refused("\x93NUMPY", {"not a .npy file"});
}

double seconds_to_load(const std::filesystem::path& file, std::size_t rows) {
    double fastest = 1e9;  // processor time, since others may use the machine
    for (int i = 0; i < 3; ++i) {
        const std::clock_t start = std::clock();
        EXPECT_EQ(load_decals(file, 2).size(), rows);
        fastest = std::min(fastest, static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
    }
    std::printf("%s: %zu rows in %.3f s\n", file.filename().c_str(), rows, fastest);
    return fastest;
}

TEST_F(DecalRecords, AHundredThousandRowsLoadInHalfASecond) {
    constexpr std::size_t count = 100'000;
    std::vector<Projector> rows(count);
    Records records(kPosition +
                        ", ('axis_x_x', '<f4'), ('axis_x_y', '<f4'), ('axis_x_z', '<f4'), ('half_x', '<f4'), "
                        "('half_y', '<f4'), ('half_z', '<f4'), ('texture', '<i4'), ('scale', '<f8'), ('shape', '<U6'), "
                        "('opacity', '<f4'), ('mode', '<U7')",
                    count);
    for (std::size_t i = 0; i < count; ++i) {
        const double v = static_cast<double>(i) / 7;
        rows[i].center = {v, v / 3, v / 11};
        rows[i].axis_x = {1, v, 0.3};
        rows[i].half_size = {v + 1, v + 2, v + 3};
        rows[i].texture = i % 2;
        rows[i].scale = v / 1000;
        records.put(v).put(static_cast<float>(v / 3)).put(v / 11);
        for (const double part : {1.0, v, 0.3, v + 1, v + 2, v + 3}) records.put(static_cast<float>(part));
        records.put(static_cast<std::int32_t>(i % 2)).put(v / 1000).wide_text(U"sphere", 6).put(0.5f);
        records.wide_text(U"replace", 7);
    }
    save_decals(folder_ / "many.csv", rows);
    const double csv = seconds_to_load(folder_ / "many.csv", count);
    const double npy = seconds_to_load(write("many.npy", records.bytes()), count);
    save_decals(folder_ / "many.toml", rows);
    seconds_to_load(folder_ / "many.toml", count);
#ifdef NDEBUG
    EXPECT_LT(csv, 0.5);
    EXPECT_LT(npy, 0.5);
#else
    static_cast<void>(csv), static_cast<void>(npy);
#endif
}

}  // namespace
}  // namespace wrinkle
