#include "run/pass_impl.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <set>
#include <tuple>

#include "base/limits.h"
#include "device/work_group.h"
#include "layers/kinds.h"
#include "plan/decal_order.h"
#include "plan/stored_planes.h"
#include "resources/bin_bounds.h"
#include "resources/frame_constants.h"
#include "scene/check_scene.h"
#include "wrinkle/error.h"

namespace wrinkle {

namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

/// Work-items a group; a kernel always has the same, since PoCL compiles every local size anew. 64 are enough for a
/// GPU's warps. PoCL keeps the values that called functions return for every item of a group: for the demo scene (4600
/// operations) 1.5 KB an item, which the first cache holds for 8 and not for 64. Short kernels call little.
std::size_t group_size(const PlannedKernel& kernel, int lanes) {
    constexpr double kLong = 1000;
    return lanes > 1 && kernel.operations > kLong ? 8 : 64;
}

/// How many groups of `size` hold `count`.
std::size_t groups_of(std::size_t count, std::size_t size) { return (count + size - 1) / size; }

/// A read-only buffer holding `count` numbers, narrowed to float unless the program computes in double.
cl::Buffer reals(const Device& device, const double* values, std::size_t count, bool fp64) {
    const std::size_t size = std::max<std::size_t>(count, 1);
    std::vector<float> narrow(size);
    std::vector<double> wide(size);
    for (std::size_t i = 0; i < count; ++i) narrow[i] = static_cast<float>(wide[i] = values[i]);
    void* data = fp64 ? static_cast<void*>(wide.data()) : narrow.data();
    return {device.context, CL_MEM_READ_ONLY | CL_MEM_COPY_HOST_PTR, size * (fp64 ? sizeof(double) : sizeof(float)),
            data};
}

template <class Struct>
cl::Buffer structs(const Device& device, const std::vector<Struct>& values, bool fp64) {
    constexpr std::size_t members = sizeof(Struct) / sizeof(double);
    const std::vector<Struct> at_least_one(1);
    const auto& list = values.empty() ? at_least_one : values;
    return reals(device, reinterpret_cast<const double*>(list.data()), list.size() * members, fp64);
}

const cl::Buffer& plane(const DevicePlanes& planes, const std::string& name, std::size_t bytes) {
    const auto found = planes.find(name);
    if (found == planes.end()) throw Error(fmt::format("no buffer for the plane \"{}\"", name));
    if (const auto size = found->second.getInfo<CL_MEM_SIZE>(); size < bytes)
        throw Error(fmt::format("the buffer of the plane \"{}\" holds {} bytes; {} are needed", name, size, bytes));
    return found->second;
}

const Scene& checked(const Scene& scene) {
    check(scene);
    return scene;
}

/// Streaming stores need whole vectors: memory that the caller lent must be aligned to one.
void check_alignment(const cl::Buffer& buffer, const std::string& name, std::size_t alignment) {
    if ((buffer.getInfo<CL_MEM_FLAGS>() & CL_MEM_USE_HOST_PTR) == 0) return;
    if (reinterpret_cast<std::uintptr_t>(buffer.getInfo<CL_MEM_HOST_PTR>()) % alignment != 0)
        throw Error(fmt::format("the buffer of the plane \"{}\" uses host memory that is not aligned to {} bytes", name,
                                alignment));
}

}  // namespace

Pass::Impl::Impl(const Device& on, const Scene& of, const Frame& shape, const PassOptions& wanted,
                 const PlanOptions& plan_options, TextureStore* store)
    : device(on),
      scene(checked(of)),
      cryptomatte(shape.cryptomatte),
      camera(shape.camera),
      size(shape.size),
      kind(camera_kind(shape.camera, shape.size)),
      device_depth(shape.device_depth),
      plan(plan_for(of, shape, plan_options)),
      options(wanted) {
    if (options.lanes == 0) options.lanes = options.fp64 ? std::min(device.info.lanes, 8) : device.info.lanes;
    if (options.fp64 && !device.info.fp64)
        throw Error(fmt::format("{} has no double precision (cl_khr_fp64)", device.info.name));
    if (options.fp64 && !plan.output_formats.empty())
        throw Error("outputs of a pass in double are doubles; give it no output_formats");
    const auto textures_start = Clock::now();
    textures = store ? store->get(plan.textures) : TextureStore(device).get(plan.textures);
    texture_seconds = seconds_since(textures_start);

    const auto build_start = Clock::now();
    built = build_program(device, plan.source, {options.lanes, options.fp64});
    for (const PlannedKernel& planned : plan.kernels) {
        kernels.emplace_back(built.program, planned.name.c_str());
        for (const std::string& name : planned.scratch)
            if (std::ranges::find(scratch_names, name) == scratch_names.end()) scratch_names.push_back(name);
    }
    build_seconds = seconds_since(build_start);
    upload_constants();
    const std::size_t pixels = padded(std::size_t{size.width} * size.height);
    check_memory(of.file.empty() ? "the pass" : of.file.string(),
                 static_cast<double>(pixels * bytes_per_output() * scratch_names.size()),
                 fmt::format("what its {} kernels hand on of {} x {} pixels", kernels.size(), size.width, size.height));
    for (std::size_t i = 0; i < scratch_names.size(); ++i)
        scratch.emplace_back(device.context, CL_MEM_READ_WRITE, pixels * bytes_per_output());
}

