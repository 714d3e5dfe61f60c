#include "sizes.h"

#include <fmt/format.h>
#include <malloc.h>
#include <unistd.h>

#include <fstream>

#include "resident.h"

namespace wrinkle::bench {

namespace {

constexpr Size kBeside{3840, 2160};  ///< the frame that others take turns with
constexpr std::uint32_t kBandPixels = 1u << 21;

std::size_t pixels_of(Size size) { return std::size_t{size.width} * size.height; }

std::string megapixels(Size size) { return fmt::format("{:.0f} Mpixel", 1e-6 * static_cast<double>(pixels_of(size))); }

/// A scene's pass over a frame of some size, a band of rows at a time.
class Bands {
public:
    Bands(const Device& device, const Scene& from_file, const Resampler& resampler, Size size)
        : device_(device), resampler_(resampler), size_(size) {
        Frame shape = resampler.description();
        shape.size = size;
        scene = without_lighting(from_file, shape);
        pass.emplace(evaluate(device, scene, shape));
        rows_ = std::max(kBandPixels / size.width, 1u);
        out_ = PlaneBuffers(device, pass->outputs(), std::size_t{rows_} * size.width, sizeof(float));
    }

    std::uint32_t count() const { return (size_.height + rows_ - 1) / rows_; }

    Rows rows(std::uint32_t band) const {
        const std::uint32_t first = band * rows_, count = std::min(rows_, size_.height - first),
                            margin = pass->needs_neighbours() ? 1 : 0;
        return {first, count, std::min(first, margin), std::min(size_.height - first - count, margin)};
    }

    /// What the pass reads, of a band.
    PlaneBuffers load(std::uint32_t band) const {
        const Rows r = rows(band);
        const std::uint32_t count = r.before + r.count + r.after;
        PlaneBuffers in(device_, pass->inputs(), std::size_t{count} * size_.width, sizeof(float));
        for (const auto& [name, plane] : resampler_.rows(size_, r.first - r.before, count, pass->inputs()))
            std::ranges::copy(plane, in.map<float>(name, CL_MAP_WRITE));
        in.unmap();
        return in;
    }

    void run(std::uint32_t band, const PlaneBuffers& in) {
        pass->enqueue(in.planes(), out_.planes(), rows(band)).wait();
    }

    Scene scene;
    std::optional<Pass> pass;

private:
    const Device& device_;
    const Resampler& resampler_;
    Size size_;
    std::uint32_t rows_ = 0;
    PlaneBuffers out_;
};

/// Errors of the same kernels on a frame that fits into memory at once.
ErrorStats sampled_error(const Device& device, const Scene& scene, const Resampler& resampler, Size size) {
    const BenchFrame frame =
        resampler.frame({std::min(size.width, kBeside.width), std::min(size.height, kBeside.height)});
    Resident whole(device, scene, frame);
    whole.run();
    return ReferenceSample(scene, frame, kErrorSamples, kSeed).compare(whole.normals(frame.pixels()));
}

/// Bytes of memory that this process holds.
double resident_bytes() {
    std::ifstream statm("/proc/self/statm");
    double pages = 0;
    statm >> pages >> pages;
    return pages * static_cast<double>(::sysconf(_SC_PAGESIZE));
}

/// A frame and the one beside it, each as seconds of the whole frame; and the bytes held meanwhile.
struct Turns {
    Timing frame, beside;
    double held = 0;
};

/// Frame and the one beside it band by band in turns: through the larger of the two once, as often through the smaller
/// as that takes; every round sums up its own turns.
Turns take_turns(Bands& frame, Bands& beside, const std::vector<PlaneBuffers>& beside_in, double held_before,
                 const Rounds& rounds) {
    const std::uint32_t times = std::max(beside.count() / frame.count(), 1u), steps = times * frame.count();
    std::vector<double> seconds, beside_seconds;
    double held = 0;
    for (std::uint32_t step = 0; step < steps; ++step) {
        const std::uint32_t band = step / times, beside_band = step % beside.count();
        const PlaneBuffers in = frame.load(band);
        std::vector<Contender> pair{{"frame", [&] { frame.run(band, in); }},
                                    {"beside", [&] { beside.run(beside_band, beside_in[beside_band]); }}};
        if (step == 0) {
            race(pair, {1});
            const double once = steps * (pair[0].seconds.median + pair[1].seconds.median);
            seconds.resize(static_cast<std::size_t>(std::max<double>(rounds.least, std::ceil(rounds.seconds / once))));
            beside_seconds.resize(seconds.size());
        }
        race(pair, {static_cast<int>(seconds.size())});
        held = std::max(held, resident_bytes() - held_before);
        for (std::size_t round = 0; round < seconds.size(); ++round) {
            seconds[round] += pair[0].seconds.runs[round] / times;
            beside_seconds[round] += pair[1].seconds.runs[round] * beside.count() / steps;
        }
    }
    return {timing(std::move(seconds)), timing(std::move(beside_seconds)), held};
}

}  // namespace

void measure_sizes(const Device& device, const std::filesystem::path& file, const std::vector<Size>& sizes, Run& run) {
    const Scene from_file = load_scene(file);
    const Resampler resampler(from_file);
    Bands beside(device, from_file, resampler, kBeside);
    std::vector<PlaneBuffers> beside_in;
    for (std::uint32_t band = 0; band < beside.count(); ++band) beside_in.push_back(beside.load(band));
    const ErrorStats beside_error = sampled_error(device, beside.scene, resampler, kBeside);
    std::vector<Measurement> turned;
    for (const Size size : sizes) {
        ::malloc_trim(0);  // what earlier sizes let go
        const double held_before = resident_bytes();
        Bands frame(device, from_file, resampler, size);
        const Turns turns = take_turns(frame, beside, beside_in, held_before, few(run.rounds));
        Measurement m{.group = "size",
                      .name = file.stem(),
                      .variant = megapixels(size),
                      .lanes = device.info.lanes,
                      .pixels = pixels_of(size),
                      .seconds = turns.frame,
                      .bytes = bytes_of(*frame.pass),
                      .operations = operations_of(*frame.pass),
                      .at_most = true};
        m.memory = turns.held;
        m.error = sampled_error(device, frame.scene, resampler, size);
        run.measurements.push_back(m);
        m.group = "size, in turns", m.variant = fmt::format("{}, with {}", megapixels(kBeside), megapixels(size));
        m.pixels = pixels_of(kBeside), m.seconds = turns.beside, m.memory = 0, m.error = beside_error;
        if (pixels_of(size) != pixels_of(kBeside)) turned.push_back(m);
    }
    run.measurements.insert(run.measurements.end(), turned.begin(), turned.end());
}

}  // namespace wrinkle::bench
