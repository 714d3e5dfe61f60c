#include "bars.h"

#include "ratio.h"

#include <fmt/format.h>

namespace wrinkle::bench {

namespace {

/// Names a measurement. Where several fit, such as one for each compiler, the fastest is meant.
struct Subject {
    const char *group, *name, *variant;
};

struct Promise {
    const char* name;
    Subject of, to;
    double limit;
    bool at_most = true;
    bool per_byte = false;  ///< compares the time that a byte takes, instead of a pixel's
};

// Each: what it is called; two measurements of a run; and what the time per pixel of the first, divided by that of the
// second, must be: at most (or at least) `limit`.
constexpr Promise kPromises[] = {
    {"8 decals / omp simd", {"stack", "decal_stack", "standard"}, {"stack", "decal_stack", "omp simd"}, 0.85},
    {"8 decals / plain C++", {"stack", "decal_stack", "standard"}, {"stack", "decal_stack", "plain C++"}, 0.25},
    {"8 decals / by hand", {"stack", "decal_stack", "standard"}, {"stack", "decal_stack", "by hand"}, 1.2},
    {"resolve / C++, plain stores", {"memory", "resolve", "standard"}, {"memory", "resolve", "plain C++"}, 1.1},
    {"resolve / triad, a byte",
     {"memory", "resolve", "standard"},
     {"memory", "triad", "C++ past the cache"},
     1 / 0.75,
     true,
     true},
    {"resolve from halves / floats",
     {"storage", "resolve_from", "half"},
     {"storage", "resolve_from", "float"},
     1 / 1.25},
    {"Perlin and gradient / differences",
     {"noise", "perlin_noise", "value and gradient"},
     {"noise", "perlin_noise", "forward differences"},
     0.40},
    {"Perlin and gradient / value only",
     {"noise", "perlin_noise", "value and gradient"},
     {"noise", "perlin_noise", "value only"},
     1.45},
    {"screen derivatives / copy", {"screen", "screen_derivatives", "standard"}, {"screen", "copy", "same bytes"}, 1.3},
    {"demo: plain C++ / fused", {"scene", "courtyard", "plain C++"}, {"scene", "courtyard", "fused"}, 4, false},
    {"demo: one kernel a layer / fused",
     {"scene", "courtyard", "one kernel a layer"},
     {"scene", "courtyard", "fused"},
     2,
     false},
    {"demo: numbers in memory / compiled in",
     {"ablation", "courtyard", "only what it needs"},
     {"ablation", "courtyard", "numbers compiled in"},
     1.02},
    {"cobbles, 16 points / TextureSystem", {"area", "cobbles", "16 taps"}, {"area", "cobbles", "TextureSystem"}, 0.06},
    {"cobbles, 16 points / one", {"area", "cobbles", "16 taps"}, {"area", "cobbles", "1 tap"}, 2.3},
    {"cobbles, 16 points / 4 x 4", {"area", "cobbles", "16 taps"}, {"area", "cobbles", "4 x 4"}, 0.25},
    {"one core / two, arithmetic",
     {"cores", "arithmetic", "one core"},
     {"cores", "arithmetic", "two cores"},
     1.85,
     false},
    {"one core / two, 8 decals",
     {"cores", "decal_stack", "one core"},
     {"cores", "decal_stack", "two cores"},
     1.85,
     false},
    {"a pixel of 1 / of 8 Mpixel",
     {"size", "courtyard", "1 Mpixel"},
     {"turns", "courtyard", "8 Mpixel, with 1 Mpixel"},
     1.1},
    {"a pixel of 33 / of 8 Mpixel",
     {"size", "courtyard", "33 Mpixel"},
     {"turns", "courtyard", "8 Mpixel, with 33 Mpixel"},
     1.1},
    {"a pixel of 133 / of 8 Mpixel",
     {"size", "courtyard", "133 Mpixel"},
     {"turns", "courtyard", "8 Mpixel, with 133 Mpixel"},
     1.1},
    {"100,000 decals / 1,000", {"decals", "100000 decals", "standard"}, {"decals", "1000 decals", "standard"}, 1.3},
    {"binning / pass, 100,000 decals",
     {"decals", "100000 decals", "binning alone"},
     {"decals", "100000 decals", "standard"},
     0.15},
    {"10,000 lights, 8 a pixel / 8 everywhere",
     {"lights", "10000 lights", "standard"},
     {"lights", "8 lights everywhere", "standard"},
     1.4},
    {"1,000 decals: plain C++ / kernel",
     {"decals", "1000 decals", "plain C++, same lists"},
     {"decals", "1000 decals", "standard"},
     4,
     false},
    {"100,000 decals: plain C++ / kernel",
     {"decals", "100000 decals", "plain C++, same lists"},
     {"decals", "100000 decals", "standard"},
     4,
     false},
    {"coherent volume / NanoVDB",
     {"volume", "coherent, 0.2 voxels a pixel", "standard"},
     {"volume", "coherent, 0.2 voxels a pixel", "NanoVDB C++, gradient"},
     0.7},
    {"sparse volume / NanoVDB",
     {"volume", "sparse, 1.4 voxels a pixel", "standard"},
     {"volume", "sparse, 1.4 voxels a pixel", "NanoVDB C++, gradient"},
     0.7},
    {"a run / OpenEXR and libpng",
     {"files", "pictures", "wrinkle run"},
     {"files", "pictures", "OpenEXR and libpng"},
     1.25},
    {"27 passes passed on / oiiotool",
     {"files", "all passes", "wrinkle run"},
     {"files", "all passes", "oiiotool"},
     1.3},
    {"wrinkle run / oiiotool", {"files", "resolve", "wrinkle run"}, {"files", "resolve", "oiiotool"}, 0.65},
};

/// The fastest measurement of exactly this variant, on any number of lanes. Without one, the fastest whose variant
/// begins with that name ("omp simd" finds "omp simd, g++"). Null where nothing fits.
const Measurement* find(const Run& run, const Subject& wanted) {
    const Measurement* best = nullptr;
    const auto exact = [&](const Measurement& m) { return m.variant == wanted.variant; };
    for (const Measurement& m : run.measurements) {
        if (m.group != wanted.group || m.name != wanted.name || m.seconds.median <= 0) continue;
        if (!m.variant.starts_with(wanted.variant)) continue;
        const bool better =
            best == nullptr || (exact(m) == exact(*best) ? m.ns_per_pixel() < best->ns_per_pixel() : exact(m));
        if (better) best = &m;
    }
    return best;
}

std::string verdict(const Bar& bar) {
    if (bar.low <= bar.limit && bar.limit <= bar.high) return "not told apart";
    return (bar.ratio <= bar.limit) == bar.at_most ? "met" : "missed";
}

}  // namespace

std::vector<Bar> bars_of(const Run& run) {
    std::vector<Bar> bars;
    for (const Promise& promise : kPromises) {
        const Measurement *of = find(run, promise.of), *to = find(run, promise.to);
        if (of == nullptr || to == nullptr) continue;
        const Ratio r = ratio(of->seconds, to->seconds);
        Bar bar{.name = promise.name, .verdict = {}, .spread = r.spread, .limit = promise.limit};
        double scale = static_cast<double>(to->pixels) / static_cast<double>(of->pixels);
        if (promise.per_byte) scale *= to->bytes / of->bytes;
        bar.ratio = scale * r.value, bar.low = scale * r.low, bar.high = scale * r.high;
        bar.at_most = promise.at_most;
        bar.of = of->key(), bar.to = to->key();
        bar.of_p99 = of->error.p99, bar.to_p99 = to->error.p99, bar.unit = of->unit;
        bar.verdict = verdict(bar);
        bars.push_back(bar);
    }
    return bars;
}

}  // namespace wrinkle::bench
