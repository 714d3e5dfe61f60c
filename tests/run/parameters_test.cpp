// Numbers of a scene change without a plan or a compiler: every number of every scene of data/scenes.
#include <cctype>
#include <fstream>
#include <set>
#include <sstream>

#include "layers/kinds.h"
#include "run/pass_impl.h"
#include "scene/check_scene.h"
#include "tests/io/files.h"
#include "tests/run/decal_frames.h"

namespace wrinkle::test {
namespace {

/// A number in the text of a scene.
struct Number {
    std::size_t first = 0, size = 0;
    std::string table, key;
};

/// Every number of a scene's text, but those that are compiled in or that no pass reads.
std::vector<Number> numbers_of(const std::string& text) {
    const std::set<std::string> structure{"octaves"}, no_pass{"[output]", "[budget]", "[gbuffer]", "[camera]"};
    std::vector<Number> found;
    std::string table, key, word;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        const bool starts_line = i == 0 || text[i - 1] == '\n';
        if (c == '#' || (c == '[' && starts_line)) {
            const std::size_t end = std::min(text.find('\n', i), text.size());
            if (c == '[') table = text.substr(i, text.find_last_of(']', end) - i + 1);
            i = end;
        } else if (c == '"') {
            i = text.find('"', i + 1);
        } else if (std::isalpha(static_cast<unsigned char>(c))) {
            const std::size_t end = text.find_first_not_of("abcdefghijklmnopqrstuvwxyz_0123456789", i);
            word = text.substr(i, end - i);
            i = end - 1;
        } else if (c == '=') {
            key = word;
        } else if (std::isdigit(static_cast<unsigned char>(c)) || c == '-' || c == '+') {
            const std::size_t end = text.find_first_not_of("+-.0123456789e_", i);
            if (!structure.contains(key) && !no_pass.contains(table)) found.push_back({i, end - i, table, key});
            i = end - 1;
        }
    }
    return found;
}

/// Other values to try in its place: a reader may refuse some. Zero stays zero where it means "not at all".
std::vector<std::string> others(const std::string& value, const std::string& key) {
    const double x = std::stod(value);
    if (x == 0 && (key == "period" || key == "rotation")) return {};
    const bool whole = value.find_first_of(".e") == std::string::npos;
    if (whole)
        return {fmt::format("{}", x + 1), fmt::format("{}", x * 2), fmt::format("{}", x - 1), fmt::format("{}", x / 2)};
    return {fmt::format("{:f}", x + 0.125), fmt::format("{:f}", x * 0.75), fmt::format("{:f}", x - 0.0625)};
}

std::string text_of(const std::string& scene) {
    std::ifstream in(data_folder / "scenes" / (scene + ".toml"));
    std::string text{std::istreambuf_iterator<char>(in), {}};
    for (std::size_t at = text.find("\"../"); at != std::string::npos; at = text.find("\"../", at))
        text.replace(at, 4, "\"" + data_folder.string() + "/");
    for (const char* beside : {"\"decal_table.csv\""})
        if (const std::size_t at = text.find(beside); at != std::string::npos)
            text.insert(at + 1, (data_folder / "scenes").string() + "/");
    return text;
}

Scene load(const TempFolder& folder, const std::string& text) {
    std::ofstream(folder / "scene.toml") << text;
    return load_scene(folder / "scene.toml");
}

/// Calls `use` with every number of a scene's text changed, and the text that the change makes.
template <class Use>
void change_each(const TempFolder& folder, const std::string& text, const Use& use) {
    for (const Number& number : numbers_of(text)) {
        const std::string was = text.substr(number.first, number.size);
        std::string refusals;
        bool taken = false;
        for (const std::string& other : others(was, number.key)) {
            if (other == was) continue;
            const std::string changed = std::string(text).replace(number.first, number.size, other);
            try {
                use(number, changed, load(folder, changed));
                taken = true;
                break;
            } catch (const Error& error) { refusals += std::string("\n") + error.what(); }
        }
        const bool fixed = refusals.find("its last row is [0, 0, 0, 1]") != std::string::npos;
        EXPECT_TRUE(taken || fixed || refusals.empty())
            << number.table << " " << number.key << " = " << was << refusals;
    }
}

std::vector<std::string> scene_names() {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(data_folder / "scenes"))
        if (entry.path().extension() == ".toml") names.push_back(entry.path().stem());
    std::ranges::sort(names);
    return names;
}

