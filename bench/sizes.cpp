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

/// Evaluates a scene on a frame of some size, a band of rows at a time.
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

    /// The input planes of a band.
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

/// Errors of the same kernels on a whole frame, cut down to a size that fits into memory.
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

/// Seconds for a whole frame, and for the one that takes turns with it; and the most bytes held meanwhile.
struct Turns {
    Timing frame, beside;
    double held = 0;
};

/// The frame of 3840 x 2160 that every other size takes turns with, with all of its bands on the device.
struct Beside {
    Bands bands;
    std::vector<PlaneBuffers> in{};
    double seconds_a_band = 0;  ///< measured once, to plan a race by

    explicit Beside(Bands given) : bands(std::move(given)) {
        for (std::uint32_t band = 0; band < bands.count(); ++band) in.push_back(bands.load(band));
        // The first time builds kernels and touches memory.
        for (std::uint32_t band = 0; band < bands.count(); ++band) run(band);
        for (std::uint32_t band = 0; band < bands.count(); ++band)
            seconds_a_band += seconds_of([&] { run(band); }) / bands.count();
    }
    void run(std::uint32_t band) { bands.run(band, in[band]); }
};

/// Races the two frames band against band, so that both meet the same disturbances. Goes once through the bands of
/// `frame`, or several times through each when it has fewer than `beside`. The times of a round are added up over all
/// bands.
Turns take_turns(Bands& frame, Beside& beside, double held_before, const Rounds& rounds) {
    const std::uint32_t times = std::max(beside.bands.count() / frame.count(), 1u), steps = times * frame.count();
    const double once = 2 * steps * beside.seconds_a_band;
    const auto count = static_cast<std::size_t>(std::max<double>(rounds.least, std::ceil(rounds.seconds / once)));
    std::vector<double> seconds(count), beside_seconds(count);
    double held = 0;
    std::size_t beside_pixels = 0;
    for (std::uint32_t step = 0; step < steps; ++step) {
        const std::uint32_t band = step / times, beside_band = step % beside.bands.count();
        const PlaneBuffers in = frame.load(band);
        std::vector<Contender> pair{{"frame", [&] { frame.run(band, in); }},
                                    {"beside", [&] { beside.run(beside_band); }}};
        race(pair, {static_cast<int>(count)});
        held = std::max(held, resident_bytes() - held_before);
        beside_pixels += std::size_t{beside.bands.rows(beside_band).count} * kBeside.width;
        for (std::size_t round = 0; round < count; ++round) {
            seconds[round] += pair[0].seconds.runs[round] / times;
            beside_seconds[round] += pair[1].seconds.runs[round];
        }
    }
    for (double& s : beside_seconds) s *= static_cast<double>(pixels_of(kBeside)) / static_cast<double>(beside_pixels);
    return {timing(std::move(seconds)), timing(std::move(beside_seconds)), held};
}

}  // namespace

void measure_sizes(const Device& device, const std::filesystem::path& file, const std::vector<Size>& sizes, Run& run) {
    const Scene from_file = load_scene(file);
    const Resampler resampler(from_file);
    Beside beside(Bands(device, from_file, resampler, kBeside));
    const ErrorStats beside_error = sampled_error(device, beside.bands.scene, resampler, kBeside);
    std::vector<Measurement> turned;
    for (const Size size : sizes) {
        ::malloc_trim(0);  // gives memory that earlier sizes freed back to the system, or it would count as held
        const double held_before = resident_bytes();
        Bands frame(device, from_file, resampler, size);
        const Turns turns = take_turns(frame, beside, held_before, few(run.rounds));
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
        m.group = "turns", m.variant = fmt::format("{}, with {}", megapixels(kBeside), megapixels(size));
        m.pixels = pixels_of(kBeside), m.seconds = turns.beside, m.memory = 0, m.error = beside_error;
        if (pixels_of(size) != pixels_of(kBeside)) turned.push_back(m);
    }
    run.measurements.insert(run.measurements.end(), turned.begin(), turned.end());
}

}  // namespace wrinkle::bench
