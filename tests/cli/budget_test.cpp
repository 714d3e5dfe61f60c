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
    EXPECT_GT(budget.at("measured").at("max").get<double>(), 0);  // files are rounded to float, at least
    EXPECT_LE(budget.at("measured").at("pixels").get<int>(), 800);
    EXPECT_TRUE(
        nlohmann::json::parse(place.run("run scene.toml --json --max-error 1").out).at("budget").at("misses").empty());
}

/// A table of costs of this machine's device, with round numbers for the dunes.
void write_costs(const Workplace& place) {
    const auto device = nlohmann::json::parse(place.run("devices --json").out).at(0);
    const int lanes = device.at("lanes");
    const auto cost = [](double ns, double max) { return nlohmann::json{{"ns", ns}, {"p99", 0}, {"max", max}}; };
    const nlohmann::json kinds{
        {"geometry", {{"standard", cost(2, 0)}, {"exact", cost(3, 0)}, {"double", cost(8, 0)}}},
        {"noise perlin", {{"standard", cost(10, 0.5)}, {"exact", cost(20, 0.25)}, {"double", cost(90, 1e-6)}}}};
    const nlohmann::json table{
        {"class", fmt::format("{}, {} lane{}", device.at("type").get<std::string>(), lanes, lanes == 1 ? "" : "s")},
        {"device", device.at("name")},
        {"driver", device.at("driver")},
        {"kinds", kinds}};
    write_text(place / "cache/precision.json", nlohmann::json{{"devices", {table}}}.dump());
}

TEST(BudgetOption, ExplainTellsWhatARunStartsWith) {
    const Workplace place;
    const std::string cache = "WRINKLE_CACHE_DIR='" + (place / "cache").string() + "'";
    fs::create_directories(place / "cache");
    write_costs(place);
    place.write_scene(dunes);
    const auto explained = [&](const std::string& options) {
        const Ran ran = place.run("explain scene.toml --json " + options, cache);
        return ran.code == 0 ? nlohmann::json::parse(ran.out) : nlohmann::json(ran.err);
    };
    const auto standard = explained("");
    EXPECT_TRUE(standard.at("budget").is_null());
    EXPECT_TRUE(standard.at("device").is_null()) << "none is needed";
    EXPECT_EQ(explained("--device 0 --lanes 4").at("device").at("lanes"), 4);
    const auto areas = standard.at("areas");
    EXPECT_EQ(areas.at("taps"), 16);
    const auto dune = areas.at("degrees").at(0);
    EXPECT_EQ(dune.at("kind"), "noise perlin");
    EXPECT_EQ(dune.at("one_tap").at("taps"), 1);
    EXPECT_EQ(dune.at("scene_taps"), dune.at("one_tap")) << "it is not filtered";

    place.write_scene("[budget]\nmax_error = 0.75\n" + dunes);
    const auto loose = explained("");
    EXPECT_EQ(loose.at("source"), standard.at("source"));
    EXPECT_EQ(loose.at("budget").at("max_error"), 0.75);
    EXPECT_EQ(loose.at("budget").at("expected"), (nlohmann::json{{"ns_per_pixel", 12.0}, {"degrees", 0.5}}));
    const auto tight = explained("--max-error 0.3");
    EXPECT_NE(tight.at("source"), standard.at("source"));
    EXPECT_EQ(tight.at("budget").at("expected"), (nlohmann::json{{"ns_per_pixel", 22.0}, {"degrees", 0.25}}));
    const nlohmann::json geometry{
        {"name", "the geometry"}, {"variant", "standard"}, {"ns_per_pixel", 2.0}, {"degrees", 0.0}};
    const nlohmann::json exact{
        {"name", "layer \"dunes\""}, {"variant", "exact"}, {"ns_per_pixel", 20.0}, {"degrees", 0.25}};
    EXPECT_EQ(tight.at("budget").at("variants"), nlohmann::json::array({geometry, exact}));
    const auto tightest = explained("--max-error 0.1").at("budget");
    EXPECT_EQ(tightest.at("precision"), "everything in double");
    EXPECT_EQ(tightest.at("variants").at(1).at("variant"), "double");
    EXPECT_EQ(tightest.at("expected").at("ns_per_pixel"), 98.0);

    const auto ran = nlohmann::json::parse(place.run("run scene.toml --max-error 0.3 --json", cache).out).at("budget");
    for (const char* key : {"max_error", "precision", "costs", "expected"})
        EXPECT_EQ(ran.at(key), tight.at("budget").at(key)) << key;
    const Ran text = place.run("explain scene.toml --no-source --max-error 0.3", cache);
    EXPECT_TRUE(std::regex_search(text.out, std::regex(R"(layer "dunes" +exact +20\.00  2\.5e-01)"))) << text.out;
    EXPECT_TRUE(std::regex_search(text.out, std::regex(R"(together +22\.00  2\.5e-01)"))) << text.out;
    expect_failed(place.run("explain scene.toml", "OCL_ICD_VENDORS=/nonexistent"), {"OpenCL", "pocl-opencl-icd"});
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
    place.write_scene(dunes.substr(0, dunes.find("footprint")));  // filtered, so that taps count
    const std::string cache = "WRINKLE_CACHE_DIR='" + (place / "cache").string() + "'";
    const Ran tuned = place.run("tune scene.toml --repeat 1 --sample 500", cache);
    ASSERT_EQ(tuned.code, 0) << tuned.err;
    expect_mentions(tuned.out,
                    {"noise perlin", "standard", "exact", "double", "geometry", "->", "cache/precision.json"});
    expect_mentions(tuned.err, {"scene.toml: layer \"dunes\""});
    expect_mentions(tuned.out, {"over the areas that pixels show", "degrees off: median"});
    auto table = nlohmann::json::parse(read_text(place / "cache/precision.json"));
    const auto& rows = table.at("devices").at(0).at("areas").at("noise perlin");
    EXPECT_EQ(rows.size(), 5u);
    EXPECT_EQ(rows.at(4).at("taps"), 16);
    EXPECT_GT(rows.at(0).at("p99").get<double>(), rows.at(4).at("p99").get<double>());
    expect_mentions(
        place.run("explain scene.toml --no-source --device 0", cache).out,
        {"areas of pixels, with 16 taps", "one tap",
         fmt::format("{:.2g}, {:.2g}", rows.at(4).at("median").get<double>(), rows.at(4).at("p99").get<double>())});
    auto& noise = table.at("devices").at(0).at("kinds").at("noise perlin");
    EXPECT_GE(noise.at("standard").at("ns").get<double>(), 0);
    EXPECT_GT(noise.at("standard").at("max").get<double>(), noise.at("exact").at("max").get<double>());

    noise.at("standard").at("max") = 100;  // so that another variant has to be chosen
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
