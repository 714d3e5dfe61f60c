#include <fmt/format.h>

#include <memory>

#include "selftest/answers.h"
#include "selftest/checks.h"
#include "selftest/errors.h"
#include "selftest/scenes.h"

namespace wrinkle::selftest {

namespace {

using Planes = std::map<std::string, std::vector<float>>;

Planes evaluated(const Device& device, const CheckedScene& checked) {
    const CheckedFrame frame = checked_frame();
    Pass pass = evaluate(device, checked.scene, frame.frame);
    Planes out;
    HostOutputs spans;
    for (const std::string& name : pass.outputs())
        spans[name] = out[name] = std::vector<float>(frame.planes.at("depth").size(), -77.f);
    pass.run(HostPlanes(frame.planes.begin(), frame.planes.end()), spans);
    return out;
}

template <class T>
Vec3 vector_at(const std::map<std::string, std::vector<T>>& planes, const std::string& name, const char* parts,
               std::size_t pixel) {
    Vec3 v;
    for (std::size_t k = 0; k < 3; ++k) v[k] = static_cast<double>(planes.at(name + '.' + parts[k])[pixel]);
    return v;
}

void add(std::vector<Finding>& findings, const std::string& what, const char* unit, const ErrorStats& is,
         const Bounds& bounds) {
    findings.push_back({what + ", median", unit, is.median, bounds.median});
    findings.push_back({what + ", 99%", unit, is.p99, bounds.p99});
    findings.push_back({what + ", largest", unit, is.max, bounds.max});
    findings.push_back({what, "pixels not finite", static_cast<double>(is.not_finite), 0});
}

std::vector<Finding> check_scene(const Device& device, const CheckedScene& checked) {
    const Answers& answers = answers_of("scene " + checked.name);
    const Planes got = evaluated(device, checked);
    std::vector<double> degrees, relative;
    for (std::size_t pixel = 0; pixel < answers.rows(); ++pixel) {
        degrees.push_back(
            angle(vector_at(got, "normal", "xyz", pixel), vector_at(answers.want, "normal", "xyz", pixel)));
        if (!answers.want.contains("lit.r")) continue;
        const Vec3 is = vector_at(got, "lit", "rgb", pixel), want = vector_at(answers.want, "lit", "rgb", pixel);
        relative.push_back(length(subtract(is, want)) / std::max(length(want), 0.01));
    }
    std::vector<Finding> findings;
    add(findings, "normal", "degrees", statistics(std::move(degrees)), checked.degrees);
    if (!relative.empty()) add(findings, "lit", "relative", statistics(std::move(relative)), checked.relative);
    return findings;
}

}  // namespace

std::vector<Check> scene_checks() {
    // The folder lasts as long as any of the checks.
    const auto folder = std::make_shared<const TemporaryFolder>();
    std::vector<Check> checks;
    for (const CheckedScene& scene : checked_scenes(folder->path()))
        checks.push_back(
            {"scene " + scene.name, [folder, scene](const Device& device) { return check_scene(device, scene); }, 30});
    return checks;
}

}  // namespace wrinkle::selftest
