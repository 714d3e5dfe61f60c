#include "report.h"

#include "ratio.h"

#include <fmt/format.h>

#include "base/atomic_file.h"
#include "wrinkle/error.h"

namespace wrinkle::bench {

namespace {

namespace fs = std::filesystem;

void write_text(const fs::path& file, const std::string& text) {
    AtomicFile out(file);
    out.write(text);
    out.commit();
}

std::size_t not_finite(const Measurement& m) {
    std::size_t count = m.error.not_finite;
    for (const auto& [category, stats] : m.hard) count += stats.not_finite;
    return count;
}

double worst_hard(const Measurement& m) {
    double worst = 0;
    for (const auto& [category, stats] : m.hard) worst = std::max(worst, stats.max);
    return worst;
}

std::string csv(const Run& run) {
    std::string text =
        "group,name,variant,lanes,pixels,ns_per_pixel,spread,gb_per_s,share_of_copy,gflop_per_s,share_of_fma,"
        "error_unit,inputs,error_median,error_p99,error_max,samples,not_finite,documented_error,memory,hash\n";
    for (const Measurement& m : run.measurements) {
        const bool timed = m.seconds.median > 0;
        const auto row = [&](const std::string& inputs, const ErrorStats& e) {
            text += fmt::format("{},\"{}\",\"{}\",{},{},", m.group, m.name, m.variant, m.lanes, m.pixels);
            if (timed)
                text += fmt::format("{:.4g},{:.3g},{:.4g},{:.3g},{},", m.ns_per_pixel(), m.seconds.spread, m.gb_per_s(),
                                    m.gb_per_s() / run.ceilings.copy_gb_s,
                                    m.counted() ? fmt::format("{:.4g},{:.3g}", m.gflop_per_s(),
                                                              m.gflop_per_s() / run.ceilings.fma_gflop_s)
                                                : ",");
            else
                text += ",,,,,,";
            text += fmt::format("{},\"{}\",{:.4g},{:.4g},{:.4g},{},{},{:.3g},{:.0f},{}\n", m.unit, inputs, e.median,
                                e.p99, e.max, e.samples, e.not_finite, m.bound, m.memory, m.hash);
        };
        row("regular", m.error);
        for (const auto& [category, stats] : m.hard) row(category, stats);
    }
    return text;
}

/// Variants of `group` are printed as ratios to the variant `base`.
struct Compared {
    const char *group, *base;
};

void print_ratios(const Run& run) {
    bool title = false;
    for (const Compared& compared : {Compared{"scene", "fused"}, Compared{"ablation", "only what it needs"}})
        for (const Measurement& slow : run.measurements)
            for (const Measurement& fast : run.measurements) {
                if (slow.group != compared.group || fast.group != compared.group || slow.name != fast.name ||
                    fast.variant != compared.base || slow.variant == compared.base)
                    continue;
                if (!title) fmt::print("\nratios\n"), title = true;
                fmt::print("  {:<58}{:>8}  p99 {:.1e} / {:.1e} {}\n",
                           fmt::format("{}: {} / {}", slow.name, slow.variant, fast.variant),
                           text_of(ratio(slow.seconds, fast.seconds)), slow.error.p99, fast.error.p99, slow.unit);
            }
}

void print_bars(const Run& run) {
    if (run.bars.empty()) return;
    fmt::print("\n{:<38}{:>9}{:>16}{:>8}{:>11}  {:<16}{:>9}{:>9}  {}\n", "bars", "measured", "between", "spread",
               "limit", "", "p99 of", "p99 to", "error in");
    for (const Bar& b : run.bars)
        fmt::print("  {:<36}{:>8.2f}x{:>8.2f} - {:<5.2f}{:>7.1f}%{:>4}{:>6.2f}x  {:<16}{:>9.1e}{:>9.1e}  {}\n", b.name,
                   b.ratio, b.low, b.high, 100 * b.spread, b.at_most ? "<=" : ">=", b.limit, b.verdict, b.of_p99,
                   b.to_p99, b.unit);
}

/// The share of the ceiling of multiply-adds, as "41%"; "-" where operations were not counted.
std::string fma_share(const Run& run, const Measurement& m) {
    return m.counted() ? fmt::format("{:.0f}%", 100 * m.gflop_per_s() / run.ceilings.fma_gflop_s) : "-";
}

}  // namespace

void print(const Run& run) {
    fmt::print("{}; {}; {}\n", run.processor, run.device, text_of(run.rounds));
    fmt::print("ceilings: copy {:.1f} GB/s, triad {:.1f} GB/s ({:.1f} in C++), fma {:.0f} Gflop/s\n",
               run.ceilings.copy_gb_s, run.ceilings.triad_gb_s, run.ceilings.streamed_triad_gb_s,
               run.ceilings.fma_gflop_s);
    std::string group;
    for (const Measurement& m : run.measurements) {
        if (m.group != group) {
            group = m.group;
            fmt::print("\n{:<43}{:<24}{:>6}{:>10}{:>8}{:>7}{:>7}   {:>9}{:>9}{:>9}{:>9}{:>5}  {}\n", group, "", "lanes",
                       "ns/pixel", "spread", "copy", "fma", "median", "p99", "max", "hard", "inf", "error in");
        }
        fmt::print("  {:<41}{:<24}{:>6}", m.name, m.variant, m.lanes);
        if (m.seconds.median > 0)
            fmt::print("{:>10.2f}{:>7.1f}%{:>6.0f}%{:>7}", m.ns_per_pixel(), 100 * m.seconds.spread,
                       100 * m.gb_per_s() / run.ceilings.copy_gb_s, fma_share(run, m));
        else
            fmt::print("{:>10}{:>8}{:>7}{:>7}", "-", "-", "-", "-");
        fmt::print("   {:>9.1e}{:>9.1e}{:>9.1e}{:>9.1e}{:>5}  {}{}\n", m.error.median, m.error.p99, m.error.max,
                   worst_hard(m), not_finite(m), m.unit,
                   m.memory > 0 ? fmt::format("; {:.0f} MB held", m.memory * 1e-6) : "");
        for (const auto& [what, figure] : m.figures) fmt::print("      {:.3g} {}\n", figure, what);
    }
    print_ratios(run);
    print_bars(run);
}

void write_json(const Run& run, const fs::path& file) { write_text(file, to_json(run).dump(1) + "\n"); }

void make_folder(const fs::path& folder) {
    std::error_code failed;
    fs::create_directories(folder, failed);
    if (failed) throw Error(fmt::format("cannot make the folder {}: {}", folder.string(), failed.message()));
}

void write_report(const Run& run, const fs::path& folder) {
    make_folder(folder);
    write_json(run, folder / "run.json");
    write_text(folder / "run.csv", csv(run));
    const auto svgs = charts(run);
    for (const auto& [name, svg] : svgs) write_text(folder / (name + ".svg"), svg);
    write_text(folder / "index.html", html(run, svgs));
    fmt::print("\nwritten: {}\n", (folder / "index.html").string());
}

}  // namespace wrinkle::bench
