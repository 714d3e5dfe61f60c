// Every kind of layer, by its row: nothing here names a kind.
#include "layers/kinds.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <set>
#include <sstream>

#include "base/text_file.h"
#include "scene/kinds.h"

namespace wrinkle {
namespace {

const std::filesystem::path data_folder = WRINKLE_SOURCE_DIR "/data";

std::vector<std::string> keys_of(const LayerKind& kind) {
    return scene::keys_of(scene::Kind<Layer>{kind.name, kind.read});
}

/// The names in `backticks` of a text.
std::set<std::string> names_in(const std::string& text) {
    std::set<std::string> names;
    for (std::size_t from = text.find('`'); from != std::string::npos;) {
        const std::size_t to = text.find('`', from + 1);
        if (to == std::string::npos) break;
        names.insert(text.substr(from + 1, to - from - 1));
        from = text.find('`', to + 1);
    }
    return names;
}

/// What the table of layers in the documentation of scenes says: keys, and the kinds that it lists.
struct Documented {
    std::set<std::string> keys, kinds;
};
Documented documented() {
    std::istringstream lines(read_text(data_folder / "scenes/README.md"));
    Documented out;
    bool in_table = false;
    for (std::string line; std::getline(lines, line);) {
        if (line.starts_with("**`[[layer]]`**")) in_table = true;
        if (!in_table || !line.starts_with("|")) {
            if (in_table && !out.keys.empty() && !line.starts_with("|")) break;
            continue;
        }
        const std::size_t end = line.find('|', 1);
        const std::set<std::string> keys = names_in(line.substr(1, end - 1));
        if (keys.contains("kind")) out.kinds = names_in(line.substr(line.rfind('|', line.size() - 2)));
        out.keys.insert(keys.begin(), keys.end());
    }
    return out;
}

TEST(Kinds, AreTheAlternativesOfABumpInTheirOrder) {
    ASSERT_EQ(layer_kinds().size(), std::variant_size_v<decltype(Layer::bump)>);
    std::set<std::string> names;
    for (const LayerKind* kind : layer_kinds()) {
        EXPECT_TRUE(names.insert(kind->name).second) << kind->name;
        EXPECT_NE(kind->read, nullptr) << kind->name;
        EXPECT_EQ(kind->emit == nullptr, kind->ends_stage) << kind->name;
    }
    const Layer first;
    EXPECT_STREQ(kind_of(layer_kinds(), first).name, first.kind());
}

TEST(Kinds, AreDocumentedWithAllTheirKeys) {
    const Documented docs = documented();
    std::set<std::string> keys{"kind", "name"}, kinds;
    for (const LayerKind* kind : layer_kinds()) {
        kinds.insert(kind->name);
        for (const std::string& key : keys_of(*kind)) keys.insert(key);
    }
    EXPECT_EQ(docs.kinds, kinds);
    EXPECT_EQ(docs.keys, keys);
}

TEST(Kinds, HaveASceneEach) {
    std::set<std::string> shown;
    for (const auto& entry : std::filesystem::directory_iterator(data_folder / "scenes")) {
        if (entry.path().extension() != ".toml") continue;
        for (const Layer& layer : load_scene(entry.path()).layers) shown.insert(layer.kind());
    }
    for (const LayerKind* kind : layer_kinds()) EXPECT_TRUE(shown.contains(kind->name)) << kind->name;
}

TEST(Kinds, HaveVariantsFromCheapToExact) {
    for (const auto& entry : std::filesystem::directory_iterator(data_folder / "scenes")) {
        if (entry.path().extension() != ".toml") continue;
        const Scene scene = load_scene(entry.path());
        for (std::size_t i = 0; i < scene.layers.size(); ++i) {
            const auto ladder = layer_precisions(layer_kinds(), scene, i, CameraKind::pinhole);
            EXPECT_TRUE(std::ranges::count(ladder, Precision::standard) == 1 && std::ranges::is_sorted(ladder))
                << entry.path() << " " << scene.layers[i].name;
        }
    }
}

}  // namespace
}  // namespace wrinkle
