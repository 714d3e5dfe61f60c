#include "compare.h"

#include <fmt/format.h>

namespace wrinkle::bench {

namespace {

/// On one device errors are the same in every run. On another, compilers may round last bits differently, which a
/// single ill-conditioned input can enlarge: so the largest error is allowed to grow more than the 99% error.
constexpr double kErrorSlack = 1.25, kMaxErrorSlack = 2;

/// Whether an error grew by more than rounding explains.
bool grew(const ErrorStats& before, const ErrorStats& now) {
    const auto larger = [](double a, double b, double slack) { return b > slack * a && b > 1e-12; };
    return larger(before.p99, now.p99, kErrorSlack) || larger(before.max, now.max, kMaxErrorSlack) ||
           now.not_finite > before.not_finite;
}

/// Time as a multiple of what the machine needs at least: for the arithmetic where there is a lot of it per byte, else
/// for moving the bytes.
double relative_seconds(const Run& run, const Measurement& m) {
    return m.operations > 10 * m.bytes ? m.seconds.median * run.ceilings.fma_gflop_s
                                       : m.seconds.median * run.ceilings.copy_gb_s;
}

}  // namespace

bool compare(const Run& before, const Run& now) {
    std::map<std::string, const Measurement*> known;
    for (const Measurement& m : before.measurements) known[m.key()] = &m;
    std::size_t compared = 0, slower = 0, faster = 0, worse = 0;
    fmt::print("\ncompared with {} ({})\n", before.processor, before.device);
    for (const Measurement& m : now.measurements) {
        const auto found = known.find(m.key());
        if (found == known.end()) {
            fmt::print("  new                {}\n", m.key());
            continue;
        }
        const Measurement& old = *found->second;
        known.erase(found);
        ++compared;
        bool less_accurate = grew(old.error, m.error);
        for (const auto& [category, stats] : m.hard)
            if (const auto was = old.hard.find(category); was != old.hard.end())
                less_accurate |= grew(was->second, stats);
        // The rounding of C++ depends on this machine's instructions; but C++ that computes something else is no peer.
        const bool another = m.lanes > 0 || m.error.median > 10 * old.error.median;
        if (less_accurate && another) {
            ++worse;
            fmt::print("  LESS ACCURATE      {}: p99 {:.2g} -> {:.2g}, max {:.2g} -> {:.2g} {}\n", m.key(),
                       old.error.p99, m.error.p99, old.error.max, m.error.max, m.unit);
        }
        if (m.seconds.median <= 0 || old.seconds.median <= 0) continue;
        const double factor = relative_seconds(now, m) / relative_seconds(before, old);
        const double spread = std::hypot(m.seconds.spread, old.seconds.spread) + 0.05;
        if (factor > 1 + spread) ++slower, fmt::print("  slower             {}: {:.2f}x\n", m.key(), factor);
        if (factor < 1 / (1 + spread)) ++faster, fmt::print("  faster             {}: {:.2f}x\n", m.key(), factor);
    }
    for (const auto& [key, m] : known) fmt::print("  not measured now   {}\n", key);
    fmt::print("  {} compared: {} less accurate, {} slower, {} faster than the spreads explain\n", compared, worse,
               slower, faster);
    return worse == 0;
}

}  // namespace wrinkle::bench
