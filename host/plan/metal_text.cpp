#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "io/object_ids.h"
#include "plan/planned_numbers.h"
#include "plan/section.h"
#include "wrinkle/error.h"

#include "layout.h"

namespace wrinkle {

static_assert(MetalPicture::kVertices == WR_METAL_SIZE + 1);

namespace {

/// Throws Error unless metal `number` of a scene that was made in code has all its colours.
void check_metal(const MetalPicture& picture, std::size_t number) {
    constexpr std::size_t all = MetalPicture::kVertices * MetalPicture::kVertices;
    const auto finite = [](const Vec3& c) { return std::ranges::all_of(c, [](double v) { return std::isfinite(v); }); };
    if (picture.seen.size() != all)
        throw Error(fmt::format("metal {} of the lighting has {} colours, and there have to be {}", number,
                                picture.seen.size(), all));
    if (!std::ranges::all_of(picture.seen, finite))
        throw Error(fmt::format("metal {} of the lighting has a colour that is not finite", number));
}

}  // namespace

bool relights_metal(const Emitter& emitter) {
    const Lighting& lighting = emitter.scene.lighting;
    return emitter.options.write_normal && lighting.relight == Relight::ratio && lighting.metals &&
           !lighting.metals->empty();
}

void add_metals(Emitter& emitter) {
    if (!relights_metal(emitter)) return;
    if (const std::size_t count = emitter.scene.lighting.metals->size(); count > WR_METALS)
        throw Error(
            fmt::format("the lighting has {} metals, and {} fit in the memory for constants", count, WR_METALS));
    std::string text =
        "wr_long_fn wr_vec3 wr_mirrored_by_metal(wr_vec3 n, wr_vec3 base, wr_vec3 v, wr_real object,\n"
        "    constant const WR_SCALAR *metals)\n{\n"
        "    wr_vec3 l = wr_mirrored_direction(n, base, v), seen = wr_zero3();\n    wr_mask is;\n";
    for (std::size_t k = 0; k < emitter.scene.lighting.metals->size(); ++k) {
        const std::size_t first = add_numbers(emitter, fmt::format("metal {}", k + 1), [k](const NumberSource& source) {
            std::vector<double> numbers;
            if (!source.scene.lighting.metals || source.scene.lighting.metals->size() <= k) return numbers;
            const MetalPicture& picture = (*source.scene.lighting.metals)[k];
            check_metal(picture, k + 1);
            numbers.push_back(io::object_label(picture.object));
            for (const Vec3& colour : picture.seen) numbers.insert(numbers.end(), colour.begin(), colour.end());
            return numbers;
        });
        text += fmt::format(
            "    is = object == metals[{0}];\n"
            "    if (wr_any(is)) seen = wr_select(is, wr_metal_seen(metals + {0} + 1, l), seen);\n",
            first);
    }
    emitter.helpers += text + "    return seen;\n}\n\n";
}

std::string metal_object_text(Emitter& emitter, Section& section) {
    if (!emitter.has("object")) return "        wr_real metal_object = 0;\n";
    section.inputs.insert("object");
    return "        wr_real metal_object = wr_load(in_object, at.in);\n";
}

}  // namespace wrinkle