class EveryScene : public testing::TestWithParam<std::string> {};

TEST_P(EveryScene, PlansTheSameTextForOtherNumbers) {
    const TempFolder folder;
    const HostFrame frame = small_frame();
    const std::string text = text_of(GetParam());
    const Scene scene = load(folder, text);
    const std::string source = plan_for(scene, frame.frame, {}).source;
    const auto structure = scene::structure_of(layer_kinds(), scene);
    std::size_t count = 0;
    change_each(folder, text, [&](const Number& number, const std::string&, const Scene& other) {
        EXPECT_EQ(plan_for(other, frame.frame, {}).source == source, true) << number.table << " " << number.key;
        EXPECT_NO_THROW(scene::require_same_structure(structure, scene::structure_of(layer_kinds(), other)));
        ++count;
    });
    EXPECT_GT(count, 5u);
}

void expect_same_bits(const Pixels& a, const Pixels& b, const std::string& what) {
    ASSERT_EQ(a.size(), b.size());
    for (const auto& [name, plane] : a)
        EXPECT_EQ(std::memcmp(plane.data(), b.at(name).data(), plane.size() * sizeof(float)), 0) << what << " " << name;
}

TEST_P(EveryScene, GivesTheBitsOfAPassOfEachOtherNumber) {
    const TempFolder folder;
    const HostFrame frame = small_frame();
    const std::string text = text_of(GetParam());
    const Scene scene = load(folder, text);
    TextureStore store(device());
    const auto fresh = [&](const Scene& of) {
        Pass pass = evaluate(device(), of, frame.frame, {}, &store);
        return run(pass, frame);
    };
    Pass pass = evaluate(device(), scene, frame.frame, {}, &store);
    const Pixels first = run(pass, frame);
    std::size_t seen = 0;
    change_each(folder, text, [&](const Number& number, const std::string&, const Scene& other) {
        pass.set_parameters(other);
        const Pixels got = run(pass, frame);
        expect_same_bits(got, fresh(other), number.table + " " + number.key);
        seen += largest_difference(got, first) > 0;
    });
    EXPECT_GT(seen, 3u) << "numbers that change a pixel";
    pass.set_parameters(scene);
    expect_same_bits(run(pass, frame), first, "changed back");
}

INSTANTIATE_TEST_SUITE_P(Scenes, EveryScene, testing::ValuesIn(scene_names()),
                         [](const auto& info) { return info.param; });

std::string refusal(Pass& pass, const Scene& scene) {
    try {
        pass.set_parameters(scene);
    } catch (const Error& error) { return error.what(); }
    return "nothing was refused";
}

void expect_mentions(const std::string& text, const std::vector<std::string>& parts) {
    for (const std::string& part : parts) EXPECT_NE(text.find(part), std::string::npos) << part << " in: " << text;
}

TEST(Parameters, ChangeTheNumberOfPointsOfAnArea) {
    const HostFrame frame = small_frame();
    Scene scene;
    scene.layers.resize(1);
    scene.layers[0].name = "grain";
    scene.layers[0].bump = NoiseLayer{.frequency = 3, .octaves = 3};
    scene.layers[0].scale = 0.1;
    Pass pass = evaluate(device(), scene, frame.frame);
    const Pixels of_16 = run(pass, frame);
    bool differs = false;
    for (const int taps : {2, 5, 64, 16}) {
        scene.filter.taps = taps;
        pass.set_parameters(scene);
        const Pixels changed = run(pass, frame);
        Pass fresh = evaluate(device(), scene, frame.frame);
        EXPECT_NE(fresh.impl().built.source, BuildSource::compiled) << taps;
        expect_same_bits(changed, run(fresh, frame), fmt::format("{} taps", taps));
        differs = differs || changed.at("normal.x") != of_16.at("normal.x");
    }
    EXPECT_TRUE(differs) << "no pixel of the frame is long enough to tell";
}