void Pass::Impl::set_camera(const Camera& other) {
    if (camera_kind(other, size) != kind)
        throw Error("the new camera is of another kind (pinhole, parallel, general) than the one the pass is made for");
    check_device_depth(device_depth, other, size);
    change([&] { camera = other; });
}

void Pass::Impl::set_parameters(const Scene& other) {
    const LayerKinds kinds = layer_kinds();
    Scene alike = other;
    const bool filtered = std::ranges::find(plan.outputs, "normal.x") != plan.outputs.end();
    if (!filtered) alike.filter = scene.filter;  // sums of decals have no pixels' areas
    scene::require_same_structure(scene::structure_of(kinds, scene), scene::check_scene(kinds, alike));
    change([&] {
        scene = other;
        for (PlannedDecals& table : plan.tables) table.take_rows(table, {scene, cryptomatte});
        if (plan.light_order) plan.light_order = light_order(*scene.lighting.table);
    });
}

void Pass::Impl::change(const std::function<void()>& what) {
    const auto state = [this] {
        return std::tie(camera, scene, plan.tables, plan.projectors, plan.light_order, bins, light_bins, frame, numbers,
                        eye_places, decals, light_setup, lights);
    };
    auto before = std::make_tuple(camera, scene, plan.tables, plan.projectors, plan.light_order, bins, light_bins,
                                  frame, numbers, eye_places, decals, light_setup, lights);
    try {
        what();
        upload_constants();
    } catch (...) {
        state() = std::move(before);
        throw;
    }
}

void Pass::Impl::upload_constants() {
    const FrameConstants constants = frame_constants(plan, {scene, cryptomatte}, camera, size);
    const bool wide = options.fp64;
    frame = structs(device, std::vector{constants.frame}, wide);
    numbers = reals(device, constants.numbers.data(), constants.numbers.size(), wide);
    eye_places = reals(device, constants.eye_places.data(), constants.eye_places.size(), wide);
    decals = structs(device, constants.decals, wide);
    light_setup = structs(device, std::vector{constants.lighting}, wide);
    lights = structs(device, constants.lights, wide);
    plan.projectors = constants.projectors.size();
    make_bins();
    if (plan.projectors > 0)
        bins.set_camera(bin_bounds(constants.projectors, camera), structs(device, constants.projectors, wide), wide);
    if (plan.light_order)
        light_bins.set_camera(bin_bounds(constants.light_table, camera), structs(device, constants.light_table, wide),
                              wide);
}

void Pass::Impl::make_bins() {
    if (bins.rows() != plan.projectors) bins = TileBins(device, built.program, plan.projectors, options.lanes);
    const std::size_t rows = plan.light_order ? plan.light_order->size() : 0;
    if (light_bins.rows() != rows) light_bins = TileBins(device, built.program, rows, options.lanes);
}

std::vector<TileBins*> Pass::Impl::tile_bins() {
    std::vector<TileBins*> some;
    if (plan.projectors > 0) some.push_back(&bins);
    if (plan.light_order) some.push_back(&light_bins);
    return some;
}

