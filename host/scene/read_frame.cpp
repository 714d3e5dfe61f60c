#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <vector>

#include "base/names.h"
#include "base/vec.h"
#include "io/camera_check.h"
#include "scene/readers.h"
#include "wrinkle/gbuffer.h"

namespace wrinkle::scene {
namespace {

const std::string kPictures[] = {"normal", "lit", "before"};

void read_matrices(Table& table, CameraSource& out) {
    table.require("view");
    table.require("proj");
    Camera camera;
    const bool has_view = table.read_matrix("view", camera.view), has_proj = table.read_matrix("proj", camera.proj);
    if (has_view) {
        const std::string problem = io::why_not_rigid(camera.view);
        if (!problem.empty()) table.complain("view", problem);
    }
    if (has_proj && !io::inverse_or_nothing(camera.proj)) table.complain("proj", "is singular: it has no inverse");
    out.inline_camera = camera;
}

/// One of fov (which is fov_y), fov_x and lens, the last with sensor and fit.
void read_field_of_view(Table& table, CameraSource::LookAt& look) {
    constexpr Range angle{.low = 0, .high = 180, .low_is_allowed = false, .high_is_allowed = false};
    std::string first;
    for (const char* key : {"fov", "fov_y", "fov_x", "lens"}) {
        if (!table.has(key)) continue;
        if (!first.empty())
            table.complain(key,
                           fmt::format("states the field of view again, beside {}; keep one of them", quote(first)));
        else
            first = key;
    }
    if (first.empty()) table.require("fov");
    table.read_degrees("fov", look.fov_y, angle);
    table.read_degrees("fov_y", look.fov_y, angle);
    table.read_degrees("fov_x", look.fov_x, angle);
    Lens lens;
    const bool has_lens = table.read("lens", lens.focal, positive);
    if (table.has("sensor") && !table.is_array("sensor")) {
        double both = 0;
        if (table.read("sensor", both, positive)) lens.sensor = {both, both};
    } else {
        table.read("sensor", lens.sensor, positive);
    }
    table.choose(
        "fit", lens.fit,
        {{"auto", Lens::Fit::automatic}, {"horizontal", Lens::Fit::horizontal}, {"vertical", Lens::Fit::vertical}},
        Compiled::no);
    for (const char* key : {"sensor", "fit"})
        if (table.has(key) && !table.has("lens")) table.complain(key, "has an effect only with the key \"lens\"");
    if (has_lens) look.lens = lens;
    table.read("shift", look.shift);
}

void read_look_at(Table& table, CameraSource& out) {
    CameraSource::LookAt look;
    for (const char* key : {"eye", "target"}) table.require(key);
    table.read("eye", look.eye);
    table.read("target", look.target);
    table.read("up", look.up);
    read_field_of_view(table, look);
    if (!table.is_bad("eye") && !table.is_bad("target") && !table.is_bad("up")) {
        if (look.eye == look.target)
            table.complain("target", "must not be the same point as eye");
        else if (const Vec3 along = subtract(look.target, look.eye); parallel(along, look.up)) {
            const char* other = parallel(along, {0, 1, 0}) ? "up = [0, 0, 1]" : "up = [0, 1, 0]";
            if (table.has("up"))
                table.complain("up", fmt::format("is zero or parallel to the viewing direction; set {}", other));
            else
                table.complain("target", fmt::format("makes the viewing direction parallel to up, which is [0, 0, 1] "
                                                     "unless given; set {}",
                                                     other));
        }
    }
    out.look_at = look;
}

/// A way to state the camera: any of its keys chooses it.
struct Form {
    std::vector<const char*> keys;
    void (*read)(Table& table, CameraSource& out);
};

const std::vector<Form>& camera_forms() {
    static const std::vector<Form> forms = {
        {{"file"},
         [](Table& table, CameraSource& out) { table.read_file("file", out.file, Table::FramePattern::kept); }},
        {{"from"},
         [](Table& table, CameraSource& out) {
             enum class From { header, positions };
             From from{};
             if (table.choose("from", from, {{"exr", From::header}, {"positions", From::positions}}))
                 (from == From::header ? out.exr : out.positions) = true;
         }},
        {{"view", "proj"}, read_matrices},
        {{"eye", "target", "up", "fov", "fov_x", "fov_y", "lens", "sensor", "fit", "shift"}, read_look_at},
    };
    return forms;
}

/// A role names a layer (`position = "P"`), or each of its planes a channel (`position.x = "P.X"`, quoted or not).
void read_roles(Table& table, std::map<std::string, std::string>& out) {
    std::string name;
    for (const Role& role : gbuffer_roles()) {
        if (table.is_table(role.name)) {
            Table components = *table.table(role.name, role.name + " of " + table.where());
            for (const std::string& plane : role.planes)
                if (plane.starts_with(role.name + "."))
                    if (components.read(plane.substr(role.name.size() + 1), name)) out[plane] = name;
            components.finish();
        } else if (table.read(role.name, name)) {
            out[role.name] = name;
        }
        for (const std::string& plane : role.planes)
            if (plane != role.name && table.has(plane) && table.read(plane, name)) out[plane] = name;
    }
    table.finish();
}

}  // namespace

void read_gbuffer(Table& table, GBufferSource& out) {
    if (!table.visits()) {
        table.read("view", out.view);
        table.document().view = out.view;
        table.require("file");
        table.read_file("file", out.file, Table::FramePattern::kept);
        if (table.document().view_in_names) out.view.clear();  // a file for each view holds no other
        table.read("layer", out.layer);
        table.read("overscan", out.overscan);
        if (auto beauty = table.table("beauty", "beauty of " + table.where())) {
            beauty->require("file");
            beauty->read_file("file", out.beauty_file, Table::FramePattern::kept);
            beauty->read("layer", out.beauty_layer);
            beauty->finish();
        }
        if (auto roles = table.table("roles", "roles of " + table.where())) read_roles(*roles, out.roles);
    }
    table.choose("geometry", out.geometry,
                 {{"auto", Geometry::automatic}, {"depth", Geometry::depth}, {"position", Geometry::position}});
    table.choose("depth", out.depth,
                 {{"auto", DepthKind::automatic}, {"planar", DepthKind::planar}, {"ray", DepthKind::ray}},
                 Compiled::no);
    table.choose("normals", out.normals,
                 {{"auto", NormalKind::automatic},
                  {"signed", NormalKind::sign},
                  {"packed", NormalKind::packed},
                  {"camera", NormalKind::camera}},
                 Compiled::no);
    if (auto uv = table.table("uv", "uv of " + table.where())) {
        uv->choose("v", out.v, {{"auto", VDirection::automatic}, {"up", VDirection::up}, {"down", VDirection::down}},
                   Compiled::no);
        uv->finish();
    }
    table.finish();
}

void read_camera(Table& table, CameraSource& out) {
    const Form* chosen = nullptr;
    std::string first;
    for (const Form& form : camera_forms())
        for (const char* key : form.keys) table.know(key);
    for (const Form& form : camera_forms())
        for (const char* key : form.keys) {
            if (!table.has(key) || chosen == &form) continue;
            if (chosen) {
                table.complain(key, fmt::format("states the camera again, beside {} at line {}; keep one of them",
                                                quote(first), table.line_of(first)));
                break;
            }
            chosen = &form;
            first = key;
        }
    if (chosen) chosen->read(table, out);
    table.read("max_residual", out.max_residual, positive);
    table.finish();
}

void read_filter(Table& table, Filter& out) {
    table.read("taps", out.taps, 1, 64);
    table.compiled_in("taps", std::string(out.taps > 1 ? "several" : "1"));
    table.choose("light", out.light_mean, {{"taps", false}, {"mean", true}});
    table.read("curvature", out.curvature);
    table.finish();
}

namespace {

void read_png(Table& table, Output& out) {
    constexpr int byte = 8, two_bytes = 16;
    bool wanted = out.png != 0;
    if (table.is_integer("png"))
        table.read("png", out.png, byte, two_bytes);
    else if (!table.visits() && table.read("png", wanted, Compiled::no))
        out.png = wanted ? byte : 0;
    if (out.png != 0 && out.png != byte && out.png != two_bytes)
        table.complain("png", "must be false, 8 or 16, the bits of a channel");
    table.read("pictures", out.pictures);
    for (const std::string& picture : out.pictures)
        if (std::ranges::find(kPictures, picture) == std::end(kPictures))
            table.complain("pictures", fmt::format("names {}; allowed: {}", quote(picture), quote_list(kPictures)));
}

/// The folder is the command line's to choose, so that a scene of somebody else's cannot write where it likes.
void read_output_name(Table& table, Output& out) {
    if (!table.read_name("name", out.name)) return;
    const std::filesystem::path name(out.name);
    if (name.filename() != name || lower(name.extension().string()) != ".exr" || name.stem() == ".")
        table.complain("name", fmt::format("is {}; expected the name of an EXR file without its folder (-o), such as "
                                           "\"bump.####.exr\" for one file of all channels, or \"<picture>.####.exr\"",
                                           quote(out.name)));
}

}  // namespace

void read_output(Table& table, Output& out) {
    table.read("roughness", out.roughness);
    table.read("slope_covariance", out.slope_covariance);
    table.read("surface_gradient", out.surface_gradient);
    table.read("dp_dx", out.dp_dx);
    table.read("dp_dy", out.dp_dy);
    table.read("marked", out.marked);
    table.read("layers", out.layers);
    table.read("condition", out.condition, Compiled::no);
    table.choose("size", out.beauty_size, {{"data", false}, {"beauty", true}}, Compiled::no);
    table.read("passthrough", out.passthrough, Compiled::no);
    table.read("half", out.half, Compiled::no);
    read_png(table, out);
    read_output_name(table, out);
    table.choose("compression", out.compression,
                 {{"zip", Compression::zip},
                  {"zips", Compression::zips},
                  {"dwaa", Compression::dwaa},
                  {"none", Compression::none}},
                 Compiled::no);
    table.choose("channel_names", out.channel_names,
                 {{"normal.X", ChannelNames::layers}, {"N.x", ChannelNames::passes}}, Compiled::no);
    table.finish();
}

void read_budget(Table& table, ErrorBudget& out) {
    constexpr Range angle{.low = 0, .high = 180, .low_is_allowed = false};
    const auto read = [&](const char* key, std::optional<double>& budget) {
        double degrees = budget.value_or(angle.high);
        if (table.read(key, degrees, angle) && !table.visits()) budget = degrees;
    };
    if (!table.has("max_area_error")) table.require("max_error");
    read("max_error", out.max_error);
    read("max_area_error", out.max_area_error);
    table.read("sample", out.sample, 1, std::numeric_limits<int>::max());
    table.read("seed", out.seed, 0, std::numeric_limits<int>::max());
    table.finish();
}

}  // namespace wrinkle::scene
