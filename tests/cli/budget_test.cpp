// run --max-error, [budget] and tune, as a user meets them.
#include <map>
#include <nlohmann/json.hpp>

#include "io/gbuffer_reader.h"
#include "tests/cli/cli.h"

namespace wrinkle::test {
namespace {

const std::string dunes =
    "[[layer]]\nname = \"dunes\"\nkind = \"noise\"\nscale = 0.05\nfrequency = 20\nfootprint = false\n";

TEST(BudgetOption, ReportsWhatWasMeasured) {
    const Workplace place;
    place.write_scene(dunes);
    const Ran text = place.run("run scene.toml --max-error 1 --sample 500 --seed 3");
    EXPECT_EQ(text.code, 0) << text.err;
    expect_mentions(text.out, {"max_error 1 degrees: geometry", "expected", "measured", "seed 3", "check in double"});
    EXPECT_EQ(place.files("out"), (std::vector<std::string>{"normal.exr", "normal.png"}));

    place.write_scene("[budget]\nmax_error = 1e-5\nsample = 800\n" + dunes);
    const Ran json = place.run("run scene.toml --json");
    ASSERT_EQ(json.code, 0) << json.err;
    const auto budget = nlohmann::json::parse(json.out).at("budget");
    EXPECT_EQ(budget.at("max_error"), 1e-5);
    EXPECT_EQ(budget.at("precision"), "everything in double");
    EXPECT_LE(budget.at("measured").at("max").get<double>(), 1e-5);
    EXPECT_GT(budget.at("measured").at("max").get<double>(), 0);  // the rounding of what is written
    EXPECT_LE(budget.at("measured").at("pixels").get<int>(), 800);
    EXPECT_TRUE(
        nlohmann::json::parse(place.run("run scene.toml --json --max-error 1").out).at("budget").at("misses").empty());
}

TEST(BudgetOption, PrecisionsDifferAndConverge) {
    const Workplace place;
    place.write_scene(dunes);
    std::map<std::string, std::vector<float>> normals;
    for (const char* precision : {"standard", "exact", "double"}) {
        const Ran ran = place.run(fmt::format("run scene.toml -o {0} --precision {0}", precision));
        ASSERT_EQ(ran.code, 0) << ran.err;
        const GBufferReader reader(place / (std::string(precision) + "/normal.exr"));
        std::vector<float>& plane = normals[precision];
        plane.resize(std::size_t{reader.size().width} * reader.size().height);
        const std::vector<std::string> names{"channel:normal.X"};
        const std::vector<float*> into{plane.data()};
        reader.read_rows(0, reader.size().height, names, into);
    }
    const auto largest = [&](const char* precision) {
        float most = 0;
        for (std::size_t i = 0; i < normals["double"].size(); ++i)
            most = std::max(most, std::abs(normals[precision][i] - normals["double"][i]));
        return most;
    };
    EXPECT_GT(largest("standard"), 3 * largest("exact"));
    EXPECT_LT(largest("exact"), 1e-5f);
}

TEST(BudgetOption, WritesNothingThatMissesIt) {
    const Workplace place;
    place.write_scene(dunes);
    ASSERT_EQ(place.run("run scene.toml").code, 0);
    const std::string before = read_text(place / "out/normal.exr");
    const Ran ran = place.run("run scene.toml --max-error 1e-9");
    expect_failed(ran, {"max_error = 1e-09", "in double", "Nothing was written"});
    EXPECT_EQ(ran.code, 1);
    EXPECT_EQ(read_text(place / "out/normal.exr"), before);
    EXPECT_EQ(place.files("out"), (std::vector<std::string>{"normal.exr", "normal.png"}));
    expect_failed(place.run("run scene.toml --max-error 1e-9 -o elsewhere"), {"1e-09"});
    EXPECT_TRUE(place.files("elsewhere").empty());
}

TEST(BudgetOption, BadValuesAreRefused) {
    const Workplace place;
    place.write_scene(dunes);
    for (const char* arguments : {"--max-error 0", "--max-error -1", "--max-error 200", "--max-error tiny",
                                  "--max-error 1 --sample 0", "--max-error 1 --seed -1"}) {
        const Ran ran = place.run(std::string("run scene.toml ") + arguments);
        EXPECT_EQ(ran.code, 2) << arguments;
        expect_failed(ran, {"--help"});
    }
    expect_failed(place.run("run scene.toml --sample 10"), {"--max-error"});
    expect_failed(place.run("run scene.toml --max-error 1 --precision exact"), {"--precision", "max_error"});
    expect_failed(place.run("run scene.toml --precision perfect"), {"perfect", "standard"});
    place.write_scene("[budget]\nmax_error = 0.01\n[output]\nhalf = true\n" + dunes);
    expect_failed(place.run("run scene.toml"), {"half = true", "0.01"});
    EXPECT_TRUE(place.files("out").empty());
}

TEST(Tune, WritesATableThatRunsChooseBy) {
    const Workplace place;
    place.write_scene(dunes);
    const std::string cache = "WRINKLE_CACHE_DIR='" + (place / "cache").string() + "'";
    const Ran tuned = place.run("tune scene.toml --repeat 1 --sample 500", cache);
    ASSERT_EQ(tuned.code, 0) << tuned.err;
    expect_mentions(tuned.out,
                    {"noise perlin", "standard", "exact", "double", "geometry", "->", "cache/precision.json"});
    expect_mentions(tuned.err, {"scene.toml: layer \"dunes\""});
    auto table = nlohmann::json::parse(read_text(place / "cache/precision.json"));
    auto& noise = table.at("devices").at(0).at("kinds").at("noise perlin");
    EXPECT_GE(noise.at("standard").at("ns").get<double>(), 0);
    EXPECT_GT(noise.at("standard").at("max").get<double>(), noise.at("exact").at("max").get<double>());

    noise.at("standard").at("max") = 100;  // now only what claims less will do
    for (const auto& [variant, ns] : std::map<std::string, int>{{"standard", 1}, {"exact", 2}, {"double", 1000}})
        noise.at(variant).at("ns") = ns;
    write_text(place / "cache/precision.json", table.dump());
    const auto precision = [&] {
        const Ran ran = place.run("run scene.toml --max-error 0.9 --json", cache);
        return ran.code == 0 ? nlohmann::json::parse(ran.out).at("budget").at("precision").get<std::string>() : ran.err;
    };
    EXPECT_NE(precision().find("exact \"dunes\""), std::string::npos) << precision();
    write_text(place / "cache/precision.json", "{}");
    expect_mentions(precision(), {"cache/precision.json", "wrinkle tune"});
    expect_failed(place.run("tune nowhere.toml", cache), {"nowhere.toml"});
}

}  // namespace
}  // namespace wrinkle::test
