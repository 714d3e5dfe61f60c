// What libFuzzer has found worth keeping, once more through every reader: no fuzzing, but each branch that fuzzing has
// reached. Under the sanitizers this is where reads out of bounds would show.
#include <gtest/gtest.h>

#include <cstdlib>
#include <ctime>
#include <fstream>
#include <iterator>
#include <map>

#include "tests/io/files.h"

#define WRINKLE_HARNESS(name) static int name
#include "tests/fuzz/camera_fuzz.cpp"
#include "tests/fuzz/costs_fuzz.cpp"
#include "tests/fuzz/decal_csv_fuzz.cpp"
#include "tests/fuzz/decal_npy_fuzz.cpp"
#include "tests/fuzz/decal_toml_fuzz.cpp"
#include "tests/fuzz/gbuffer_fuzz.cpp"
#include "tests/fuzz/grid_bytes_fuzz.cpp"
#include "tests/fuzz/light_json_fuzz.cpp"
#include "tests/fuzz/npy_fuzz.cpp"
#include "tests/fuzz/nvdb_fuzz.cpp"
#include "tests/fuzz/scene_fuzz.cpp"
#include "tests/fuzz/sky_fuzz.cpp"
#include "tests/fuzz/texture_fuzz.cpp"

namespace wrinkle::test {
namespace {

namespace fs = std::filesystem;

using Harness = int (*)(const std::uint8_t*, std::size_t);

/// vdb_fuzz is not among them: it starts a process for every input.
const std::map<std::string, Harness> kHarnesses{
    {"camera_fuzz", camera_fuzz},
    {"costs_fuzz", costs_fuzz},
    {"decal_csv_fuzz", decal_csv_fuzz},
    {"decal_npy_fuzz", decal_npy_fuzz},
    {"decal_toml_fuzz", decal_toml_fuzz},
    {"gbuffer_fuzz", gbuffer_fuzz},
    {"grid_bytes_fuzz", grid_bytes_fuzz},
    {"light_json_fuzz", light_json_fuzz},
    {"npy_fuzz", npy_fuzz},
    {"nvdb_fuzz", nvdb_fuzz},
    {"scene_fuzz", scene_fuzz},
    {"sky_fuzz", sky_fuzz},
    {"texture_fuzz", texture_fuzz},
};

TEST(Corpus, IsReadOrRefused) {
    const fs::path kept = fs::path(WRINKLE_SOURCE_DIR) / "tests/fuzz/corpus";
    for (const auto& [name, harness] : kHarnesses) {
        SCOPED_TRACE(name);
        const TempFolder folder;
        const std::string unpack =
            "python3 -m zipfile -e " + (kept / (name + ".zip")).string() + " " + (folder / "").string();
        ASSERT_EQ(std::system(unpack.c_str()), 0);
        int inputs = 0;
        for (const auto& entry : fs::directory_iterator(folder / "")) {
            std::ifstream in(entry.path(), std::ios::binary);
            const std::string bytes{std::istreambuf_iterator<char>(in), {}};
            const std::clock_t start = std::clock();  // of this process: machines that run tests are busy
            EXPECT_NO_THROW(harness(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()))
                << entry.path().filename();
            EXPECT_LT(std::clock() - start, 5 * CLOCKS_PER_SEC) << entry.path().filename();
            ++inputs;
        }
        EXPECT_GT(inputs, 1);
    }
}

}  // namespace
}  // namespace wrinkle::test
