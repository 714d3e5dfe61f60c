#include <fmt/format.h>

#include <algorithm>

#include "plan/decal_order.h"
#include "plan/emit_kernel.h"
#include "plan/section.h"
#include "plan/stored_planes.h"
#include "wrinkle/error.h"

namespace wrinkle {

namespace {

/// The user's own functions, with #line, so that the compiler reports errors by the user's file and line.
std::string user_text(const Emitter& emitter) {
    std::string text;
    for (const auto& [function, parameters] : emitter.user_parameters) text += parameters + "\n";
    for (const auto& [file, content] : emitter.user_files) text += content;
    return text;
}

/// The layers between two resolves.
struct Stage {
    std::vector<Section> layers;
    std::vector<const Layer*> mapped;  ///< those that use texture coordinates
    std::set<std::string> reads;
    StageEnd end;
};

std::vector<Stage> emit_stages(Emitter& emitter) {
    std::vector<Stage> stages(1);
    const std::vector<Layer>& layers = emitter.scene.layers;
    for (std::size_t i = 0; i < layers.size();) {
        if (emitter.kind(layers[i]).ends_stage) {
            stages.emplace_back();
            ++i;
            continue;
        }
        const std::size_t count =
            emitter.options.split || emitter.scene.output.layers ? 1 : layers_together(emitter.kinds, layers, i);
        std::vector<const Layer*> together;
        for (std::size_t k = 0; k < count; ++k) together.push_back(&layers[i + k]);
        Stage& stage = stages.back();
        stage.layers.push_back(emit_layers(emitter, together, stage.end.volume));
        const Section& section = stage.layers.back();
        if (section.reads.contains("uv")) stage.mapped.push_back(together.front());
        stage.reads.insert(section.reads.begin(), section.reads.end());
        stage.end.surface |= section.writes.contains("g");
        stage.end.volume |= section.writes.contains("dh_dp");
        stage.end.turns |= section.writes.contains("n");
        i += count;
    }
    return stages;
}

/// Whether light is to fall on every point of pixels' areas. It cannot where a layer that is evaluated once a pixel
/// comes after layers that vary over the area: it would bend normals that are lit already.
bool lights_points(const Emitter& emitter, const std::vector<Stage>& stages) {
    const Scene& scene = emitter.scene;
    if (!emitter.options.write_normal || scene.lighting.relight == Relight::off || scene.filter.light_mean ||
        scene.filter.taps == 1)
        return false;
    bool area = false;
    for (const Stage& stage : stages)
        for (const Section& section : stage.layers) {
            if (area && !section.area) return false;
            area |= section.area;
        }
    return area;
}

/// The sections of a stage, those joined that are consecutive and vary over pixels' areas.
std::vector<Section> join_areas(Emitter& emitter, Stage& stage, AreaUse& use) {
    std::vector<Section> joined;
    use.space = false;
    for (std::size_t i = 0; i < stage.layers.size();) {
        use.space |= stage.layers[i].writes.contains("dh_dp");
        if (!stage.layers[i].area) {
            joined.push_back(std::move(stage.layers[i++]));
            continue;
        }
        std::vector<Section> together;
        for (; i < stage.layers.size() && stage.layers[i].area; ++i) {
            use.space |= stage.layers[i].writes.contains("dh_dp");
            together.push_back(std::move(stage.layers[i]));
        }
        joined.push_back(emit_area(emitter, together, use));
        use.first = false;
    }
    return joined;
}

/// The sections of the whole evaluation, in order.
std::vector<Section> emit_sections(Emitter& emitter) {
    std::vector<Stage> stages = emit_stages(emitter);
    AreaUse area{wants_spread(emitter), lights_points(emitter, stages)};
    for (Stage& stage : stages) {
        stage.layers = join_areas(emitter, stage, area);
        for (const Section& section : stage.layers) stage.reads.insert(section.reads.begin(), section.reads.end());
    }
    std::set<std::string> first = stages.front().reads;
    std::vector<const Layer*> mapped;
    for (const Stage& stage : stages) {  // decoded once, for all stages; texture coordinates need derivatives
        mapped.insert(mapped.end(), stage.mapped.begin(), stage.mapped.end());
        if (stage.reads.contains("uv")) first.insert({"uv", "dp_dx"});
        if (stage.reads.contains("vertex_tb")) first.insert("vertex_tb");
        if (stage.reads.contains("p_low")) first.insert("p_low");
        if (stage.reads.contains("dn_dx")) first.insert({"dn_dx", "dp_dx"});
    }
    const Output& output = emitter.scene.output;
    const bool written = output.dp_dx || output.dp_dy;  // those of the last stage's surface
    if (written) first.insert("dp_dx");
    const bool relight = emitter.scene.lighting.relight != Relight::off;
    if (relight && emitter.options.write_normal) first.insert("base");

    std::vector<Section> sections;
    const auto add = [&](Section section, int stage) {
        section.stage = stage;
        sections.push_back(std::move(section));
    };
    if (spreads_by_curvature(emitter)) first.insert({"dn_dx", "dp_dx"});
    add(emit_decode(emitter, first, mapped), 0);
    if (spreads_by_curvature(emitter)) add(emit_curvature(), 0);
    bool bumped = false, derivatives = first.contains("dp_dx");
    for (std::size_t s = 0; s < stages.size(); ++s) {
        Stage& stage = stages[s];
        for (Section& layer : stage.layers) add(std::move(layer), static_cast<int>(s));
        const bool bends = stage.end.surface || stage.end.volume;
        stage.end.more = s + 1 < stages.size();
        if (!emitter.options.write_normal || !(bends || stage.end.more)) continue;
        stage.end.derivatives = derivatives && !stage.end.turns;  // a turned n may face away
        derivatives = stage.end.more && (written || stages[s + 1].reads.contains("dp_dx"));
        stage.end.wants_derivatives = derivatives;
        add(emit_resolve(emitter, stage.end), static_cast<int>(s));
        bumped |= bends;
    }
    const int last = static_cast<int>(stages.size()) - 1;
    add_mirrored_skies(emitter);
    add_metals(emitter);
    if (relight && emitter.options.write_normal) {
        LightEnd end{area.lights, area.spread, sums_light(emitter)};
        if (end.summed) add(emit_light_terms(emitter, end), last);
        add(emit_lighting(emitter, end), last);
    }
    add(emit_output(emitter, bumped), last);
    if (emitter.options.split)  // split kernels read the sums from memory: the first one has to write zeros there
        for (const char* sum : {"g", "dh_dp"})
            if (std::ranges::any_of(sections, [&](const Section& s) { return s.reads.contains(sum); }))
                sections.front().writes.insert(sum);
    return sections;
}

/// Adds the kernels of a plan: one of all sections, or one each; where light is added up over pixels of the picture,
/// one of those before and one of those after.
void add_kernels(Plan& plan, const std::vector<Section>& sections, const PlanOptions& options, std::uint32_t size) {
    const auto united = [](const std::vector<const Section*>& of, std::set<std::string> Section::*names) {
        std::set<std::string> all;
        for (const Section* section : of) all.insert((section->*names).begin(), (section->*names).end());
        return all;
    };
    std::set<std::string> means, stored;
    std::vector<const Section*> together, after;
    for (const Section& section : sections) after.push_back(&section);
    for (const Section& section : sections) {
        together.push_back(&section);
        after.erase(after.begin());
        if (!options.split && !section.summed && !after.empty()) continue;
        Handed handed;
        handed.loaded = united(together, &Section::reads);
        if (!options.split)
            std::erase_if(handed.loaded, [&](const std::string& value) { return !stored.contains(value); });
        if (options.split || section.summed) handed.stored = united(together, &Section::writes);
        if (!options.split)
            std::erase_if(handed.stored, [wanted = united(after, &Section::reads)](const std::string& value) {
                return !wanted.contains(value);
            });
        stored.insert(handed.stored.begin(), handed.stored.end());
        handed.means = means;
        const std::string name = options.split    ? fmt::format("wr_section_{}", plan.kernels.size())
                                 : section.summed ? "wr_light_terms"
                                                  : "wr_evaluate";
        plan.kernels.push_back(emit_kernel(plan, name, together, handed, options.compiled_numbers));
        together.clear();
        if (!section.summed) continue;
        means = section.writes;
        plan.kernels.push_back(emit_means(plan, means, size, options.compiled_numbers));
    }
}

/// The scene's numbers as text, under the name by which kernels know those in memory.
std::string numbers_text(const Plan& plan, const NumberSource& source) {
    std::string values = "0";
    for (const PlannedNumbers& planned : plan.numbers)
        for (const double value : numbers_of(planned, source)) values += fmt::format(", (WR_SCALAR){:.17e}", value);
    // One in front, as an array must not be empty.
    return fmt::format("constant WR_SCALAR wr_numbers[] = {{{}}};\n#define numbers (wr_numbers + 1)\n\n", values);
}

}  // namespace

Plan make_plan(LayerKinds kinds, const Scene& scene, const Available& available, const PlanOptions& options) {
    if (const std::size_t count = options.precision.layers.size(); count != 0 && count != scene.layers.size())
        throw Error(fmt::format("{} precisions for {} layers", count, scene.layers.size()));
    Emitter emitter{kinds, scene, available, options, {}, {}};
    emitter.plan.formats = checked_formats(available.formats, "the formats of a frame", /*apart=*/false);
    emitter.plan.output_formats = checked_formats(options.output_formats, "the formats of outputs", /*apart=*/true);
    require_planes(emitter.plan.formats, available.planes, "the formats of a frame");
    const std::vector<Section> sections = emit_sections(emitter);
    std::string bins;
    std::optional<PlannedKernel> tiles;
    if (has_light_table(emitter)) emitter.plan.light_order = light_order(*scene.lighting.table);
    if (emitter.plan.projectors > 0 || emitter.plan.light_order) tiles = emit_bins(emitter, bins);
    Plan plan = std::move(emitter.plan);
    plan.tiles = std::move(tiles);
    // The write-combining buffers of a core can hold this many streams, so even half cache lines may bypass the cache.
    constexpr std::size_t kFewOutputs = 3;
    std::size_t outputs = 0;
    for (const Section& section : sections) outputs += section.outputs.size();
    plan.source = std::string(outputs <= kFewOutputs ? "#define WR_FEW_OUTPUTS\n" : "") +
                  (lights_extend(emitter) ? "#define WR_AREA_LIGHTS\n" : "") +
                  ("#include \"wrinkle.clh\"\n\n" +
                   (options.compiled_numbers ? numbers_text(plan, {scene, available.cryptomatte}) : std::string()) +
                   user_text(emitter) + emitter.helpers + bins);

    // Blocks may overlap, so a pixel may be computed twice. Split kernels add to planes in memory and would add to such
    // a pixel twice; and the code that loads neighbours expects a work-item's pixels one after another, not as a block.
    // The same holds where values are added up over pixels of the picture.
    plan.blocks = plan.tiles && !plan.neighbours && !options.split && plan.sums_over == 1;

    add_kernels(plan, sections, options, plan.sums_over);
    std::ranges::sort(plan.inputs);
    plan.inputs.erase(std::unique(plan.inputs.begin(), plan.inputs.end()), plan.inputs.end());
    require_planes(plan.output_formats, {plan.outputs.begin(), plan.outputs.end()}, "the formats of outputs");
    plan.input_memories = memories_of(plan.inputs, plan.formats);
    plan.output_memories = memories_of(plan.outputs, plan.output_formats);
    for (const std::string& memory : plan.input_memories) plan.bytes += pixel_bytes(memory, plan.formats);
    for (const std::string& memory : plan.output_memories) plan.bytes += pixel_bytes(memory, plan.output_formats);
    for (const PlannedKernel& kernel : plan.kernels)
        plan.bytes += 1.5 * sizeof(float) * static_cast<double>(kernel.scratch.size());
    return plan;
}

CameraKind camera_kind(const Camera& camera, Size size) {
    if (pinhole_rays(camera, size)) return CameraKind::pinhole;
    const auto& w = camera.proj[3];
    return w[0] == 0 && w[1] == 0 && w[2] == 0 ? CameraKind::parallel : CameraKind::general;
}

}  // namespace wrinkle
