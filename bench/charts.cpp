#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <set>

#include "report.h"
#include "temporary_folder.h"
#include "wrinkle/error.h"

namespace wrinkle::bench {

namespace {

/// A string of gnuplot's.
std::string quoted(const std::string& text) {
    std::string out = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\') out += '\\';
        out += c;
    }
    return out + '"';
}

/// A logarithmic axis has no 0, so errors of 0 are drawn at its left edge.
double shown_error(double error) { return std::max(error, 1e-16); }

std::string label(const Measurement& m) {
    return m.lanes > 0 ? fmt::format("{}, {} lane{}", m.variant, m.lanes, m.lanes == 1 ? "" : "s") : m.variant;
}

/// Whether no other measurement is both faster and more accurate.
bool on_front(const Measurement& m, const std::vector<const Measurement*>& all) {
    for (const Measurement* other : all)
        if (other != &m && other->ns_per_pixel() <= m.ns_per_pixel() && other->error.p99 <= m.error.p99 &&
            (other->ns_per_pixel() < m.ns_per_pixel() || other->error.p99 < m.error.p99))
            return false;
    return true;
}

std::string points(const char* block, const std::vector<const Measurement*>& all, bool front) {
    std::string text = fmt::format("${} << EOD\n", block);
    std::vector<const Measurement*> some;
    for (const Measurement* m : all)
        if (!front || on_front(*m, all)) some.push_back(m);
    std::ranges::sort(some, {}, [](const Measurement* m) { return m->error.p99; });
    for (const Measurement* m : some)
        text += fmt::format("{:.6g} {:.6g} {}\n", shown_error(m->error.p99), m->ns_per_pixel(), quoted(label(*m)));
    return text + "EOD\n";
}

/// A chart of error against time for the variants of one thing. A line joins those that no other one beats in both.
std::string pareto(const std::string& name, const std::vector<const Measurement*>& all) {
    return fmt::format(
        "set title {} noenhanced\nset xlabel {}\nset ylabel \"ns per pixel\"\nset logscale xy\nset format x \"%.0e\"\n"
        "set offsets graph 0.08, graph 0.08, graph 0.12, graph 0.05\n{}{}"
        "plot $front using 1:2 with lines lc rgb \"#c05020\" lw 2 notitle, "
        "$all using 1:2 with points pt 7 ps 0.7 lc rgb \"#205080\" notitle, "
        "$all using 1:2:3 with labels offset 0,0.9 font \",9\" noenhanced notitle\n",
        quoted(name), quoted(fmt::format("error, 99% of the pixels, {}", all.front()->unit)),
        points("front", all, true), points("all", all, false));
}

/// A point of the roofline, on logarithmic axes.
struct RoofPoint {
    double x, y, below;  ///< in decades; `below`: how far it lies below the roof
    std::string name;
};

/// Labels as many points as there is room for, those furthest below the roof first.
std::string labels_of(std::vector<RoofPoint> points) {
    constexpr double kCharacter = 0.026, kLine = 0.07;  // decades, in a chart of 900 x 600
    std::ranges::sort(points, std::greater(), &RoofPoint::below);
    std::vector<RoofPoint> named;
    std::string data = "$named << EOD\n";
    for (const RoofPoint& point : points) {
        const bool room = std::ranges::none_of(named, [&](const RoofPoint& other) {
            const double wide = kCharacter * static_cast<double>(point.name.size() + other.name.size()) / 2;
            return std::abs(other.x - point.x) < wide && std::abs(other.y - point.y) < kLine;
        });
        if (!room) continue;
        named.push_back(point);
        data += fmt::format("{:.6g} {:.6g} {}\n", std::pow(10, point.x), std::pow(10, point.y), quoted(point.name));
    }
    return data + "EOD\n";
}

/// False when the same was measured on another number of lanes, and was faster there.
bool fastest_lanes(const Measurement& m, const Run& run) {
    return std::ranges::none_of(run.measurements, [&](const Measurement& other) {
        return other.group == m.group && other.name == m.name && other.variant == m.variant &&
               other.pixels == m.pixels && other.seconds.median < m.seconds.median;
    });
}

/// A chart of operations per byte against speed, under the machine's ceilings for memory and arithmetic.
std::string roofline(const Run& run) {
    std::string data = "$all << EOD\n";
    std::vector<RoofPoint> points;
    for (const Measurement& m : run.measurements)
        if (m.seconds.median > 0 && m.counted() && m.lanes > 0 && m.variant != "double" && fastest_lanes(m, run)) {
            const double x = m.operations / m.bytes, y = m.gflop_per_s();
            const double roof = std::min(x * run.ceilings.copy_gb_s, run.ceilings.fma_gflop_s);
            data += fmt::format("{:.6g} {:.6g}\n", x, y);
            points.push_back({std::log10(x), std::log10(y), std::log10(roof / y),
                              m.name + (m.group == "function" || m.group == "layer" ? "" : ": " + m.variant)});
        }
    return data + "EOD\n" + labels_of(std::move(points)) +
           fmt::format(
               "set title \"roofline\"\nset xlabel \"operations per byte\"\nset ylabel \"Gflop/s\"\n"
               "set logscale xy\nroof(x) = x * {0:.6g} < {1:.6g} ? x * {0:.6g} : {1:.6g}\nset xrange [0.05:200]\n"
               "plot roof(x) with lines lc rgb \"#c05020\" lw 2 title \"copy {0:.0f} GB/s, fma {1:.0f} Gflop/s\", "
               "$all using 1:2 with points pt 7 ps 0.5 lc rgb \"#205080\" notitle, "
               "$named using 1:2:3 with labels offset 0,-0.7 font \",8\" noenhanced notitle\n",
               run.ceilings.copy_gb_s, run.ceilings.fma_gflop_s);
}

std::string sizes(const std::vector<const Measurement*>& all) {
    std::string data = "$all << EOD\n";
    for (const Measurement* m : all)
        data += fmt::format("{:.6g} {:.6g}\n", static_cast<double>(m->pixels) * 1e-6, m->ns_per_pixel());
    return data +
           "EOD\nset title \"time per pixel by size of the frame\"\nset xlabel \"Mpixel\"\nset ylabel \"ns per "
           "pixel\"\n"
           "set logscale x\nset yrange [0:*]\nplot $all using 1:2 with linespoints pt 7 lc rgb \"#205080\" notitle\n";
}

}  // namespace

