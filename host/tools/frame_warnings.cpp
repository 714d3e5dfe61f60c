#include "tools/frame_warnings.h"

#include <fmt/format.h>

#include <algorithm>

#include "io/mixed_normals.h"
#include "plan/layer_text.h"
#include "plan/section.h"
#include "resources/texture_heap.h"
#include "run/open_frame.h"
#include "run/pass_impl.h"
#include "wrinkle/error.h"

namespace wrinkle {

namespace {

bool uses_uv_pass(const Layer& layer) {
    const UvMapping* uv = find_uv(layer);
    const bool own = uv != nullptr && uv->source == UvSource::aov;
    return own || (layer.mask.texture && layer.mask.texture->uv.source == UvSource::aov);
}

std::string problem_of_uv(const RoleMap& roles, io::UvDigits digits) {
    const bool derivatives =
        (roles.has_role("duv_dx") && roles.has_role("duv_dy")) || (roles.has_role("dp_du") && roles.has_role("dp_dv"));
    if (derivatives || digits == io::UvDigits::enough) return {};
    return fmt::format(
        "the UV pass ({}) is {}-bit: its steps from pixel to pixel have too few digits for slopes; render it "
        "in 32 bits, or render dp_du and dp_dv, or use uv = {{ source = \"planar\" }}",
        roles.channel_of.find("uv.u")->second, digits == io::UvDigits::half ? 16 : 8);
}

}  // namespace

std::string uv_problem(const GBufferInfo& info) { return problem_of_uv(info.roles, info.uv_digits); }

std::vector<std::string> frame_warnings(const Scene& scene, const GBufferReader& reader, const FrameCamera& camera) {
    std::vector<std::string> lines = camera.doubts;
    constexpr double kManyMixed = 0.003;
    if (const double mixed = io::mixed_normals(reader); mixed >= kManyMixed)
        lines.push_back(fmt::format(
            "normals: {:.1f}% of the pixels hold the mean of several surfaces' (they are shorter than 0.9), as do the "
            "other passes there, so edges are bumped as if one surface lay in between; render the data passes with one "
            "sample a pixel, or larger than the picture and without a filter (beauty = {{ file = ... }} in [gbuffer])",
            100 * mixed));
    const auto layer = std::ranges::find_if(scene.layers, uses_uv_pass);
    if (layer == scene.layers.end()) return lines;
    if (const std::string uv = problem_of_uv(reader.roles(), io::uv_digits(reader)); !uv.empty())
        lines.push_back(fmt::format("{}: {}", layer_label(*layer), uv));
    return lines;
}

std::vector<std::string> scene_warnings(const Scene& scene, int number) {
    try {
        Plan plan = plan_for(scene, describe_frame(scene, number), {});
        std::erase_if(plan.textures, [](const PlannedTexture& texture) { return !texture.grid.empty(); });
        return load_textures(plan.textures).doubts;
    } catch (const Error& error) { return {fmt::format("run refuses the scene: {}", error.what())}; }
}

}  // namespace wrinkle
