#include "plan/own_gradient.h"

#include <fmt/format.h>

#include <charconv>

namespace wrinkle {

namespace {

constexpr std::string_view kPlanes = "layer";

std::string store_text(const Section& section, const std::string& value) {
    std::string text;
    for (std::size_t axis = 0; axis < section.outputs.size(); ++axis)
        text += fmt::format("        wr_stream(valid ? {}.{} : (wr_real)(0), out_{}, at.out);\n", value, "xyz"[axis],
                            identifier(section.outputs[axis]).substr(3));
    return text;
}

std::string sum_name(const Section& section) { return identifier(section.outputs.front()).substr(3) + "_sum"; }

}  // namespace

bool writes_own_gradient(const Emitter& emitter, const Layer& layer) {
    return emitter.scene.output.layers && emitter.options.write_normal && !emitter.kind(layer).moves;
}

void add_own_gradient(Section& section, std::size_t index) {
    for (const char axis : {'x', 'y', 'z'}) section.outputs.push_back(fmt::format("{}{}.{}", kPlanes, index, axis));
    section.reads.insert({"valid", "n"});
    section.operations += 30;
    std::string before, own = "wr_zero3()";
    if (section.writes.contains("g")) {
        before += "        wr_vec3 g_before = g;\n";
        own = "wr_sub(g, g_before)";
    }
    if (section.writes.contains("dh_dp")) {
        before += "        wr_vec3 dh_dp_before = dh_dp;\n";
        own = fmt::format("wr_add({}, wr_surface_gradient_from_volume(n, wr_sub(dh_dp, dh_dp_before)))", own);
    }
    section.body = before + section.body + fmt::format("        wr_vec3 own = {};\n", own);
    section.body += section.area
                        ? fmt::format("        {0} = wr_select(on, wr_fma(own, share, {0}), {0});\n", sum_name(section))
                        : store_text(section, "own");
}

std::string own_sum_text(const Section& section) {
    return section.outputs.empty() ? "" : fmt::format("        wr_vec3 {} = wr_zero3();\n", sum_name(section));
}

std::string own_store_text(const Section& section) {
    return section.outputs.empty() ? "" : store_text(section, sum_name(section));
}

std::optional<std::size_t> layer_of_output(const std::string& plane) {
    if (!plane.starts_with(kPlanes)) return std::nullopt;
    std::size_t index = 0;
    const char* const end = plane.data() + plane.size();
    const auto [next, failure] = std::from_chars(plane.data() + kPlanes.size(), end, index);
    return failure == std::errc() && next != end && *next == '.' ? std::optional(index) : std::nullopt;
}

}  // namespace wrinkle