cl::Event Pass::Impl::enqueue(const DevicePlanes& in, const DevicePlanes& out, const Rows& rows,
                              const std::vector<cl::Event>& wait, std::span<const Items> some) {
    if (some.empty() && (rows.first % plan.sums_over != 0 || rows.count % plan.sums_over != 0))
        throw Error(fmt::format("rows {} to {} of the frame are no whole rows of its picture, which has one for {}",
                                rows.first, rows.first + rows.count, plan.sums_over));
    const std::size_t pixels = std::size_t{rows.count} * size.width;
    const auto lanes = static_cast<std::size_t>(options.lanes);
    const std::size_t block_rows = lanes / WR_BLOCK_WIDTH;
    const bool blocks =
        plan.blocks && some.empty() && block_rows > 1 && size.width >= WR_BLOCK_WIDTH && rows.count >= block_rows;
    const std::size_t items =
        blocks ? groups_of(size.width, WR_BLOCK_WIDTH) * groups_of(rows.count, block_rows) : groups_of(pixels, lanes);
    const std::size_t touched = groups_of(pixels, lanes) * lanes;  // whole lane groups
    const std::size_t before = std::size_t{rows.before} * size.width;
    const std::size_t in_pixels = before + pixels + std::size_t{rows.after} * size.width;
    if (in_pixels > std::numeric_limits<cl_uint>::max()) throw Error("a band holds more than 2^32 pixels");
    const auto input = [&](const std::string& name) -> const cl::Buffer& {
        return plane(in, name, std::max(in_pixels, before + touched) * pixel_bytes(name, plan.formats));
    };
    std::vector<cl::Event> after = wait;
    after.insert(after.end(), scratch_use.begin(), scratch_use.end());
    if (plan.tiles) {
        std::vector<cl::Buffer> planes;
        for (const std::string& name : plan.tiles->inputs) planes.push_back(input(name));
        std::vector<cl::Event> binned;
        for (TileBins* each : tile_bins())
            binned.push_back(each->enqueue(frame, numbers, planes, rows, size.width, static_cast<cl_uint>(before),
                                           static_cast<cl_uint>(in_pixels), after));
        after = std::move(binned);
    }
    for (std::size_t k = 0; k < kernels.size(); ++k) {
        cl::Kernel& kernel = kernels[k];
        cl_uint i = 0;
        for (const cl::Buffer* buffer : std::initializer_list<const cl::Buffer*>{
                 &frame, &numbers, &eye_places, &textures->texels, &textures->table, &decals, &light_setup, &lights})
            kernel.setArg(i++, *buffer);
        for (const TileBins* each : tile_bins()) each->set_arguments(kernel, i);
        for (const std::string& name : plan.kernels[k].inputs) kernel.setArg(i++, input(name));
        for (const std::string& name : plan.kernels[k].scratch)
            kernel.setArg(
                i++, scratch[static_cast<std::size_t>(std::ranges::find(scratch_names, name) - scratch_names.begin())]);
        for (const std::string& name : plan.kernels[k].outputs) {
            const std::size_t bytes = output_bytes(name);
            const cl::Buffer& buffer = plane(out, name, touched * bytes);
            check_alignment(buffer, name,
                            options.fp64 ? lanes * bytes : store_alignment(name, plan.output_formats, options.lanes));
            kernel.setArg(i++, buffer);
        }
        kernel.setArg(i++, static_cast<cl_uint>(before));
        kernel.setArg(i++, static_cast<cl_uint>(in_pixels));
        kernel.setArg(i++, static_cast<cl_uint>(rows.first));
        kernel.setArg(i++, static_cast<cl_uint>(size.width));
        kernel.setArg(i++, static_cast<cl_uint>(items));
        if (plan.blocks) kernel.setArg(i++, blocks ? static_cast<cl_uint>(rows.count) : cl_uint{0});
        std::vector<cl::Event> done(std::max<std::size_t>(some.size(), 1));
        const std::size_t group = work_group(device, kernel, group_size(plan.kernels[k], options.lanes));
        if (some.empty())
            device.queue.enqueueNDRangeKernel(kernel, cl::NullRange, cl::NDRange(groups_of(items, group) * group),
                                              cl::NDRange(group), &after, done.data());
        for (std::size_t run = 0; run < some.size(); ++run)
            device.queue.enqueueNDRangeKernel(kernel, cl::NDRange(some[run].first), cl::NDRange(some[run].count),
                                              cl::NDRange(1), &after, &done[run]);
        after.resize(1);
        if (done.size() == 1)
            after.front() = done.front();
        else
            device.queue.enqueueMarkerWithWaitList(&done, &after.front());
    }
    for (TileBins* each : tile_bins()) each->used_until(after.front());
    if (!scratch.empty()) scratch_use = {after.front()};
    return after.front();
}

std::size_t Pass::Impl::output_bytes(const std::string& memory) const {
    return options.fp64 ? sizeof(double) : pixel_bytes(memory, plan.output_formats);
}

Pass::Impl::~Impl() {
    try {
        save_if_complete();
    } catch (const std::exception&) {
        // the next start compiles again
    }
}

void Pass::Impl::save_if_complete() {
    if (saved || first_run() == nullptr) return;
    if (first_run.getInfo<CL_EVENT_COMMAND_EXECUTION_STATUS>() == CL_COMPLETE) save();
}

void Pass::Impl::save() {
    if (saved) return;
    saved = true;
    save_program(built);
}

}  // namespace wrinkle
