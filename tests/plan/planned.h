#pragma once

#include <gtest/gtest.h>

#include "layers/kinds.h"
#include "wrinkle/error.h"
#include "wrinkle/gbuffer.h"

/// Scenes to plan, frames to plan them for, and checks of plans.
namespace wrinkle::test {

inline Available everything() {
    Available all;
    for (const Role& role : gbuffer_roles()) all.planes.insert(role.planes.begin(), role.planes.end());
    all.planes.insert({"crypto.id0", "crypto.coverage0", "channel:dirt"});
    all.cryptomatte = {{"Rock", 0x12345678u}, {"Wall", 0x9abcdef0u}};
    return all;
}

inline Layer layer(decltype(Layer::bump) bump, const std::string& name = "bump") {
    Layer l;
    l.name = name;
    l.bump = std::move(bump);
    return l;
}

inline NormalMapLayer normal_map() {
    NormalMapLayer l;
    l.texture.file = "weave.png";
    return l;
}

inline DecalLayer decal(const char* file = "seal.png") {
    DecalLayer l;
    l.texture.file = file;
    l.texture.wrap = Wrap::clamp;
    return l;
}

inline Scene scene_of(std::vector<Layer> layers) {
    Scene scene;
    scene.layers = std::move(layers);
    return scene;
}

/// The text of a plan's kernels, without the includes before it.
inline std::string kernels(const Plan& plan) { return plan.source.substr(plan.source.rfind("#include")); }
inline bool mentions(const Plan& plan, const std::string& text) {
    return kernels(plan).find(text) != std::string::npos;
}

using Names = std::vector<std::string>;

inline std::vector<std::string> titles(const Plan& plan) {
    std::vector<std::string> list;
    for (const SectionSummary& section : plan.sections) list.push_back(section.title);
    return list;
}

/// The numbers of a plan whose description holds `what`, in order.
inline std::vector<double> numbers(const Plan& plan, const Scene& scene, const std::string& what,
                                   const Available& all = everything()) {
    std::vector<double> found;
    for (const PlannedNumbers& planned : plan.numbers)
        if (planned.name.find(what) != std::string::npos)
            for (const double value : numbers_of(planned, {scene, all.cryptomatte})) found.push_back(value);
    return found;
}

inline std::string refusal(const Scene& scene, const Available& available) {
    try {
        make_plan(scene, available);
    } catch (const Error& error) { return error.what(); }
    return "nothing was refused";
}

inline void expect_mentions(const std::string& text, const Names& parts) {
    for (const std::string& part : parts) EXPECT_NE(text.find(part), std::string::npos) << part << " in: " << text;
}

}  // namespace wrinkle::test
