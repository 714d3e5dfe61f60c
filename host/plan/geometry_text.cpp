#include "plan/geometry_text.h"

#include <fmt/format.h>

#include "wrinkle/error.h"

namespace wrinkle {

GeometryText geometry_text(const Emitter& emitter) {
    const Available& available = emitter.available;
    const Geometry wanted = emitter.scene.gbuffer.geometry;
    const bool depth_possible = emitter.has("depth") && available.camera != CameraKind::general &&
                                !(available.ray_depth && available.camera == CameraKind::parallel);
    const bool depth = wanted == Geometry::depth || (wanted == Geometry::automatic && depth_possible);
    if (depth) {
        emitter.need("geometry from depth", {"depth"});
        if (!depth_possible)
            throw Error(
                "geometry from depth needs a pinhole camera, or planar depth under a parallel projection; set "
                "geometry = \"position\"");
        const bool parallel = available.camera == CameraKind::parallel;
        const std::string number =
            available.device_depth == DeviceDepth::minus_one_to_one ? "2 * wr_to_real({}) - 1" : "wr_to_real({})";
        const std::string view = fmt::format("wr_{}view_depth(camera, {})", parallel ? "parallel_" : "", number);
        return {{"depth"},
                available.device_depth == DeviceDepth::none ? "{}" : view,
                "wr_valid_depth(z)",
                parallel              ? "wr_vec3 p = wr_parallel_position(camera, x, y, wr_to_real(z));"
                : available.ray_depth ? "wr_vec3 p = wr_scale(wr_normalize(wr_ray(camera, x, y)), wr_to_real(z));"
                                      : "wr_vec3 p = wr_scale(wr_ray(camera, x, y), wr_to_real(z));",
                parallel || available.ray_depth ? "wr_along_ray(p, d)" : "wr_to_real(z)",
                parallel              ? ""
                : available.ray_depth ? "wr_distant_position_pairs(camera, x, y, wr_to_real(z))"
                                      : "wr_position_pairs(camera, x, y, wr_to_real(z))",
                "wr_vec3 ray, wr_real from",
                parallel ? "wr_v3(camera->forward), wr_to_real(z)" : "wr_ray(camera, at.x, at.y), wr_to_real(z)",
                parallel              ? "wr_vec3 p = wr_fma(ray, wr_to_real(z) - from, along);"
                : available.ray_depth ? "wr_vec3 p = wr_distant_step(ray, along, from, wr_to_real(z));"
                                      : "wr_vec3 p = wr_planar_step(ray, along, from, wr_to_real(z));"};
    }
    const std::string file = emitter.scene.gbuffer.file.string(), here = file.empty() ? "" : file + ": ";
    if (wanted == Geometry::automatic && !emitter.has("depth") && !emitter.has("position.x"))
        emitter.need(here + "geometry, by a depth or a position pass,", {"depth"});
    emitter.need(here + (wanted == Geometry::automatic && emitter.has("depth")
                             ? "geometry under a camera that its depth does not serve"
                             : "geometry from positions"),
                 {"position.x", "position.y", "position.z"});
    return {{"position.x", "position.y", "position.z"},
            "",
            "wr_valid_position(px, py, pz)",
            "wr_vec3 p = wr_eye_relative(camera, wr_v3(wr_to_real(px), wr_to_real(py), wr_to_real(pz)));",
            "wr_along_ray(p, d)",
            "wr_eye_relative_pairs(camera, wr_v3(wr_to_real(px), wr_to_real(py), wr_to_real(pz)))",
            "wr_vec3 from",
            "wr_v3(wr_to_real(px), wr_to_real(py), wr_to_real(pz))",
            "wr_vec3 p = wr_sub(wr_v3(wr_to_real(px), wr_to_real(py), wr_to_real(pz)), from);"};
}

std::string load_geometry(const GeometryText& geometry, const std::string& load, const std::string& indent) {
    std::string text;
    if (geometry.planes.size() == 1) {
        text += fmt::format("{}wr_floats z = {};\n", indent,
                            fmt::format(fmt::runtime(geometry.depth), fmt::format(fmt::runtime(load), "in_depth")));
    } else {
        for (const char axis : {'x', 'y', 'z'})
            text += fmt::format("{}wr_floats p{} = {};\n", indent, axis,
                                fmt::format(fmt::runtime(load), fmt::format("in_position_{}", axis)));
    }
    return text;
}

std::string load_normal(const std::string& load, const std::string& indent) {
    std::string text;
    for (const char axis : {'x', 'y', 'z'})
        text += fmt::format("{}wr_floats n{} = {};\n", indent, axis,
                            fmt::format(fmt::runtime(load), fmt::format("in_normal_{}", axis)));
    return text;
}

std::string sanitize(const GeometryText& geometry, const std::string& indent) {
    std::string text = geometry.planes.size() == 1 ? indent + "z = wr_valid_or(z, valid, 1);\n" : "";
    if (geometry.planes.size() == 3)
        for (const char axis : {'x', 'y', 'z'})
            text += fmt::format("{0}p{1} = wr_valid_or(p{1}, valid, {2});\n", indent, axis, axis == 'z' ? 1 : 0);
    return text;
}

const char* view_text(const Emitter& emitter) {
    return emitter.available.camera == CameraKind::parallel ? "wr_v3(camera->forward)" : "p";
}

std::string to_viewer_text(const Emitter& emitter, const std::string& p) {
    return fmt::format("wr_normalize(wr_scale({}, (wr_real)(-1)))",
                       emitter.available.camera == CameraKind::parallel ? "wr_v3(camera->forward)" : p);
}

std::string derivative_text(const Emitter& emitter, const std::string& along) {
    const bool exact = emitter.geometry_precision() == Precision::exact;
    if (emitter.available.camera != CameraKind::pinhole)
        return fmt::format("        wr_screen_derivatives_general{}(camera, n, p, at.x, at.y, &dp_dx, &dp_dy);\n",
                           exact ? "_exact" : "");
    const std::string ray = "        wr_vec3 d = wr_ray(camera, at.x, at.y);\n";
    if (exact)
        return ray + "        wr_screen_derivatives_exact(camera, n, " + along + ", at.x, at.y, &dp_dx, &dp_dy);\n";
    return ray + "        wr_screen_derivatives(camera, n, d, " + along + ", at.x, at.y, &dp_dx, &dp_dy);\n";
}

std::string face_viewer_text(const Emitter& emitter) {
    return fmt::format(
        "        wr_mask away;\n"
        "        n = wr_face_viewer(n, {}, &away);\n",
        view_text(emitter));
}

}  // namespace wrinkle