std::map<std::string, std::string> charts(const Run& run) {
    std::map<std::string, std::vector<const Measurement*>> variants;
    std::vector<const Measurement*> by_size;
    for (const Measurement& m : run.measurements) {
        if (m.seconds.median <= 0) continue;
        if (m.group == "size") by_size.push_back(&m);
        if (m.group == "function" || m.group == "scene" || m.group == "memory")
            variants[m.name].push_back(&m);
        else if (m.group == "stack" || m.group == "noise" || m.group == "storage" || m.group == "variant" ||
                 m.group == "ablation" || m.group == "area")
            variants[m.group + "-" + m.name].push_back(&m);
    }
    std::map<std::string, std::string> scripts{{"roofline", roofline(run)}};
    if (by_size.size() > 1) scripts["sizes"] = sizes(by_size);
    for (const auto& [name, all] : variants)
        if (all.size() > 1) scripts["pareto-" + name] = pareto(name, all);

    const TemporaryFolder folder;
    std::string script;
    std::size_t number = 0;
    for (const auto& [name, text] : scripts)
        script += fmt::format(
            "reset\nset grid\nset terminal svg size {} font \"sans-serif,11\" background \"#ffffff\"\n"
            "set output \"{}/{}.svg\"\n{}",
            name == "roofline" ? "900,600" : "560,380", folder.path().string(), number++, text);
    std::ofstream(folder.path() / "script") << script;
    const int status = std::system(
        fmt::format("gnuplot '{}' 2> '{}'", (folder.path() / "script").string(), (folder.path() / "messages").string())
            .c_str());
    std::map<std::string, std::string> svgs;
    number = 0;
    for (const auto& [name, text] : scripts) {
        std::ifstream in(folder.path() / fmt::format("{}.svg", number++));
        svgs[name] = {std::istreambuf_iterator<char>(in), {}};
    }
    if (status != 0) throw Error("the charts need gnuplot: install the package gnuplot-nox, or leave --report away");
    return svgs;
}

}  // namespace wrinkle::bench
