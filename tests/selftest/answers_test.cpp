// The answers that the program carries are those of the references.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "tests/selftest/make_answers.h"
#include "wrinkle/error.h"

namespace wrinkle::test {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kOfEach = 8;  // regular rows, and hard ones

std::vector<Answers> made_answers() {
    std::vector<Answers> all;
    for (const Function& function : functions())
        if (has_answers(function)) all.push_back(make_answers(function, kOfEach));
    const selftest::TemporaryFolder folder;
    for (const auto& scene : selftest::checked_scenes(folder.path())) all.push_back(make_answers(scene));
    return all;
}

/// The same but for what compilers round differently.
void expect_close(const std::vector<double>& carried, const std::vector<double>& want, const std::string& what) {
    ASSERT_EQ(carried.size(), want.size()) << what;
    for (std::size_t i = 0; i < want.size(); ++i)
        if (std::isfinite(want[i]))
            ASSERT_NEAR(carried[i], want[i], 1e-11 * std::max(1e-3, std::abs(want[i]))) << what << ", row " << i;
        else
            ASSERT_TRUE(std::isnan(carried[i])) << what << ", row " << i;
}

// With WRINKLE_WRITE_ANSWERS set, they are written anew instead; then build again.
TEST(Answers, AreThoseOfTheReferences) {
    const std::vector<Answers> made = made_answers();
    if (std::getenv("WRINKLE_WRITE_ANSWERS") != nullptr) {
        std::ofstream file(fs::path(WRINKLE_SOURCE_DIR) / "host/selftest/answers.txt");
        for (const Answers& answers : made) file << text_of(answers);
        return;
    }
    const std::vector<Answers>& carried = selftest::embedded_answers();
    ASSERT_EQ(carried.size(), made.size()) << "write them anew with WRINKLE_WRITE_ANSWERS=1";
    for (std::size_t k = 0; k < made.size(); ++k) {
        const Answers& is = carried[k];
        const Answers& want = made[k];
        ASSERT_EQ(is.name, want.name) << "write them anew with WRINKLE_WRITE_ANSWERS=1";
        EXPECT_EQ(is.inputs, want.inputs) << is.name;
        ASSERT_EQ(is.want.size(), want.want.size()) << is.name;
        for (const auto& [column, values] : want.want)
            expect_close(is.want.at(column), values, is.name + ", " + column);
        expect_close(is.allowance, want.allowance, is.name);
        expect_close(is.angle_allowance, want.angle_allowance, is.name);
        EXPECT_EQ(is.data.texels, want.data.texels) << is.name;
        EXPECT_EQ(is.data.textures, want.data.textures) << is.name;
        EXPECT_EQ(is.data.records.size(), want.data.records.size()) << is.name;
        EXPECT_EQ(is.data.constants.size(), want.data.constants.size()) << is.name;
    }
}

TEST(Answers, AreOfEveryFunctionButThoseOfVolumes) {
    for (const Function& function : functions()) {
        if (!has_answers(function)) continue;
        EXPECT_GE(selftest::answers_of(function.name).rows(), kOfEach) << function.name;
    }
    EXPECT_THROW(selftest::answers_of("nothing"), Error);
}

TEST(Answers, AreRefusedWhereTextIsNone) {
    EXPECT_THROW(selftest::parse_answers("in n.x 1 2\n"), Error);
    EXPECT_THROW(selftest::parse_answers("= resolve\nsomething 1 2\n"), Error);
    const std::vector<Answers> one = selftest::parse_answers("= resolve\nin n.x 1 -inf\nwant normal.x nan 0.5\n");
    ASSERT_EQ(one.size(), 1u);
    EXPECT_EQ(one[0].rows(), 2u);
    EXPECT_TRUE(std::isnan(one[0].want.at("normal.x")[0]));
}

}  // namespace
}  // namespace wrinkle::test
