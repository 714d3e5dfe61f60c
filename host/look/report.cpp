#include "look/report.h"

#include <OpenImageIO/strutil.h>
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "look/look.h"
#include "look/look_data.h"
#include "look/look_picture.h"
#include "look/page.h"
#include "wrinkle/error.h"

namespace wrinkle {
namespace {

using nlohmann::json;

constexpr std::uint32_t kLongest = 1920;

using TableRows = std::vector<std::pair<std::string, std::string>>;

std::string data_url(const LookImage& image, const std::string& picture) {
    return "data:image/webp;base64," + OIIO::Strutil::base64_encode(webp_of(image, picture, kLongest));
}

/// A view for each layer alone, beside the same without any.
void add_layers(json& views, Look& look, const Scene& scene) {
    std::set<std::size_t> all;
    for (std::size_t i = 0; i < scene.layers.size(); ++i) all.insert(i);
    const char* const picture = scene.lighting.relight == Relight::off ? "normal" : "lit";
    const std::string none = data_url(*look.evaluate(scene, all, false), picture);
    const json layers = layers_of(scene);
    for (std::size_t i = 0; i < layers.size(); ++i) {
        if (layers[i]["resolve"] == true) continue;
        std::set<std::size_t> others = all;
        others.erase(i);
        views.push_back({{"id", fmt::format("layer {}", i)},
                         {"title", layers[i]["name"]},
                         {"note", "this layer alone"},
                         {"before", none},
                         {"before_title", "no layer"},
                         {"after_title", layers[i]["name"]},
                         {"after", data_url(*look.evaluate(scene, others, false), picture)}});
    }
}

TableRows timings(const RenderReport& run) {
    const auto seconds = [](double value) { return fmt::format("{:.3f} s", value); };
    return {{"read", seconds(run.read)},
            {"upload (textures)", seconds(run.upload)},
            {run.cache_hit ? "build (cache hit)" : "build (compiled)", seconds(run.build)},
            {"kernels", fmt::format("{:.3f} s, {:.2f} ns/pixel", run.kernels, run.kernel_ns_per_pixel)},
            {"check in double", seconds(run.check)},
            {"write", seconds(run.write)},
            {"wall (phases overlap)", seconds(run.wall)},
            {"peak memory", fmt::format("{:.0f} MiB", static_cast<double>(run.peak_memory) / (1 << 20))}};
}

TableRows errors_of_areas(const RenderReport& run) {
    if (!run.taps) return {};
    const TapsChoice& choice = *run.taps;
    return {{"max_area_error", fmt::format("{} degrees", choice.max_area_error)},
            {"taps", fmt::format("{} of at most {}", choice.taps, choice.most)},
            {"of pixels' areas",
             fmt::format("{:.2g} degrees (median), {:.2g} (99%) on {} pixels, seed {}", choice.measured.median,
                         choice.measured.p99, choice.measured.samples, choice.seed)}};
}

TableRows errors(const RenderReport& run) {
    TableRows areas = errors_of_areas(run);
    if (!run.budget) {
        areas.emplace_back("normals", "not measured; \"wrinkle run --max-error DEGREES\" does");
        return areas;
    }
    const BudgetReport& budget = *run.budget;
    TableRows rows = {{"max_error", fmt::format("{} degrees", budget.max_error)},
                      {"precision", budget.precision},
                      {"median", fmt::format("{:.1e} degrees", budget.measured.median)},
                      {"99%", fmt::format("{:.1e} degrees", budget.measured.p99)},
                      {"largest", fmt::format("{:.1e} degrees", budget.measured.max)},
                      {"measured", fmt::format("{} pixels, seed {}", budget.measured.samples, budget.seed)}};
    for (const std::string& miss : budget.misses) rows.emplace_back("missed by", miss);
    rows.insert(rows.end(), areas.begin(), areas.end());
    return rows;
}

TableRows origins(const ReportOf& report, const Look& look) {
    const RenderReport& run = report.run;
    TableRows rows = {{"wrinkle", WRINKLE_VERSION},
                      {"scene", report.scene.file.string()},
                      {"frame", look.reader().path().string()},
                      {"camera", look.camera().origin + "; " + describe_residual(look.camera())},
                      {"device", fmt::format("{}, {} lanes", look.device().info.name, look.device().info.lanes)},
                      {"hash of all inputs", report.provenance}};
    for (const std::string& setting : report.set) rows.emplace_back("set", setting);
    if (!run.lights.empty()) rows.emplace_back("lights", run.lights);
    for (const auto& file : run.files) rows.emplace_back("wrote", file.string());
    return rows;
}

TableRows frames(const RenderReport& run) {
    TableRows rows = {{"evaluated", fmt::format("{}", run.frames)}, {"there already", fmt::format("{}", run.skipped)}};
    for (const FrameReport& frame : run.failed)
        rows.emplace_back(fmt::format("frame {} failed", frame.frame), frame.error);
    return rows;
}

}  // namespace

void write_report(AtomicFile& file, const ReportOf& report) {
    const Scene& scene = report.scene;
    Look look(Device::open(report.device));
    look.open(scene, report.frame);
    const auto image = look.evaluate(scene, {}, scene.output.condition);
    json views = views_of(*image, [&](const std::string& picture) { return data_url(*image, picture); });
    add_layers(views, look, scene);
    const Size size = image->size;
    const std::uint32_t step = (std::max(size.width, size.height) + kLongest - 1) / kLongest;
    json data = {
        {"title", scene.file.filename().string()},
        {"version", 0},
        {"status",
         fmt::format("{} x {}{}", size.width, size.height, step == 1 ? "" : fmt::format(", shown at 1 : {}", step))},
        {"size", {(size.width + step - 1) / step, (size.height + step - 1) / step}},
        {"views", std::move(views)},
        {"layers", layers_of(scene)},
        {"marked", marked_legend()},
        {"problems", json::array()},
        {"warnings", report.run.warnings},
        {"source", report.source},
        {"tables",
         {{{"title", "Time"}, {"rows", timings(report.run)}},
          {{"title", "Error"}, {"rows", errors(report.run)}},
          {{"title", "Origin"}, {"rows", origins(report, look)}}}},
    };
    if (report.run.frames + report.run.skipped + static_cast<int>(report.run.failed.size()) > 1)
        data["tables"].push_back({{"title", "Frames"}, {"rows", frames(report.run)}});
    file.write(page_of(data, false));
    file.commit();
}

}  // namespace wrinkle
