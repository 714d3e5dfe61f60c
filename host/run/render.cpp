#include "run/render.h"

#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <future>

#include "device/guarded.h"
#include "io/camera_file.h"
#include "io/frame_path.h"
#include "io/gbuffer_reader.h"
#include "plan/section.h"
#include "run/frame_outputs.h"
#include "run/pass_impl.h"
#include "run/phase_clock.h"
#include "run/plane_buffers.h"
#include "wrinkle/error.h"

namespace wrinkle {

namespace fs = std::filesystem;

namespace {

/// Rows of a band: whole ZIP blocks of EXR files, and enough pixels to keep every core busy. Three bands are in flight.
constexpr std::uint32_t kBlockRows = 16;
constexpr std::size_t kBandPixels = std::size_t{1} << 18;

std::uint32_t band_rows(Size size) {
    const std::size_t blocks = std::max<std::size_t>(kBandPixels / size.width / kBlockRows, 1);
    return static_cast<std::uint32_t>(std::min<std::size_t>(blocks * kBlockRows, size.height));
}

/// Hashes of every Cryptomatte name that a scene's masks use, and of those the file lists.
std::map<std::string, std::uint32_t> cryptomatte_hashes(const Scene& scene, const GBufferReader& reader) {
    std::map<std::string, std::uint32_t> hashes;
    for (const std::string& name : reader.cryptomatte().names()) hashes.emplace(name, reader.cryptomatte().id(name));
    for (const Layer& layer : scene.layers) {
        if (!layer.mask.cryptomatte || !reader.has_role("cryptomatte")) continue;
        try {
            hashes.emplace(*layer.mask.cryptomatte, reader.cryptomatte().id(*layer.mask.cryptomatte));
        } catch (const Error& error) { throw Error(fmt::format("{}: {}", layer_label(layer), error.what())); }
    }
    return hashes;
}

Frame frame_of(const Scene& scene, const GBufferReader& reader, const FrameCamera& camera) {
    if (reader.roles().screen_space_normals)
        throw Error(
            fmt::format("{}: its normals ({}) are in camera space; render world-space normals and name them in "
                        "[gbuffer] roles",
                        reader.path().string(), reader.roles().channel_of.at("normal.x")));
    Frame frame{.size = reader.size(), .camera = camera.camera, .planes = {}, .ray_depth = false, .cryptomatte = {}};
    for (const std::string& plane : reader.planes()) frame.planes.insert(plane);
    for (const std::string& channel : reader.channels()) frame.planes.insert("channel:" + channel);
    frame.ray_depth = camera.depth.value_or(reader.roles().depth) == DepthKind::ray;
    if (scene.gbuffer.depth != DepthKind::automatic) frame.ray_depth = scene.gbuffer.depth == DepthKind::ray;
    frame.cryptomatte = cryptomatte_hashes(scene, reader);
    return frame;
}

/// Planes of a band in memory that both sides reach, and where they lie.
struct Slot {
    PlaneBuffers inputs, outputs;
    Rows rows;
};

/// One frame in bands, three in flight: while one is evaluated the next is read and the last is written.
class FrameRun {
public:
    FrameRun(Pass::Impl& pass, const GBufferReader& reader, FrameOutputs& outputs, PhaseClock& clock, int repeat)
        : pass_(pass), reader_(reader), outputs_(outputs), clock_(clock), repeat_(std::max(repeat, 1)) {
        names_ = pass.plan.inputs;
        for (const std::string& plane : outputs.passed_planes())
            if (std::ranges::find(names_, plane) == names_.end()) names_.push_back(plane);
    }

    /// Returns the seconds kernels took.
    double run(const std::function<void(double)>& progress) {
        const Size size = pass_.size;
        const std::uint32_t rows = band_rows(size), halo = pass_.plan.neighbours ? 1 : 0;
        std::array<Slot, 3> slots;
        for (Slot& slot : slots) {
            slot.inputs =
                PlaneBuffers(pass_.device, names_, std::size_t{size.width} * (rows + 2 * halo), sizeof(float));
            slot.outputs =
                PlaneBuffers(pass_.device, pass_.plan.outputs, std::size_t{size.width} * rows, sizeof(float));
        }
        std::future<void> reading, writing;
        const auto start_reading = [&](std::uint32_t first, Slot& slot) {
            slot.rows.first = first;
            slot.rows.count = std::min(rows, size.height - first);
            slot.rows.before = std::min(halo, first);
            slot.rows.after = std::min(halo, size.height - first - slot.rows.count);
            reading = std::async(std::launch::async, [&, this] { read(slot); });
        };
        start_reading(0, slots[0]);
        for (std::uint32_t first = 0, band = 0; first < size.height; first += rows, ++band) {
            Slot& slot = slots[band % 3];
            reading.get();
            slot.inputs.unmap();
            if (first + rows < size.height) start_reading(first + rows, slots[(band + 1) % 3]);
            evaluate(slot);
            if (writing.valid()) writing.get();  // the slot before this one is free again
            writing = std::async(std::launch::async, [&, this] { write(slot); });
            if (progress) progress(std::min(1.0, static_cast<double>(first + rows) / size.height));
        }
        writing.get();
        return kernel_seconds_;
    }

private:
    void read(Slot& slot) {
        clock_.measure(PhaseClock::read, [&] {
            std::vector<float*> planes;
            for (const std::string& name : names_) planes.push_back(slot.inputs.map<float>(name, CL_MAP_WRITE));
            reader_.read_rows(slot.rows.first - slot.rows.before, slot.rows.first + slot.rows.count + slot.rows.after,
                              names_, planes);
        });
    }

