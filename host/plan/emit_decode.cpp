#include <fmt/format.h>

#include <algorithm>

#include "plan/geometry_text.h"
#include "plan/stored_planes.h"

namespace wrinkle {
namespace {

/// `lines`, indented one level deeper.
std::string indented(const std::string& lines) {
    std::string text;
    for (std::size_t begin = 0, end; begin < lines.size(); begin = end) {
        end = std::min(lines.find('\n', begin), lines.size() - 1) + 1;
        text += "    " + lines.substr(begin, end - begin);
    }
    return text;
}

/// The planes that the helper for neighbours loads: as its parameters, if there are `formats`, or as the arguments of a
/// call.
std::string neighbour_planes(const GeometryText& geometry, bool object, const PlaneFormats* formats) {
    std::string text;
    std::vector<std::string> planes = geometry.planes;
    planes.insert(planes.end(), {"normal.x", "normal.y", "normal.z"});
    if (object) planes.push_back("object");
    for (const std::string& plane : planes)
        text += fmt::format(", {}{}", formats != nullptr ? input_type(plane, *formats) : "", identifier(plane));
    return text;
}

/// Text of the function that loads a neighbour. It does not test for NaN and Inf: they fail the comparisons of
/// wr_belongs.
std::string neighbour_helper(const GeometryText& geometry, bool object, const PlaneFormats& formats,
                             const std::array<std::string, 2>& values) {
    const std::string load = "wr_load_near({}, at, pixels)";
    const bool depth = geometry.planes.size() == 1;
    std::string text =
        "/// The pixel at (x, y) and `at`, as a neighbour of the one being evaluated, with what u and v hold there.\n"
        "wr_fn wr_neighbour wr_neighbour_at(constant const wr_camera *camera, long at, long pixels, wr_real x, wr_real "
        "y,\n"
        "                                   wr_vec3 along, " +
        geometry.here + neighbour_planes(geometry, object, &formats) +
        fmt::format(", {}u, {}v)\n{{\n", input_type(values[0], formats), input_type(values[1], formats));
    text += load_normal(load, "    ") + load_geometry(geometry, load, "    ") + "    " + geometry.step + "\n";
    text += fmt::format(
        "    wr_mask valid = (x > 0) & (y > 0) & (x < camera->width) & (y < camera->height){};\n"
        "    wr_vec2 uv = wr_v2(wr_to_real(wr_load_near(u, at, pixels)), wr_to_real(wr_load_near(v, at, pixels)));\n"
        "    wr_vec3 n = wr_v3(wr_to_real(nx), wr_to_real(ny), wr_to_real(nz));\n"
        "    wr_real object = {};\n"
        "    return (wr_neighbour){{uv, p, n, object, valid}};\n}}\n\n",
        depth ? " & (wr_to_real(z) > 0) & (wr_to_real(z) < WR_BACKGROUND_DEPTH)" : "",
        object ? "wr_to_real(wr_load_near(in_object, at, pixels))" : "0");
    return text;
}

/// Kernel text that compares a pixel with its neighbours. It declares the pixel as `self`, with the texts `uv` and
/// `valid` as its members; then comes what `use` makes of the texts of the neighbours before and after it, for each
/// image axis. A neighbour's uv is loaded from the two planes `values`.
template <class Use>
std::string neighbours_text(Emitter& emitter, const GeometryText& geometry, Section& section,
                            const std::array<std::string, 2>& values, const std::string& uv, const std::string& valid,
                            const Use& use) {
    const bool object = emitter.has("object");
    if (object) section.inputs.insert("object");
    const std::string helper = neighbour_helper(geometry, object, emitter.plan.formats, values);
    if (emitter.helpers.find(helper) == std::string::npos) emitter.helpers += helper;  // another for other formats
    emitter.plan.neighbours = true;
    const std::string planes = neighbour_planes(geometry, object, nullptr) +
                               fmt::format(", {}, {}", identifier(values[0]), identifier(values[1]));
    std::string text = fmt::format(
        "        long here = at.in, row = width;\n"
        "        wr_neighbour self = {{{}, wr_zero3(), unturned, {}, {}}};\n"
        "        wr_vec3 right = wr_v3(camera->dx), down = wr_v3(camera->dy);\n"
        "        wr_vec3 left = wr_scale(right, (wr_real)(-1)), up = wr_scale(down, (wr_real)(-1));\n",
        uv, object ? "wr_load(in_object, at.in)" : "0", valid);
    const struct {
        const char *before, *after, *name;
    } axes[] = {{"here - 1, in_pixels, at.x - 1, at.y, left", "here + 1, in_pixels, at.x + 1, at.y, right", "dx"},
                {"here - row, in_pixels, at.x, at.y - 1, up", "here + row, in_pixels, at.x, at.y + 1, down", "dy"}};
    for (const auto& axis : axes)
        text += use(axis.name, fmt::format("wr_neighbour_at(camera, {}, {}{})", axis.before, geometry.given, planes),
                    fmt::format("wr_neighbour_at(camera, {}, {}{})", axis.after, geometry.given, planes));
    return text;
}

/// Sets dn_dx and dn_dy. Under a condition: else GPUs hold all neighbours up to the layer that reads them.
std::string emit_turning(Emitter& emitter, const GeometryText& geometry, Section& section) {
    section.operations += 200;
    return "        if (wr_any(valid)) {\n" +
           neighbours_text(emitter, geometry, section, {"normal.x", "normal.x"}, "wr_v2((wr_real)(0), (wr_real)(0))",
                           "valid",
                           [](const char* axis, const std::string& before, const std::string& after) {
                               return fmt::format(
                                   "        dn_{0} = wr_normal_difference(self, {1},\n"
                                   "                                     {2}, dp_{0});\n",
                                   axis, before, after);
                           }) +
           "        }\n";
}

/// Sets uv and uv_valid. Screen derivatives come from the planes duv_dx, duv_dy if the G-buffer has them, else from
/// dp_du, dp_dv, else from differences to neighbours.
std::string emit_uv(Emitter& emitter, const GeometryText& geometry, const std::vector<const Layer*>& mapped,
                    Section& section) {
    section.inputs.insert({"uv.u", "uv.v"});
    std::string text =
        "        wr_floats u = wr_load_floats(in_uv_u, at.in), v = wr_load_floats(in_uv_v, at.in);\n"
        "        uv_valid = valid & wr_finite(u) & wr_finite(v);\n";
    const auto all = [&](std::initializer_list<const char*> planes) {
        for (const char* plane : planes)
            if (!emitter.has(plane)) return false;
        return true;
    };
    if (all({"duv_dx.u", "duv_dx.v", "duv_dy.u", "duv_dy.v"})) {
        for (const char* axis : {"dx", "dy"}) {
            for (const char* part : {"u", "v"}) {
                const std::string plane = fmt::format("duv_{}.{}", axis, part);
                section.inputs.insert(plane);
                text += fmt::format(
                    "        wr_floats {1}_{2} = wr_load_floats({0}, at.in);\n"
                    "        uv_valid = uv_valid & wr_finite({1}_{2});\n"
                    "        uv.{1}.{3} = wr_to_real({1}_{2});\n",
                    identifier(plane), axis, part, part[0] == 'u' ? 'x' : 'y');
            }
        }
    } else if (all({"dp_du.x", "dp_du.y", "dp_du.z", "dp_dv.x", "dp_dv.y", "dp_dv.z"})) {
        for (const char* side : {"du", "dv"}) {
            text += fmt::format("        wr_vec3 dp_{};\n", side);
            for (const char axis : {'x', 'y', 'z'}) {
                const std::string plane = fmt::format("dp_{}.{}", side, axis);
                section.inputs.insert(plane);
                text += fmt::format(
                    "        {{ wr_floats a = wr_load_floats({0}, at.in); uv_valid = uv_valid & wr_finite(a); "
                    "dp_{1}.{2} "
                    "= "
                    "wr_to_real(a); }}\n",
                    identifier(plane), side, axis);
            }
        }
        text +=
            "        uv.dx = wr_texcoord_step(dp_dx, dp_du, dp_dv, &uv_valid);\n"
            "        uv.dy = wr_texcoord_step(dp_dy, dp_du, dp_dv, &uv_valid);\n";
        section.operations += 90;
    } else {
        // Differences read four neighbours. Groups of pixels where no layer uses the coordinates skip that, unless
        // `marked` is written, which tells for every pixel whether it has usable neighbours.
        const bool everywhere = emitter.options.split || !emitter.options.skip || emitter.scene.output.marked;
        const std::string wanted = everywhere ? "" : emit_wanted(emitter, mapped, section);
        text += wanted + fmt::format("        wr_mask usable = uv_valid{};\n", wanted.empty() ? "" : " & wanted") +
                "        if (wr_any(usable)) {\n" +
                indented(neighbours_text(
                    emitter, geometry, section, {"uv.u", "uv.v"}, "wr_v2(wr_to_real(u), wr_to_real(v))", "uv_valid",
                    [](const char* axis, const std::string& before, const std::string& after) {
                        return fmt::format(
                            "        wr_texcoord_change to_{0} = wr_texcoord_difference(self, {1},\n"
                            "                                       {2}, dp_{0}, &usable);\n",
                            axis, before, after);
                    }));
        text +=
            "            wr_texcoord_from_changes(to_dx, to_dy, dp_dx, dp_dy, &uv.dx, &uv.dy);\n        }\n"
            "        uv_valid = usable;\n";
        section.operations += 340;
    }
    text +=
        "        marked += (valid & !uv_valid) ? (wr_real)(4) : (wr_real)(0);\n"
        "        uv.st = wr_select(uv_valid, wr_v2(wr_to_real(u), wr_to_real(v)), wr_v2((wr_real)(0), (wr_real)(0)));\n"
        "        uv.dx = wr_select(uv_valid, uv.dx, wr_v2((wr_real)(0), (wr_real)(0)));\n"
        "        uv.dy = wr_select(uv_valid, uv.dy, wr_v2((wr_real)(0), (wr_real)(0)));\n";
    return text;
}

/// Sets vertex_tb and vertex_tb_valid from the planes of the renderer's tangents.
std::string emit_vertex_frame(const Emitter& emitter, Section& section) {
    std::string text = "        vertex_tb_valid = valid;\n";
    const auto load = [&](const std::string& plane, const std::string& name) {
        section.inputs.insert(plane);
        text += fmt::format(
            "        wr_floats {0} = wr_load_floats({1}, at.in);\n"
            "        vertex_tb_valid = vertex_tb_valid & wr_finite({0});\n",
            name, identifier(plane));
    };
    const bool sign = emitter.has("tangent_sign");
    for (const char axis : {'x', 'y', 'z'}) load(fmt::format("tangent.{}", axis), fmt::format("t{}", axis));
    if (sign) load("tangent_sign", "sign");
    for (const char axis : {'x', 'y', 'z'})
        if (!sign) load(fmt::format("bitangent.{}", axis), fmt::format("b{}", axis));
    const auto vector = [](char name) {
        return fmt::format(
            "wr_select(vertex_tb_valid, wr_v3(wr_to_real({0}x), wr_to_real({0}y), wr_to_real({0}z)), wr_zero3())",
            name);
    };
    section.operations += 60;
    return text + fmt::format(
                      "        vertex_tb = wr_vertex_frame({},\n            {},\n            {});\n"
                      "        marked += (valid & !vertex_tb_valid & (marked < 4)) ? (wr_real)(4) : (wr_real)(0);\n",
                      vector('n'), vector('t'), sign ? "wr_to_real(sign)" : vector('b'));
}

}  // namespace

std::string emit_height_taps(Emitter& emitter, const std::string& plane, Section& section) {
    const GeometryText geometry = geometry_text(emitter);
    section.inputs.insert(geometry.planes.begin(), geometry.planes.end());
    section.inputs.insert({"normal.x", "normal.y", "normal.z", plane});
    section.reads.insert({"valid", "marked"});
    section.writes.insert("marked");
    section.operations += 300;
    const std::string height = identifier(plane);
    const std::string differences =
        neighbours_text(emitter, geometry, section, {plane, plane}, "wr_v2(wr_to_real(height), (wr_real)(0))", "usable",
                        [](const char* axis, const std::string& before, const std::string& after) {
                            return fmt::format(
                                "        dh.{1} = wr_height_difference(self, {2},\n"
                                "                                     {3}, step_{0}, &usable);\n",
                                axis, axis[1], before, after);
                        });
    // Whether neighbours lie on one surface is judged by the positions and normals of the frame, in later stages too.
    return "        wr_vec2 dh;\n        {\n" + load_geometry(geometry, "wr_load_floats({}, at.in)", "        ") +
           sanitize(geometry, "        ") + "        wr_real x = at.x, y = at.y;\n        " + geometry.position + "\n" +
           load_normal("wr_load_floats({}, at.in)", "        ") +
           "        wr_vec3 unturned = wr_renormalize(\n"
           "            wr_select(valid, wr_v3(wr_to_real(nx), wr_to_real(ny), wr_to_real(nz)), n));\n"
           "        wr_vec3 step_dx, step_dy;\n        {\n        wr_vec3 n = unturned, dp_dx, dp_dy;\n" +
           face_viewer_text(emitter) + derivative_text(emitter) +
           "        step_dx = dp_dx, step_dy = dp_dy;\n        }\n" +
           fmt::format(
               "        wr_floats height = wr_load_floats({}, at.in);\n"
               "        wr_mask usable = active & wr_finite(height);\n{}"
               "        dh = wr_select(usable, dh, wr_v2((wr_real)(0), (wr_real)(0)));\n"
               "        wr_real low_bits = marked - 8 * wr_floor(marked / 8);\n"
               "        marked += (active & !usable & (low_bits < 4)) ? (wr_real)(4) : (wr_real)(0);\n        }}\n",
               height, differences);
}

Section emit_decode(Emitter& emitter, const std::set<std::string>& wanted, const std::vector<const Layer*>& mapped) {
    const GeometryText geometry = geometry_text(emitter);
    Section section;
    section.title = "decode the G-buffer";
    section.inputs.insert(geometry.planes.begin(), geometry.planes.end());
    std::string& text = section.body;
    text = load_geometry(geometry, "wr_load_floats({}, at.in)", "        ");
    const bool normal = emitter.options.normal;
    if (normal) {
        emitter.need("the base normal", {"normal.x", "normal.y", "normal.z"});
        section.inputs.insert({"normal.x", "normal.y", "normal.z"});
        text += load_normal("wr_load_floats({}, at.in)", "        ");
    }
    text += fmt::format("        valid = {}{};\n", normal ? "wr_valid_normal(nx, ny, nz) & " : "", geometry.valid);
    text += "        marked = valid ? (wr_real)(0) : (wr_real)(1);\n";
    text += sanitize(geometry, "        ") + "        wr_real x = at.x, y = at.y;\n        " +
            geometry.position.substr(std::string("wr_vec3 ").size()) + "\n";
    if (wanted.contains("p_low")) {
        text +=
            fmt::format("        wr_pair3 position = {};\n        p = wr_high(position), p_low = wr_low(position);\n",
                        geometry.pairs);
        section.writes.insert("p_low");
        section.operations += 60;
    }
    section.writes.insert({"valid", "marked", "p"});
    if (normal) {
        text +=
            "        n = wr_select(valid, wr_v3(wr_to_real(nx), wr_to_real(ny), wr_to_real(nz)), wr_v3((wr_real)(0), "
            "(wr_real)(0), "
            "(wr_real)(1)));\n"
            "        n = wr_renormalize(n);\n"
            "        wr_vec3 unturned = n;\n";
        text += "        {\n" + face_viewer_text(emitter) +
                "        marked += (valid & away) ? (wr_real)(2) : (wr_real)(0);\n        }\n";
        section.writes.insert("n");
        section.operations += 30;
    } else if (wanted.contains("dp_dx")) {
        text += fmt::format("        wr_vec3 n = wr_scale(wr_normalize({}), (wr_real)(-1));\n", view_text(emitter));
    }
    if (wanted.contains("base")) {
        text += "        base = n;\n";
        section.writes.insert("base");
    }
    if (wanted.contains("dp_dx")) {
        text += "        {\n" + derivative_text(emitter, geometry.along) + "        }\n";
        section.writes.insert({"dp_dx", "dp_dy"});
        section.operations += 62;
    }
    if (wanted.contains("uv")) {
        text += emit_uv(emitter, geometry, mapped, section);
        section.writes.insert({"uv", "uv_valid"});
    }
    if (wanted.contains("vertex_tb")) {
        text += emit_vertex_frame(emitter, section);
        section.writes.insert({"vertex_tb", "vertex_tb_valid"});
    }
    if (wanted.contains("dn_dx")) {
        text += emit_turning(emitter, geometry, section);
        section.writes.insert({"dn_dx", "dn_dy"});
    }
    return section;
}

}  // namespace wrinkle
