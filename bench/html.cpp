#include <fmt/format.h>

#include "report.h"

namespace wrinkle::bench {

namespace {

std::string escaped(const std::string& text) {
    std::string out;
    for (const char c : text) out += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '>' ? "&gt;" : std::string(1, c);
    return out;
}

/// The <svg> element, without the declarations before it that belong to a file of its own.
std::string inner_svg(const std::string& svg) {
    const std::size_t start = svg.find("<svg");
    return start == std::string::npos ? std::string{} : svg.substr(start);
}

std::string row(const Run& run, const Measurement& m) {
    std::string speed = "<td colspan=4>not timed</td>";
    if (m.seconds.median > 0)
        speed = fmt::format(
            "<td>{:.2f}</td><td>{:.1f}%</td><td>{:.0f}%</td><td>{}</td>", m.ns_per_pixel(), 100 * m.seconds.spread,
            100 * m.gb_per_s() / run.ceilings.copy_gb_s,
            m.counted() ? fmt::format("{:.0f}%", 100 * m.gflop_per_s() / run.ceilings.fma_gflop_s) : std::string("-"));
    std::string hard;
    for (const auto& [category, e] : m.hard)
        hard += fmt::format("{}{}: {:.1e}, {:.1e}, {:.1e}{}", hard.empty() ? "" : "<br>", escaped(category), e.median,
                            e.p99, e.max, e.not_finite > 0 ? fmt::format(", {} not finite", e.not_finite) : "");
    std::string variant = escaped(m.variant);
    for (const auto& [what, figure] : m.figures) variant += fmt::format("<br>{:.3g} {}", figure, escaped(what));
    return fmt::format(
        "<tr><td>{}</td><td>{}</td><td>{}</td>{}<td>{:.1e}</td><td>{:.1e}</td><td>{:.1e}</td><td>{}</td><td>{}</td>"
        "<td class=hard>{}</td></tr>\n",
        escaped(m.name), variant, m.lanes, speed, m.error.median, m.error.p99, m.error.max, m.error.not_finite, m.unit,
        hard);
}

std::string bars_table(const Run& run) {
    if (run.bars.empty()) return {};
    std::string text =
        "<h2>bars</h2>\n<table><tr><th>bar<th>verdict<th>measured<th>between<th>spread<th>limit<th>p99 error of<th>p99 "
        "error to"
        "<th>unit</tr>\n";
    for (const Bar& b : run.bars)
        text += fmt::format(
            "<tr><td>{}</td><td>{}</td><td>{:.2f}</td><td>{:.2f} - {:.2f}</td><td>{:.1f}%</td><td>{} "
            "{:.2f}</td><td>{:.1e}</td><td>{:.1e}</td>"
            "<td>{}</td></tr>\n",
            escaped(b.name), b.verdict, b.ratio, b.low, b.high, 100 * b.spread, b.at_most ? "at most" : "at least",
            b.limit, b.of_p99, b.to_p99, b.unit);
    return text + "</table>\n";
}

}  // namespace

std::string html(const Run& run, const std::map<std::string, std::string>& charts) {
    std::string text = fmt::format(
        "<!doctype html>\n<html lang=en><meta charset=utf-8><title>wrinkle: speed beside error</title>\n<style>\n"
        "body {{ font: 15px/1.4 sans-serif; margin: 2em; max-width: 1250px }}\n"
        "table {{ border-collapse: collapse; font-size: 13px }}\n"
        "td, th {{ padding: 2px 8px; border-bottom: 1px solid #ddd; text-align: right; vertical-align: top }}\n"
        "td:first-child, td:nth-child(2), td.hard {{ text-align: left }}\n.charts svg {{ margin: 4px }}\n"
        "</style>\n<h1>wrinkle: speed beside error</h1>\n"
        "<p>{}; {}.<br>wrinkle bench {}<br>{}; spread is between the quartiles; a bar's ratio lies between its bounds "
        "with 95% confidence. Ceilings of this "
        "run: copy {:.1f} GB/s, triad {:.1f} GB/s, fma {:.0f} Gflop/s.</p>\n<div class=charts>\n",
        escaped(run.processor), escaped(run.device), escaped(run.command), text_of(run.rounds), run.ceilings.copy_gb_s,
        run.ceilings.triad_gb_s, run.ceilings.fma_gflop_s);
    for (const auto& [name, svg] : charts) text += inner_svg(svg);
    text += "</div>\n";
    text += bars_table(run);
    std::string group;
    for (const Measurement& m : run.measurements) {
        if (m.group != group) {
            if (!group.empty()) text += "</table>\n";
            group = m.group;
            text += fmt::format(
                "<h2>{}</h2>\n<table><tr><th>name<th>variant<th>lanes<th>ns/pixel<th>spread<th>of copy<th>of fma"
                "<th>median error<th>p99<th>max<th>not finite<th>unit<th>hard inputs: median, p99, max</tr>\n",
                escaped(group));
        }
        text += row(run, m);
    }
    return text + (group.empty() ? "" : "</table>\n") + "</html>\n";
}

}  // namespace wrinkle::bench
