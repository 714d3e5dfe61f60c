#pragma once

#include <functional>
#include <limits>
#include <regex>

#include "tests/scene/scene_folder.h"
#include "wrinkle/layers.h"

namespace wrinkle {

inline constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// Scenes made in code, whose problems are compared with those of files that say the same.
class Check : public SceneFolder {
protected:
    std::filesystem::path wall() const { return folder_ / "textures/wall.png"; }

    template <class Bump>
    Layer layer(Bump bump = {}) const {
        Layer layer;
        layer.name = "bump";
        if constexpr (requires { bump.texture; }) bump.texture.file = wall();
        layer.bump = std::move(bump);
        return layer;
    }

    static std::string problems_of(const Scene& scene) {
        try {
            check(scene);
        } catch (const Error& error) { return error.what(); }
        return {};
    }

    static std::string problems_of(const Layer& layer) {
        Scene scene;
        scene.layers = {layer};
        return problems_of(scene);
    }

    static void expect_refused(const Layer& layer, const std::vector<std::string>& parts) {
        const std::string found = problems_of(layer);
        for (const std::string& part : parts) EXPECT_NE(found.find(part), std::string::npos) << part << "\n" << found;
    }

    /// What a file with this text is refused for, as if it were of no file.
    std::string of_file(const std::string& text) const {
        std::string all;
        for (const std::string& problem : problems(frame_ + text)) {
            const std::string bare = std::regex_replace(problem, std::regex("^courtyard.toml:[0-9]+: "), "");
            all +=
                (all.empty() ? "" : "\n") + std::regex_replace(bare, std::regex("\\[\\[(layer|light)\\]\\] "), "$1 ");
        }
        return all;
    }

    /// A slip: as a line of a file, and in code.
    template <class Bump>
    struct Slip {
        const char* line;
        std::function<void(Bump&, Layer&)> make;
    };

    /// Each slip is refused, in code as in a file of a layer of that kind and these keys.
    template <class Bump>
    void expect_same(const std::string& keys, const Bump& sound, const std::vector<Slip<Bump>>& slips) const {
        EXPECT_EQ(problems_of(layer(sound)), "");
        for (const Slip<Bump>& slip : slips) {
            Layer wrong = layer(sound);
            slip.make(std::get<Bump>(wrong.bump), wrong);
            const std::string text = "[[layer]]\nname = \"bump\"\nkind = \"" + std::string(Bump::kind) + "\"\n" +
                                     (keys.empty() ? "" : keys + "\n") + slip.line + "\n";
            const std::string of_code = problems_of(wrong);
            EXPECT_NE(of_code, "") << slip.line;
            EXPECT_EQ(of_code, of_file(text)) << slip.line;
        }
    }

    const std::string texture_ = "texture = \"textures/wall.png\"";
};

}  // namespace wrinkle
