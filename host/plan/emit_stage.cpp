#include <fmt/format.h>

#include "plan/geometry_text.h"
#include "plan/stored_planes.h"

namespace wrinkle {

Section emit_resolve(Emitter& emitter, const StageEnd& stage) {
    Section section;
    section.title = "resolve";
    section.reads = {"valid", "n"};
    section.writes = {"n", "g"};
    std::string derivatives, bend, sums;
    if (stage.wants_derivatives) {
        derivatives = "        {\n" + derivative_text(emitter) + "        }\n";
        section.reads.insert("p");
        section.writes.insert({"dp_dx", "dp_dy"});
        section.operations += 62;
        if (stage.derivatives) section.reads.insert({"dp_dx", "dp_dy"});
    }
    if (stage.surface || stage.volume) {
        sums = "wr_nonzero(g)";
        section.reads.insert({"marked", "g"});
        section.writes.insert("marked");
        section.operations += 24;
        bend =
            "        wr_vec3 flat = n, bumped = wr_resolve(n, g);\n"
            "        wr_mask sound = wr_sound(bumped);\n"
            "        n = wr_select(bent & sound, bumped, n);\n"
            "        marked += (bent & !sound & (marked < 8)) ? (wr_real)(8) : (wr_real)(0);\n";
    }
    if (stage.volume) {
        sums += " | wr_nonzero(dh_dp)";
        section.reads.insert("dh_dp");
        section.operations += 30;
        bend = "        g = wr_add(g, wr_surface_gradient_from_volume(n, dh_dp));\n" + bend;
    }
    if (stage.more) {
        section.reads.insert("p");
        section.writes.insert("dh_dp");
    }
    std::string& text = section.body;
    if (!bend.empty()) {
        // A normal that no layer bends keeps its bits.
        text = emitter.options.skip
                   ? fmt::format("        wr_mask bent = valid & ({});\n        if (wr_any(bent)) {{\n", sums)
                   : "        wr_mask bent = valid;\n        {\n";
        text += bend;
        if (stage.more)
            text += "        {\n" + face_viewer_text(emitter) + "        }\n        n = wr_select(bent, n, flat);\n";
        if (stage.derivatives && stage.wants_derivatives)
            text += "        wr_vec3 flat_dx = dp_dx, flat_dy = dp_dy;\n" + derivatives +
                    "        dp_dx = wr_select(bent, dp_dx, flat_dx), dp_dy = wr_select(bent, dp_dy, flat_dy);\n";
        text += "        }\n";
    }
    if (stage.turns && stage.more) text += "        {\n" + face_viewer_text(emitter) + "        }\n";
    if (!stage.derivatives && stage.wants_derivatives) text += derivatives;
    if (stage.more) text += "        g = wr_zero3();\n        dh_dp = wr_zero3();\n";
    return section;
}

Section emit_output(Emitter& emitter, bool bumped) {
    const Output& output = emitter.scene.output;
    Section section;
    section.title = "write";
    section.reads = {"valid"};
    std::string& text = section.body;
    const auto store = [&](const std::string& plane, const std::string& value) {
        section.outputs.push_back(plane);
        text += fmt::format("        wr_stream({}, out_{}, at.out);\n", value, identifier(plane).substr(3));
    };
    const auto store3 = [&](const std::string& role, const std::string& value) {
        section.reads.insert(value);
        for (const char axis : {'x', 'y', 'z'})
            store(fmt::format("{}.{}", role, axis), fmt::format("valid ? {}.{} : (wr_real)(0)", value, axis));
    };
    if (emitter.options.volume_gradient) {
        store3("volume_gradient", "dh_dp");
        return section;
    }
    if (emitter.options.write_normal) {
        section.reads.insert("n");
        section.inputs.insert({"normal.x", "normal.y", "normal.z"});
        // An invalid pixel keeps its normal, unless that is not finite.
        const bool octahedral = is_octahedral(emitter.plan.output_formats);
        for (const char axis : {'x', 'y', 'z'}) {
            text += fmt::format("        wr_floats n{0} = wr_load_floats(in_normal_{0}, at.in);\n", axis);
            const std::string plane = fmt::format("normal.{}", axis),
                              kept = fmt::format("valid ? n.{0} : wr_to_real(wr_valid_or(n{0}, wr_finite(n{0}), 0))",
                                                 axis);
            if (!octahedral) {
                store(plane, kept);
                continue;
            }
            section.outputs.push_back(plane);
            text += fmt::format("        n.{} = {};\n", axis, kept);
        }
        if (octahedral) text += "        wr_stream_octahedral(n, out_normal_x, at.out);\n";
    }
    if (output.surface_gradient) {
        if (!bumped) text += "        g = wr_zero3();\n";
        store3("surface_gradient", "g");
    }
    if (output.dp_dx) store3("dp_dx", "dp_dx");
    if (output.dp_dy) store3("dp_dy", "dp_dy");
    const std::string spread = spreads_by_curvature(emitter) ? "wr_add(spread, turning)" : "spread";
    if (output.slope_covariance || output.roughness) section.reads.insert("spread");
    if (spreads_by_curvature(emitter)) section.reads.insert("turning");
    if (output.slope_covariance) {
        const struct {
            char axis;
            const char* name;
        } parts[] = {{'x', "xx"}, {'y', "xy"}, {'z', "yy"}};
        for (const auto& part : parts)
            store(fmt::format("slope_covariance.{}", part.name),
                  fmt::format("valid ? {}.{} : (wr_real)(0)", spread, part.axis));
    }
    if (output.roughness) {
        text += roughness_text(emitter, section);
        store("roughness", fmt::format("wr_widened_roughness(roughness, {})", spread));
    }
    if (output.marked) {
        section.reads.insert("marked");
        store("marked", "marked");
    }
    if (emitter.scene.lighting.relight != Relight::off) {
        section.reads.insert("lit");
        const struct { char axis, color; } parts[] = {{'x', 'r'}, {'y', 'g'}, {'z', 'b'}};
        for (const auto& part : parts) store(fmt::format("lit.{}", part.color), fmt::format("lit.{}", part.axis));
    }
    return section;
}

}  // namespace wrinkle