TEST(Parameters, StayWithinTheStructure) {
    const HostFrame frame = small_frame();
    Scene scene;
    scene.filter.taps = 1;
    scene.layers.resize(2);
    scene.layers[0].name = "grain";
    scene.layers[0].bump = NoiseLayer{.octaves = 2};
    scene.layers[1].name = "tilt";
    scene.layers[1].bump = ConstantLayer{{0.1, 0, 0}};
    Pass pass = evaluate(device(), scene, frame.frame);
    const Pixels before = run(pass, frame);
    const auto expect_refused = [&](const auto& change, const std::vector<std::string>& parts) {
        Scene other = scene;
        change(other);
        expect_mentions(refusal(pass, other), parts);
    };
    const auto noise = [](Scene& s) -> NoiseLayer& { return std::get<NoiseLayer>(s.layers[0].bump); };
    expect_refused([&](Scene& s) { noise(s).octaves = 3; },
                   {"\"octaves\" in layer \"grain\" is 3 where the pass is made for 2", "compiled in"});
    expect_refused([&](Scene& s) { noise(s).type = NoiseType::worley; },
                   {"\"type\" in layer \"grain\" is worley where the pass is made for perlin"});
    expect_refused([&](Scene& s) { noise(s).shape.power = 2; },
                   {"\"power\" in shape of layer \"grain\" is given where the pass is made for not given"});
    expect_refused([](Scene& s) { s.layers[1].mask.object = {1}; }, {"\"mask\" in layer \"tilt\" is given"});
    expect_refused([](Scene& s) { s.layers[1].bump = ResolveLayer{}; }, {"\"kind\" in layer \"tilt\" is resolve"});
    expect_refused([](Scene& s) { s.layers[1].project = false; }, {"\"project\" in layer \"tilt\""});
    expect_refused([](Scene& s) { s.layers.pop_back(); }, {"\"layer\" in the scene is 1"});
    expect_refused(
        [](Scene& s) {
            s.lighting.relight = Relight::lit, s.lighting.ambient = {1, 1, 1};
        },
        {"\"relight\" in [lighting] is lit where the pass is made for off"});
    expect_refused([](Scene& s) { s.output.dp_dx = true; }, {"\"dp_dx\" in [output]"});
    expect_refused([](Scene& s) { s.filter.taps = 2; },
                   {"\"taps\" in [filter] is several where the pass is made for 1"});
    expect_refused([&](Scene& s) { noise(s).frequency = -1; }, {"\"frequency\" in layer \"grain\" must be"});
    expect_same_bits(run(pass, frame), before, "after refusals");

    Scene other = scene;
    other.layers[0].name = "another name", other.layers[0].blend = Blend::subtract;
    other.output.half = other.output.condition = true;
    EXPECT_NO_THROW(pass.set_parameters(other));
}

TEST(Parameters, AreTheRowsOfATable) {
    const HostFrame frame = small_frame();
    const auto points = positions(frame);
    const Scene few = table_scene(decals_around(points, 20, 0.1, 0.4, 1));
    const Scene many = table_scene(decals_around(points, 70, 0.1, 0.4, 2));
    Pass pass = evaluate(device(), few, frame.frame), fresh = evaluate(device(), many, frame.frame);
    const Pixels wanted = run(fresh, frame), first = run(pass, frame);
    EXPECT_GT(largest_difference(first, wanted), 0);
    pass.set_parameters(many);
    expect_same_bits(run(pass, frame), wanted, "more rows");
    pass.set_parameters(few);
    expect_same_bits(run(pass, frame), first, "fewer again");

    auto rows = decals_around(points, 5, 0.1, 0.4, 3);
    rows[2].region = {0, 0, 0.5, 0.5};
    expect_mentions(refusal(pass, table_scene(rows)), {"\"rows\" in layer \"many\"", "0.5"});
    rows[2].region = {0, 0, 1, 1};
    rows[2].object = 3;
    expect_mentions(refusal(pass, table_scene(rows)), {"\"object\" in layer \"many\" is true"});
    expect_mentions(refusal(pass, table_scene({})), {"\"rows\" in layer \"many\""});
}

TEST(Parameters, OfAnAccumulation) {
    HostFrame frame = small_frame();
    const auto points = positions(frame);
    const Scene one = table_scene(decals_around(points, 20, 0.1, 0.4, 1));
    Scene other = table_scene(decals_around(points, 30, 0.1, 0.4, 2));
    other.layers[0].scale = 3;
    Pass pass = accumulate_decals(device(), one.layers, frame.frame);
    Pass fresh = accumulate_decals(device(), other.layers, frame.frame);
    pass.set_parameters(other);
    expect_same_bits(run(pass, frame), run(fresh, frame), "other rows");
}

}  // namespace
}  // namespace wrinkle::test
