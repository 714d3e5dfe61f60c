#include "plan/emit_kernel.h"

#include <fmt/format.h>

#include "plan/stored_planes.h"

namespace wrinkle {

namespace {

/// Scratch planes of a value, or of its means.
std::vector<std::string> scratch_planes(const Value& value, bool means) {
    std::vector<std::string> planes;
    for (std::size_t i = 0; i < value.parts.size(); ++i)
        planes.push_back(fmt::format("{}{}_{}", means ? "mean_" : "", value.name, i));
    return planes;
}

std::string declare(const Value& value) {
    const std::string type = value.type;
    const std::string zero = type == "wr_vec3"       ? "wr_zero3()"
                             : type == "wr_texcoord" ? "{{0, 0}, {0, 0}, {0, 0}}"
                             : type == "wr_tangents" ? "{wr_zero3(), wr_zero3()}"
                                                     : "0";
    return fmt::format("    {} {} = {};\n", type, value.name, zero);
}

/// The head of a kernel, up to the pixels that a work-item evaluates.
void begin_kernel(Plan& plan, const PlannedKernel& kernel, bool compiled_numbers) {
    std::string& text = plan.source;
    text += fmt::format(
        "wr_kernel void {}(constant const wr_camera *camera, constant const WR_SCALAR *{},\n"
        "    constant const WR_SCALAR *eye_places, global const float *restrict texels, global const uint *restrict "
        "textures,\n"
        "    global const wr_projector *restrict decals, constant const wr_lighting *lighting, constant const wr_light "
        "*lights,\n",
        kernel.name, compiled_numbers ? "numbers_in_memory" : "numbers");
    if (plan.projectors > 0)
        text +=
            "    global const wr_projector *restrict projectors, global const uint *restrict lists,\n"
            "    global const uint *restrict entries, uint supers,\n";
    if (plan.light_order)
        text +=
            "    global const wr_light *restrict light_rows, global const uint *restrict light_lists,\n"
            "    global const uint *restrict light_entries, uint light_supers,\n";
    text += input_arguments(kernel.inputs, plan.formats);
    for (const std::string& plane : kernel.scratch)
        text += fmt::format("    global WR_SCALAR *restrict scratch_{},\n", plane);
    text += output_arguments(kernel.outputs, plan.output_formats);
    text += "    uint in_first, uint in_pixels, uint first_row, uint width, uint items";
    if (plan.blocks) text += ", uint block_rows";
    text += ")\n{\n    if (get_global_id(0) >= items) return;  // the global size is padded\n";
    text +=
        plan.blocks
            ? "    wr_pixel_block at = wr_pixel_block_of(get_global_id(0), in_first, first_row, width, block_rows);\n"
            : "    wr_pixels at = wr_pixels_of(get_global_id(0), in_first, first_row, width);\n";
    text += input_declarations(kernel.inputs, plan.formats) + output_declarations(kernel.outputs, plan.output_formats);
}

}  // namespace

PlannedKernel emit_kernel(Plan& plan, const std::string& name, const std::vector<const Section*>& sections,
                          const Handed& handed, bool compiled_numbers) {
    std::set<std::string> inputs, used;
    std::vector<std::string> outputs;
    for (const Section* section : sections) {
        inputs.insert(section->inputs.begin(), section->inputs.end());
        outputs.insert(outputs.end(), section->outputs.begin(), section->outputs.end());
        for (const auto& names : {section->reads, section->writes}) used.insert(names.begin(), names.end());
    }
    PlannedKernel kernel{name, {inputs.begin(), inputs.end()}, {}, outputs, 0};
    std::string load, store;
    for (const Value& value : values()) {
        const bool loaded = handed.loaded.contains(value.name), stored = handed.stored.contains(value.name);
        if (!loaded && !stored) continue;
        const std::vector<std::string> planes = scratch_planes(value, handed.means.contains(value.name));
        kernel.scratch.insert(kernel.scratch.end(), planes.begin(), planes.end());
        const bool truth = std::string(value.type) == "wr_mask";
        for (std::size_t i = 0; i < planes.size(); ++i) {
            const std::string part = fmt::format("{}{}", value.name, value.parts[i]);
            const std::string from = fmt::format("wr_load_real(scratch_{}, at.out)", planes[i]);
            if (loaded) load += fmt::format("    {} = {};\n", part, truth ? from + " != 0" : from);
            if (stored)
                store += fmt::format("    wr_store({}, scratch_{}, at.out);\n",
                                     truth ? part + " ? (wr_real)(1) : (wr_real)(0)" : part, planes[i]);
        }
    }
    begin_kernel(plan, kernel, compiled_numbers);
    std::string& text = plan.source;
    for (const Value& value : values())
        if (used.contains(value.name)) text += declare(value);
    text += load;
    for (const Section* section : sections) {
        kernel.operations += section->operations;
        text += fmt::format("\n    // stage {}: {}\n    {{\n{}    }}\n", section->stage,
                            *section->kind ? section->kind : section->title, section->body);
        std::vector<SectionSummary> told = section->parts;
        if (told.empty())
            told = {{0, section->title, {section->inputs.begin(), section->inputs.end()}, section->operations}};
        for (SectionSummary& part : told) {
            part.stage = section->stage;
            plan.sections.push_back(std::move(part));
        }
    }
    text += store + "}\n\n";
    plan.outputs.insert(plan.outputs.end(), kernel.outputs.begin(), kernel.outputs.end());
    plan.inputs.insert(plan.inputs.end(), kernel.inputs.begin(), kernel.inputs.end());
    kernel.inputs = memories_of(kernel.inputs, plan.formats);
    kernel.outputs = memories_of(kernel.outputs, plan.output_formats);
    return kernel;
}

PlannedKernel emit_means(Plan& plan, const std::set<std::string>& of, std::uint32_t size, bool compiled_numbers) {
    PlannedKernel kernel{"wr_means", {}, {}, {}, 0};
    std::string body;
    for (const Value& value : values()) {
        if (!of.contains(value.name)) continue;
        const std::vector<std::string> from = scratch_planes(value, false), to = scratch_planes(value, true);
        kernel.scratch.insert(kernel.scratch.end(), from.begin(), from.end());
        kernel.scratch.insert(kernel.scratch.end(), to.begin(), to.end());
        for (std::size_t i = 0; i < from.size(); ++i)
            body += fmt::format("    wr_block_means(scratch_{}, scratch_{}, at.out, width, rows, {});\n", from[i],
                                to[i], size);
        kernel.operations += static_cast<double>(value.parts.size()) * size * size;
    }
    begin_kernel(plan, kernel, compiled_numbers);
    plan.source += "    uint rows = (uint)camera->height - first_row;\n" + body + "}\n\n";
    return kernel;
}

}  // namespace wrinkle
