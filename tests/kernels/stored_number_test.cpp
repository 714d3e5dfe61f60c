// surface/stored_number.clh: every stored number, against the definitions of the formats.
#include <gtest/gtest.h>

#include <random>

#include "io/object_ids.h"
#include "tests/kernels/check.h"
#include "tests/reference/stored.h"

namespace wrinkle::test {
namespace {

using reference::Vec;

/// How the kernels know an encoding, and the integer that stands for 1.
struct Stored {
    PlaneEncoding encoding;
    const char* kernel;
    int bytes;
    double full;
    double reading;  ///< largest error of reading, of the largest number
    double writing;  ///< ... of writing and reading, for numbers from -1, or 0, to 1
};
constexpr Stored kStored[] = {
    {PlaneEncoding::half, "WR_STORED_HALF", 2, 1, 0, 0x1p-12},
    {PlaneEncoding::unorm8, "WR_STORED_UNSIGNED", 1, 255, 1.2e-7, 1.0001 / 510},
    {PlaneEncoding::unorm16, "WR_STORED_UNSIGNED", 2, 65535, 1.2e-7, 1.02 / 131070},
    {PlaneEncoding::snorm8, "WR_STORED_SIGNED", 1, 127, 1.2e-7, 1.0001 / 254},
    {PlaneEncoding::snorm16, "WR_STORED_SIGNED", 2, 32767, 1.2e-7, 1.01 / 65534},
};

std::vector<Variant> variants() {
    std::vector<Variant> all;
    for (const int lanes : lanes_to_try()) all.push_back({lanes, false});
    for (const bool fp64 : precisions_to_try())
        for (const int lanes : fp64 ? lanes_to_try({8}) : std::vector<int>{}) all.push_back({lanes, true});
    return all;
}

std::string plane_text(const Stored& stored) {
    return fmt::format("{{(global uchar *)texels, {0}, {1}, {1}, 0, 0, {2:#.9g}f, 0.0f}}", stored.kernel, stored.bytes,
                       1 / stored.full);
}

/// All numbers of 16 bits as columns of halves of uints, which floats hold.
std::string bits_text() {
    return "wr_stored_bits bits = WR_JOIN(convert_, WR_WIDTH(uint))(high) << 16 | WR_JOIN(convert_, "
           "WR_WIDTH(uint))(low);\n";
}

Columns columns_of(const std::vector<std::uint32_t>& bits) {
    Columns columns;
    for (const std::uint32_t number : bits)
        columns["high"].push_back(static_cast<float>(number >> 16)),
            columns["low"].push_back(static_cast<float>(number & 65535u));
    return columns;
}

TEST(StoredNumbers, AreReadAndWrittenAsTheirFormatsSay) {
    constexpr unsigned seed = 3;
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> number(-1.1f, 1.1f);
    std::vector<std::uint32_t> codes(65536);
    std::iota(codes.begin(), codes.end(), 0u);
    Columns columns = columns_of(codes);
    for (std::size_t i = 0; i < codes.size(); ++i) columns["v"].push_back(number(random));
    const float odd[] = {NAN, INFINITY, -INFINITY, 0, -0.0f, 1, -1, 1e-45f, 3e38f, 65519, 65520, 6e-8f};
    std::ranges::copy(odd, columns["v"].begin());
    ColumnKernel kernel{bits_text(), {}};
    for (const Stored& stored : kStored) {
        const std::size_t k = kernel.outputs.size() / 3;
        kernel.body += fmt::format("wr_stored plane{} = {};\n", k, plane_text(stored));
        kernel.outputs.push_back(
            fmt::format("wr_to_real(wr_decoded(plane{}, bits & {}))", k, stored.bytes == 1 ? 255 : 65535));
        kernel.outputs.push_back(fmt::format("wr_to_real(wr_encoded(plane{}, v) & 65535)", k));
        kernel.outputs.push_back(
            fmt::format("wr_to_real(wr_encoded(plane{0}, wr_to_real(wr_decoded(plane{0}, bits & {1}))) & 65535)", k,
                        stored.bytes == 1 ? 255 : 65535));
    }
    double reading[5] = {}, writing[5] = {};
    for (const Variant variant : variants()) {
        const Results r = run_kernel(kernel, columns, variant);
        for (std::size_t k = 0; k < std::size(kStored); ++k) {
            const Stored& stored = kStored[k];
            const std::uint32_t mask = stored.bytes == 1 ? 255 : 65535;
            const bool with_sign = stored.kernel == std::string("WR_STORED_SIGNED");
            for (std::uint32_t code = 0; code <= mask; ++code) {
                const double want = reference::decoded(stored.encoding, code), got = r[3 * k][code];
                const std::string what =
                    fmt::format("{} {:#x} on {} lanes", encoding_name(stored.encoding), code, variant.lanes);
                ASSERT_EQ(std::isnan(want), std::isnan(got)) << what;
                if (std::isnan(want)) continue;
                if (std::isinf(want)) {
                    ASSERT_EQ(got, want) << what;
                } else {
                    reading[k] = std::max(reading[k], std::abs(got - want));
                    ASSERT_LE(std::abs(got - want), stored.reading) << what;
                }
                const bool lowest = with_sign && code == mask / 2 + 1;  // the same number as the one above
                ASSERT_EQ(static_cast<std::uint32_t>(r[3 * k + 2][code]) & mask, lowest ? code + 1 : code) << what;
            }
            for (std::size_t i = 0; i < codes.size(); ++i) {
                const double v = columns["v"][i], least = with_sign ? -1 : 0;
                const auto got = static_cast<std::uint32_t>(r[3 * k + 1][i]) & mask;
                if (stored.encoding == PlaneEncoding::half) {
                    ASSERT_TRUE(std::isnan(v) || got == reference::to_half(v)) << v << " on " << variant.lanes;
                    if (std::abs(v) <= 1) writing[k] = std::max(writing[k], std::abs(reference::from_half(got) - v));
                    continue;
                }
                const double near = std::isnan(v) ? 0 : std::clamp(v, least, 1.0);
                const double error = std::abs(reference::decoded(stored.encoding, got) - near);
                writing[k] = std::max(writing[k], error);
                ASSERT_LE(error, stored.writing)
                    << encoding_name(stored.encoding) << ' ' << v << " on " << variant.lanes;
            }
        }
    }
    for (std::size_t k = 0; k < std::size(kStored); ++k)
        fmt::print("{:<9} largest error of reading {:.2g}, of writing {:.4g}\n", encoding_name(kStored[k].encoding),
                   reading[k], writing[k]);
}

TEST(StoredNumbers, WholeNumbersAreKeptAsFarAsFloatsHoldThem) {
    std::vector<std::uint32_t> numbers{0, 1, 8388607, 8388608, 8388609, 16777215, 16777216, 4294967040u};
    Columns columns;
    for (const std::uint32_t number : numbers) columns["v"].push_back(static_cast<float>(number));
    columns["v"].push_back(4194304.5f), numbers.push_back(4194305);
    const std::string body =
        "wr_stored plane = {(global uchar *)texels, WR_STORED_UNSIGNED, 4, 4, 0, 0, 1.0f, 0.0f};\n"
        "wr_stored_bits bits = wr_encoded(plane, v);\n";
    for (const Variant variant : variants()) {
        const Results r = run_kernel({body, {"wr_to_real(bits >> 16)", "wr_to_real(bits & 65535)"}}, columns, variant);
        for (std::size_t i = 0; i < numbers.size(); ++i)
            EXPECT_EQ(static_cast<std::uint32_t>(r[0][i]) << 16 | static_cast<std::uint32_t>(r[1][i]), numbers[i]);
    }
}

TEST(StoredNumbers, OctahedralNormals) {
    constexpr unsigned seed = 4;
    std::mt19937 random(seed);
    std::normal_distribution<float> part;
    std::vector<std::uint32_t> codes;
    Columns columns;
    for (std::uint32_t i = 0; i < 65536; ++i) codes.push_back(i | static_cast<std::uint32_t>(random()) << 16);
    for (std::uint32_t i = 0; i < 65536; i += 5) codes[i] = codes[i] << 16 | i;
    columns = columns_of(codes);
    for (std::size_t i = 0; i < codes.size(); ++i)
        for (const char* axis : {"n.x", "n.y", "n.z"})
            columns[axis].push_back(i < 8 ? 0 : part(random) * (i % 3 == 0 ? 1e-20f : 1));
    columns["n.x"][1] = 1, columns["n.y"][2] = -1, columns["n.z"][3] = -1, columns["n.z"][4] = 1;
    for (std::size_t i = 8; i < 100; ++i)
        for (const char* axis : {"n.x", "n.y", "n.z"}) columns[axis][i] *= i % 2 == 0 ? 1e38f : 1e-15f;
    columns["n.x"][5] = INFINITY, columns["n.y"][6] = NAN, columns["n.z"][7] = -INFINITY;
    ColumnKernel kernel{bits_text(), {}};
    for (const int bytes : {1, 2}) {
        for (int axis = 0; axis < 3; ++axis)
            kernel.outputs.push_back(fmt::format("wr_to_real(wr_from_octahedron(bits, {}, {}))", bytes, axis));
        kernel.outputs.push_back(fmt::format("wr_to_real(wr_to_octahedron(n, {}) & 65535)", bytes));
        kernel.outputs.push_back(fmt::format("wr_to_real(wr_to_octahedron(n, {}) >> 16)", bytes));
    }
    double worst[2] = {};
    for (const Variant variant : variants()) {
        const Results r = run_kernel(kernel, columns, variant);
        for (std::size_t k = 0; k < 2; ++k) {
            const PlaneEncoding encoding = k == 0 ? PlaneEncoding::octahedral8 : PlaneEncoding::octahedral16;
            for (std::size_t i = 0; i < codes.size(); ++i) {
                const Vec<double> got{r[5 * k][i], r[5 * k + 1][i], r[5 * k + 2][i]};
                const std::string what =
                    fmt::format("{} {:#x} on {} lanes", encoding_name(encoding), codes[i], variant.lanes);
                ASSERT_LE(angle_degrees(got, reference::decoded_normal(encoding, codes[i])), 1e-12) << what;
                ASSERT_TRUE(length(got) > 0.499 && length(got) < 1) << what;
                const Vec<double> n{columns["n.x"][i], columns["n.y"][i], columns["n.z"][i]};
                const auto bits =
                    static_cast<std::uint32_t>(r[5 * k + 3][i]) | static_cast<std::uint32_t>(r[5 * k + 4][i]) << 16;
                if (length(n) == 0 || !std::isfinite(length(n))) {
                    ASSERT_EQ(bits, 0u) << what;
                    continue;
                }
                const double error = angle_degrees(n, reference::decoded_normal(encoding, bits));
                worst[k] = std::max(worst[k], error);
                ASSERT_LE(error, k == 0 ? 0.95 : 0.0037) << what;
            }
        }
    }
    fmt::print("octahedral normals: largest angle {:.4g} degrees of 2 x 8 bits, {:.4g} of 2 x 16\n", worst[0],
               worst[1]);
}

/// The labels are those that the host gives the numbers of scenes.
TEST(StoredNumbers, LabelsOfObjects) {
    std::vector<std::uint32_t> numbers{0,           1,           255,         1u << 24,    (1u << 24) + 1,
                                       0x7f800000u, 0x7fffffffu, 0x80000000u, 0xff800001u, 0xffffffffu};
    for (std::uint32_t i = 0; i < 300; ++i) numbers.push_back(i * 2654435761u);
    const Columns columns = columns_of(numbers);
    for (const Variant variant : variants()) {
        const Results r = run_kernel({bits_text(), {"wr_to_real(wr_object_label(bits))"}}, columns, variant);
        for (std::size_t i = 0; i < numbers.size(); ++i)
            EXPECT_EQ(static_cast<float>(r[0][i]), io::object_label(numbers[i])) << numbers[i];
    }
}

}  // namespace
}  // namespace wrinkle::test
