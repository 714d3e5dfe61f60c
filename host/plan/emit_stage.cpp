#include <fmt/format.h>

#include "plan/geometry_text.h"

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
        // What nothing bends stays as it is, bit by bit.
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

Section emit_lighting(Emitter& emitter) {
    const Lighting& lighting = emitter.scene.lighting;
    const bool ratio = lighting.relight == Relight::ratio;
    Section section;
    section.title = ratio ? "relight the picture by lit(new) / lit(old)" : "light";
    section.reads = {"valid", "p", "n"};
    section.writes = {"lit"};
    const auto planes = [&](std::initializer_list<const char*> names) {
        for (const char* name : names)
            if (!emitter.has(name)) return false;
        section.inputs.insert(names.begin(), names.end());
        return true;
    };
    std::string& text = section.body;
    text = fmt::format("        wr_vec3 v = {};\n", to_viewer_text(emitter));
    text += planes({"albedo.r", "albedo.g", "albedo.b"})
                ? "        wr_vec3 albedo = wr_v3(wr_mask_channel(wr_load(in_albedo_r, at.in)),\n"
                  "                            wr_mask_channel(wr_load(in_albedo_g, at.in)),\n"
                  "                            wr_mask_channel(wr_load(in_albedo_b, at.in)));  // [0,1]; NaN is 0\n"
                : "        wr_vec3 albedo = wr_v3(lighting->albedo);\n";
    text += planes({"roughness"}) ? "        wr_real roughness = wr_load(in_roughness, at.in);\n"
                                  : "        wr_real roughness = lighting->roughness;\n";
    const double lights = static_cast<double>(lighting.lights.size());
    if (!ratio) {
        text +=
            "        lit = wr_light_surface(p, n, v, albedo, roughness, lighting, lights);\n"
            "        lit = wr_select(valid, lit, wr_zero3());\n";
        section.operations = 20 + 75 * lights;
        return section;
    }
    emitter.need("relight = \"ratio\"", {"beauty.r", "beauty.g", "beauty.b"});
    planes({"beauty.r", "beauty.g", "beauty.b"});
    section.reads.insert("base");
    section.operations = 40 + 125 * lights;
    text +=
        "        wr_vec3 old;\n"
        "        lit = wr_light_surface(p, n, base, v, albedo, roughness, lighting, lights, &old);\n";
    const struct { char axis, color; } parts[] = {{'x', 'r'}, {'y', 'g'}, {'z', 'b'}};
    for (const auto& part : parts)
        text += fmt::format(
            "        wr_floats raw_{1} = wr_load_floats(in_beauty_{1}, at.in);\n"
            "        wr_mask seen_{1} = wr_finite(raw_{1});\n"
            "        wr_real {1} = wr_to_real(wr_valid_or(raw_{1}, seen_{1}, 0));\n"
            "        lit.{0} = valid ? {1} * wr_relight_ratio(lit.{0}, old.{0}, lighting->max_ratio) : {1};\n",
            part.axis, part.color);
    if (emitter.scene.output.marked) {
        section.reads.insert("marked");
        section.writes.insert("marked");
        text += "        marked += (seen_r & seen_g & seen_b) ? (wr_real)(0) : (wr_real)(16);\n";
    }
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
        // An invalid pixel keeps what it had, unless that was not finite.
        for (const char axis : {'x', 'y', 'z'}) {
            text += fmt::format("        wr_floats n{0} = wr_load_floats(in_normal_{0}, at.in);\n", axis);
            store(fmt::format("normal.{}", axis),
                  fmt::format("valid ? n.{0} : wr_to_real(wr_valid_or(n{0}, wr_finite(n{0}), 0))", axis));
        }
    }
    if (output.surface_gradient) {
        if (!bumped) text += "        g = wr_zero3();\n";
        store3("surface_gradient", "g");
    }
    if (output.dp_dx) store3("dp_dx", "dp_dx");
    if (output.dp_dy) store3("dp_dy", "dp_dy");
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
