#include <fmt/format.h>

#include "device/guarded.h"
#include "layers/kinds.h"
#include "plan/stored_planes.h"
#include "run/array_run.h"
#include "run/pass_impl.h"
#include "run/shared_memory.h"
#include "wrinkle/error.h"
#include "wrinkle/passes.h"

namespace wrinkle {

namespace {

/// Planes as bytes, by whoever holds numbers.
template <class Byte, class T>
std::map<std::string, std::span<Byte>> as_memory(const std::map<std::string, std::span<T>>& planes) {
    std::map<std::string, std::span<Byte>> out;
    for (const auto& [name, plane] : planes)
        out.emplace(name, std::span<Byte>(reinterpret_cast<Byte*>(plane.data()), plane.size_bytes()));
    return out;
}

template <class Span, class BytesOf>
void check(const std::map<std::string, Span>& planes, const std::vector<std::string>& names, std::size_t pixels,
           const char* what, const BytesOf& bytes_of) {
    for (const std::string& name : names) {
        const auto found = planes.find(name);
        if (found == planes.end()) throw Error(fmt::format("no {} plane \"{}\"", what, name));
        const std::size_t bytes = bytes_of(name);
        if (found->second.size() < pixels * bytes)
            throw Error(fmt::format("{} plane \"{}\" holds {} numbers; the frame has {} pixels", what, name,
                                    found->second.size() / bytes, pixels));
    }
}

void run_bytes(Pass::Impl& impl, const HostBytes& in, const HostByteOutputs& out, const ToldShare& progress) {
    const std::size_t pixels = std::size_t{impl.size.width} * impl.size.height;
    const std::vector<std::string>&read_from = impl.plan.input_memories, &written_to = impl.plan.output_memories;
    check(in, read_from, pixels, "input",
          [&](const std::string& name) { return std::size_t{pixel_bytes(name, impl.plan.formats)}; });
    check(out, written_to, pixels, "output", [&](const std::string& name) { return impl.output_bytes(name); });
    refuse_shared_memory(in, read_from, out, written_to);
    run_arrays(impl, in, out, progress);
    impl.save();
}

/// For callers that hold numbers: a plane in another format cannot be given so.
template <class T>
void run_numbers(Pass::Impl& impl, const HostPlanes& in, const std::map<std::string, std::span<T>>& out,
                 const ToldShare& progress) {
    if (sizeof(T) != impl.bytes_per_output())
        throw Error("outputs are double if and only if the pass is built with fp64");
    for (const PlaneFormats* formats : {&impl.plan.formats, &impl.plan.output_formats})
        for (const auto& [plane, format] : *formats)
            throw Error(fmt::format("the plane \"{}\" is {} in the memory \"{}\"; give the pass planes as bytes", plane,
                                    encoding_name(format.encoding), format.memory));
    run_bytes(impl, as_memory<const std::byte>(in), as_memory<std::byte>(out), progress);
}

Pass make_pass(const char* what, const Device& device, const Scene& scene, const Frame& frame,
               const PassOptions& options, const PlanOptions& plan_options, TextureStore* store = nullptr) {
    return guarded(
        what, [&] { return Pass(std::make_unique<Pass::Impl>(device, scene, frame, options, plan_options, store)); });
}

}  // namespace

Pass::Pass(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Pass::Pass(Pass&&) noexcept = default;
Pass& Pass::operator=(Pass&&) noexcept = default;
Pass::~Pass() = default;

const std::vector<std::string>& Pass::inputs() const { return impl_->plan.input_memories; }
const std::vector<std::string>& Pass::outputs() const { return impl_->plan.output_memories; }
double Pass::bytes_per_pixel() const { return impl_->plan.bytes; }
bool Pass::needs_neighbours() const { return impl_->plan.neighbours; }

void Pass::set_camera(const Camera& camera) {
    guarded("set the camera", [&] { impl_->set_camera(camera); });
}

void Pass::set_parameters(const Scene& scene) {
    guarded("set the parameters of a pass", [&] { impl_->set_parameters(scene); });
}

void run(Pass& pass, const HostPlanes& in, const HostOutputs& out, const ToldShare& progress) {
    guarded("run a pass", [&] { run_numbers<float>(pass.impl(), in, out, progress); });
}

void run(Pass& pass, const HostPlanes& in, const HostDoubles& out, const ToldShare& progress) {
    guarded("run a pass", [&] { run_numbers<double>(pass.impl(), in, out, progress); });
}

void run(Pass& pass, const HostBytes& in, const HostByteOutputs& out, const ToldShare& progress) {
    guarded("run a pass", [&] { run_bytes(pass.impl(), in, out, progress); });
}

void Pass::run(const HostPlanes& in, const HostOutputs& out) { wrinkle::run(*this, in, out, {}); }
void Pass::run(const HostPlanes& in, const HostDoubles& out) { wrinkle::run(*this, in, out, {}); }
void Pass::run(const HostBytes& in, const HostByteOutputs& out) { wrinkle::run(*this, in, out, {}); }

cl::Event Pass::enqueue(const DevicePlanes& in, const DevicePlanes& out, const std::vector<cl::Event>& wait) {
    return enqueue(in, out, {.first = 0, .count = impl_->size.height}, wait);
}

cl::Event Pass::enqueue(const DevicePlanes& in, const DevicePlanes& out, const Rows& rows,
                        const std::vector<cl::Event>& wait) {
    return guarded("enqueue a pass", [&] {
        const std::uint64_t end = std::uint64_t{rows.first} + rows.count, height = impl_->size.height;
        if (end > height || rows.count == 0)
            throw Error(fmt::format("rows {} to {} are not within the frame's {}", rows.first, end, height));
        if (impl_->plan.neighbours && ((rows.first > 0 && rows.before == 0) || (end < height && rows.after == 0)))
            throw Error(fmt::format("rows {} to {} need a row before and after them, as the pass reads neighbours",
                                    rows.first, end));
        refuse_shared_memory(in, impl_->plan.input_memories, out, impl_->plan.output_memories);
        impl_->save_if_complete();
        const cl::Event done = impl_->enqueue(in, out, rows, wait);
        if (impl_->first_run() == nullptr) impl_->first_run = done;
        return done;
    });
}

Pass evaluate(const Device& device, const Scene& scene, const Frame& frame, const PassOptions& options) {
    return evaluate(device, scene, frame, options, nullptr);
}

Pass evaluate(const Device& device, const Scene& scene, const Frame& frame, const PassOptions& options,
              TextureStore* store) {
    return make_pass("evaluate", device, scene, frame, options,
                     {.split = options.split, .precision = options.precision, .output_formats = options.output_formats},
                     store);
}

Pass accumulate_decals(const Device& device, std::span<const Layer> decals, const Frame& frame,
                       const PassOptions& options) {
    Scene scene;
    scene.layers.assign(decals.begin(), decals.end());
    Frame without_normals = frame;
    for (const char* const plane : {"normal.x", "normal.y", "normal.z"}) {
        without_normals.planes.erase(plane);
        without_normals.formats.erase(plane);
    }
    return accumulate_decals(device, scene, without_normals, options, nullptr);
}

Pass accumulate_decals(const Device& device, const Scene& scene, const Frame& frame, const PassOptions& options,
                       TextureStore* store) {
    return guarded("accumulate decals", [&] {
        for (const Layer& layer : scene.layers)
            if (!kind_of(layer_kinds(), layer).without_normal)
                throw Error(fmt::format("layer \"{}\" is no decal", layer.name));
        const bool normal = frame.planes.contains("normal.x");
        return make_pass("accumulate decals", device, scene, frame, options,
                         {.split = options.split,
                          .normal = normal,
                          .write_normal = false,
                          .volume_gradient = true,
                          .view_footprint = !normal,
                          .precision = options.precision,
                          .output_formats = options.output_formats},
                         store);
    });
}

Pass screen_derivatives(const Device& device, const Frame& frame, const PassOptions& options) {
    Scene scene;
    scene.output.dp_dx = scene.output.dp_dy = true;
    return make_pass("screen derivatives", device, scene, frame, options,
                     {.split = options.split,
                      .write_normal = false,
                      .precision = options.precision,
                      .output_formats = options.output_formats});
}

}  // namespace wrinkle