    void evaluate(Slot& slot) {
        if (!pass_.warm) {  // drivers finish compiling at the first call: one row, counted as building
            clock_.measure(PhaseClock::build, [&] {
                Rows row = slot.rows;
                row.after += row.count - 1;
                row.count = 1;
                pass_.enqueue(slot.inputs.planes(), slot.outputs.planes(), row, {}).wait();
            });
            pass_.warm = true;
        }
        clock_.measure(PhaseClock::kernels, [&] {
            std::vector<double> times;
            for (int i = 0; i < repeat_; ++i) {
                const auto start = PhaseClock::Clock::now();
                pass_.enqueue(slot.inputs.planes(), slot.outputs.planes(), slot.rows, {}).wait();
                times.push_back(std::chrono::duration<double>(PhaseClock::Clock::now() - start).count());
            }
            std::ranges::nth_element(times, times.begin() + static_cast<std::ptrdiff_t>(times.size() / 2));
            kernel_seconds_ += times[times.size() / 2];
        });
    }

    void write(Slot& slot) {
        clock_.measure(PhaseClock::write, [&] {
            const std::size_t before = std::size_t{slot.rows.before} * pass_.size.width;
            std::map<std::string, const float*> planes;
            for (const std::string& name : names_) planes[name] = slot.inputs.map<float>(name, CL_MAP_READ) + before;
            for (const std::string& name : pass_.plan.outputs)
                planes["out:" + name] = slot.outputs.map<float>(name, CL_MAP_READ);
            outputs_.write(slot.rows.first, slot.rows.first + slot.rows.count, planes);
            slot.inputs.unmap();
            slot.outputs.unmap();
        });
    }

    Pass::Impl& pass_;
    const GBufferReader& reader_;
    FrameOutputs& outputs_;
    PhaseClock& clock_;
    int repeat_;
    std::vector<std::string> names_;
    double kernel_seconds_ = 0;
};

GBufferReader open_frame(const Scene& scene, int frame) {
    return GBufferReader(frame_path(scene.gbuffer.file, frame), scene.gbuffer);
}

}  // namespace

Frame describe_frame(const Scene& scene, int frame) {
    const GBufferReader reader = open_frame(scene, frame);
    return frame_of(scene, reader, read_frame_camera(scene.camera, reader, frame));
}

namespace {

RenderReport render_frames(const Scene& scene, const RenderOptions& options) {
    RenderReport report;
    PhaseClock clock;
    const std::vector<int> frames = options.frames.empty() ? std::vector<int>{0} : options.frames;
    const Device device = clock.measure(PhaseClock::build, [&] { return Device::open(options.device); });
    std::optional<Pass> pass;
    Frame built_for;
    for (std::size_t f = 0; f < frames.size(); ++f) {
        GBufferReader reader = clock.measure(PhaseClock::read, [&] { return open_frame(scene, frames[f]); });
        const FrameCamera camera = clock.measure(PhaseClock::read, [&] {
            FrameCamera found = read_frame_camera(scene.camera, reader, frames[f]);
            check_residual(found, scene.camera.max_residual, reader);
            return found;
        });
        report.cameras.push_back(camera.residual ? fmt::format("{}; positions reproject within {:.3g} pixel (median)",
                                                               camera.origin, camera.residual->median)
                                                 : fmt::format("{}; no positions to check it against", camera.origin));
        Frame frame = frame_of(scene, reader, camera);
        const bool same = pass && frame.size == built_for.size && frame.planes == built_for.planes &&
                          frame.ray_depth == built_for.ray_depth && frame.cryptomatte == built_for.cryptomatte &&
                          camera_kind(frame.camera, frame.size) == camera_kind(built_for.camera, built_for.size);
        if (same) {
            pass->set_camera(frame.camera);
        } else {
            pass.emplace(clock.measure(PhaseClock::build, [&] { return evaluate(device, scene, frame); }));
            report.upload += pass->impl().texture_seconds;
            report.cache_hit = pass->impl().built.source == BuildSource::disk;
            built_for = frame;
        }
        std::optional<int> number;
        if (!options.frames.empty()) number = frames[f];
        FrameOutputs outputs(scene, pass->impl(), reader, options.directory, number);
        FrameRun run(pass->impl(), reader, outputs, clock, options.repeat);
        report.kernels += run.run([&](double share) {
            if (options.progress)
                options.progress((static_cast<double>(f) + share) / static_cast<double>(frames.size()));
        });
        clock.measure(PhaseClock::write, [&] { outputs.finish(report.files); });
        clock.measure(PhaseClock::build, [&] { pass->impl().save(); });
        report.pixels += std::uint64_t{frame.size.width} * frame.size.height;
        ++report.frames;
    }
    report.device = device.info;
    for (const Layer& layer : scene.layers) report.layers += std::holds_alternative<ResolveLayer>(layer.bump) ? 0 : 1;
    report.read = clock.seconds(PhaseClock::read);
    report.build = clock.seconds(PhaseClock::build) - report.upload;
    report.write = clock.seconds(PhaseClock::write);
    report.kernel_ns_per_pixel = report.kernels / static_cast<double>(report.pixels) * 1e9;
    report.outside = clock.outside({PhaseClock::read, PhaseClock::kernels, PhaseClock::write});
    report.wall = clock.wall();
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    report.peak_memory = static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
    return report;
}

}  // namespace

RenderReport render(const Scene& scene, const RenderOptions& options) {
    return guarded("render", [&] { return render_frames(scene, options); });
}

}  // namespace wrinkle
