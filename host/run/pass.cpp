#include <fmt/format.h>

#include <algorithm>
#include <cstring>

#include "device/guarded.h"
#include "layers/kinds.h"
#include "run/pass_impl.h"
#include "run/plane_buffers.h"
#include "run/shared_memory.h"
#include "wrinkle/error.h"
#include "wrinkle/passes.h"

namespace wrinkle {

namespace {

/// Pixels of a band when a pass runs from host memory: bounds what is staged, large enough to keep every core busy.
constexpr std::size_t kBandPixels = std::size_t{1} << 20;

template <class Span>
void check(const std::map<std::string, Span>& planes, const std::vector<std::string>& names, std::size_t pixels,
           const char* what) {
    for (const std::string& name : names) {
        const auto found = planes.find(name);
        if (found == planes.end()) throw Error(fmt::format("no {} plane \"{}\"", what, name));
        if (found->second.size() < pixels)
            throw Error(fmt::format("{} plane \"{}\" holds {} numbers; the frame has {} pixels", what, name,
                                    found->second.size(), pixels));
    }
}

template <class T>
void run_bands(Pass::Impl& impl, const HostPlanes& in, const std::map<std::string, std::span<T>>& out,
               const ToldShare& progress) {
    const std::size_t width = impl.size.width, height = impl.size.height;
    check(in, impl.plan.inputs, width * height, "input");
    check(out, impl.plan.outputs, width * height, "output");
    if (sizeof(T) != impl.bytes_per_output())
        throw Error("outputs are double if and only if the pass is built with fp64");
    refuse_shared_memory(in, impl.plan.inputs, out, impl.plan.outputs);

    const std::size_t least = impl.plan.sums_over;
    const std::size_t rows = std::clamp<std::size_t>(kBandPixels / width / least * least, least, height);
    const std::size_t halo = impl.plan.neighbours ? 1 : 0;
    PlaneBuffers inputs(impl.device, impl.plan.inputs, width * (rows + 2 * halo), sizeof(float));
    PlaneBuffers outputs(impl.device, impl.plan.outputs, width * rows, sizeof(T));
    for (std::size_t first = 0; first < height; first += rows) {
        const std::size_t count = std::min(rows, height - first);
        const std::size_t before = std::min(halo, first), after = std::min(halo, height - first - count);
        for (const std::string& name : impl.plan.inputs)
            std::memcpy(inputs.map<float>(name, CL_MAP_WRITE), in.at(name).data() + (first - before) * width,
                        (before + count + after) * width * sizeof(float));
        inputs.unmap();
        impl.enqueue(inputs.planes(), outputs.planes(),
                     {static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(count),
                      static_cast<std::uint32_t>(before), static_cast<std::uint32_t>(after)},
                     both_ready(inputs, outputs))
            .wait();
        for (const std::string& name : impl.plan.outputs)
            std::memcpy(out.at(name).data() + first * width, outputs.map<T>(name, CL_MAP_READ),
                        count * width * sizeof(T));
        outputs.unmap();
        if (progress) progress(static_cast<double>(first + count) / static_cast<double>(height));
    }
    impl.save();
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

const std::vector<std::string>& Pass::inputs() const { return impl_->plan.inputs; }
const std::vector<std::string>& Pass::outputs() const { return impl_->plan.outputs; }
bool Pass::needs_neighbours() const { return impl_->plan.neighbours; }

void Pass::set_camera(const Camera& camera) {
    guarded("set the camera", [&] { impl_->set_camera(camera); });
}

void Pass::set_parameters(const Scene& scene) {
    guarded("set the parameters of a pass", [&] { impl_->set_parameters(scene); });
}

void run(Pass& pass, const HostPlanes& in, const HostOutputs& out, const ToldShare& progress) {
    guarded("run a pass", [&] { run_bands<float>(pass.impl(), in, out, progress); });
}

void run(Pass& pass, const HostPlanes& in, const HostDoubles& out, const ToldShare& progress) {
    guarded("run a pass", [&] { run_bands<double>(pass.impl(), in, out, progress); });
}

void Pass::run(const HostPlanes& in, const HostOutputs& out) { wrinkle::run(*this, in, out, {}); }
void Pass::run(const HostPlanes& in, const HostDoubles& out) { wrinkle::run(*this, in, out, {}); }

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
        refuse_shared_memory(in, impl_->plan.inputs, out, impl_->plan.outputs);
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
                     {.split = options.split, .precision = options.precision}, store);
}

Pass accumulate_decals(const Device& device, std::span<const Layer> decals, const Frame& frame,
                       const PassOptions& options) {
    Scene scene;
    scene.layers.assign(decals.begin(), decals.end());
    Frame without_normals = frame;
    for (const char* const plane : {"normal.x", "normal.y", "normal.z"}) without_normals.planes.erase(plane);
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
                          .precision = options.precision},
                         store);
    });
}

Pass screen_derivatives(const Device& device, const Frame& frame, const PassOptions& options) {
    Scene scene;
    scene.output.dp_dx = scene.output.dp_dy = true;
    return make_pass("screen derivatives", device, scene, frame, options,
                     {.split = options.split, .write_normal = false, .precision = options.precision});
}

}  // namespace wrinkle
