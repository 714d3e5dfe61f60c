// shade/area_light.clh, against brute force over the lights.
#include "tests/cases/lighting.h"
#include "tests/kernels/check.h"

namespace wrinkle::test {
namespace {

using D = reference::Vec<double>;

Light sphere(double radius) {
    return {.kind = LightKind::sphere, .intensity = 8, .position = {1, 0.5, 3}, .radius = radius};
}
Light sun(double degrees) { return {.intensity = 2, .direction = {0.3, -0.4, -0.8}, .angle = degrees * M_PI / 180}; }
Light disc(double radius) {
    return {
        .kind = LightKind::disc, .intensity = 8, .position = {1, 0.5, 3}, .direction = {-0.3, 0, -1}, .radius = radius};
}
Light rectangle(double width, double height) {
    return {.kind = LightKind::rectangle,
            .intensity = 8,
            .position = {1, 0.5, 3},
            .direction = {0.2, 0.1, -1},
            .up = {0, 1, 0.2},
            .size = {width, height}};
}

/// A light's kernel constants.
std::vector<double> constants_of(const Light& light) {
    Scene scene;
    scene.lighting.lights = {light};
    const Camera at_origin{{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}}},
                           {{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, -1, -0.5}, {0, 0, -1, 0}}}};
    const FrameConstants constants = frame_constants({}, {scene, {}}, at_origin, {8, 8});
    const double* first = &constants.lights.at(0).kind;
    return {first, first + sizeof(wr_light) / sizeof(double)};
}

enum class Where { above, anywhere };

/// Surfaces around the origin, rough ones; `above`: without bumps, and all of the light above their horizon.
struct Surfaces {
    cases::Cases inputs;
    std::vector<double> diffuse, specular, least;  ///< radiance, and a share of what a surface that faces it would send
};

Surfaces surfaces(const Light& light, Where where, std::size_t count) {
    Surfaces out{{.name = "area light"}, {}, {}, {}};
    out.inputs.data.constants = constants_of(light);
    Lighting lighting;
    lighting.lights = {light};
    lighting.f0 = 0.0625;
    for (unsigned seed = 1; out.inputs.size() < count; ++seed) {
        cases::Random random(seed);
        const V p = random.box(1.5L), n = random.unit();
        V v = random.unit(), m = cases::Random::rounded(normalize(n + random.unit() * 0.5L));
        if (where == Where::above) m = n;
        if (dot(v, m) < 0) v = v * -1.0L;
        if (dot(v, m) < 0.1L) continue;
        const auto narrow = [](V a) { return normalize(D{double(a.x), double(a.y), double(a.z)}); };
        const D at{double(p.x), double(p.y), double(p.z)};
        bool crosses = false, lit = false;
        D all;
        reference::each_arrival<double>(light, at, [&](const reference::Arrival<double>& a) {
            crosses = crosses || dot(a.direction, narrow(n)) < 0.02, lit = lit || dot(a.direction, narrow(n)) > 0;
            all = all + a.direction * a.irradiance.x;
        });
        if (!lit || (where == Where::above && crosses)) continue;
        const real roughness = random.uniform(0.3L, 1);
        out.inputs.add("surface " + std::to_string(seed), true);
        out.inputs.in("p", p), out.inputs.in("n", n), out.inputs.in("m", m), out.inputs.in("v", v);
        out.inputs.in("roughness", roughness);
        const auto both = reference::lobes_by<double>("", lighting, narrow(n), narrow(m), narrow(v), at,
                                                      {{1, 1, 1}, double(roughness), 0.0625});
        out.diffuse.push_back(both.diffuse.x), out.specular.push_back(both.specular.x);
        out.least.push_back(0.02 * length(all) / M_PI);
    }
    return out;
}

const std::string light_it =
    "constant const wr_light *light = (constant const wr_light *)constants;\n"
    "wr_real one = 1;\n"
    "wr_lit_surface seen = wr_lit_surface_of(unit(n), unit(m), unit(v), wr_v3(one, one, one), roughness);\n"
    "wr_real diffuse = wr_add_area_light(wr_zero3(), *light, p, unit(v), seen, 0.0625f, 1, 0).x;\n"
    "wr_real specular = wr_add_area_light(wr_zero3(), *light, p, unit(v), seen, 0.0625f, 0, 1).x;";

/// Shares of the radiance of both lobes, or of a fiftieth of what a surface that faces the light sends, by which each
/// lobe is off; sorted.
struct Errors {
    std::vector<double> diffuse, specular;

    Errors(const Surfaces& of, int lanes) {
        const Results r =
            run_kernel({light_it, {"diffuse", "specular"}}, of.inputs.inputs, {lanes, false}, of.inputs.data);
        for (std::size_t i = 0; i < of.diffuse.size(); ++i) {
            const double all = of.diffuse[i] + of.specular[i] + of.least[i];
            diffuse.push_back(std::abs(double(r[0][i]) - of.diffuse[i]) / all);
            specular.push_back(std::abs(double(r[1][i]) - of.specular[i]) / all);
        }
        std::ranges::sort(diffuse), std::ranges::sort(specular);
    }
};

double share(const std::vector<double>& sorted, double part) {
    return sorted.at(static_cast<std::size_t>(part * static_cast<double>(sorted.size() - 1)));
}

struct LightCase {
    std::string name;
    Light light;
    double exact;           ///< bound of diffuse errors without bumps, above the horizon
    double median, p90;     ///< bounds of specular ones there
    double across, bumped;  ///< bounds of 90% of both, of surfaces with bumps and lights across their horizon
};

TEST(AreaLight, IsTheSumOfItsPoints) {
    // The exact ones of flat lights are those of brute force, and of an octagon in place of a disc.
    const std::vector<LightCase> lights{{"sun of half a degree", sun(0.53), 1e-6, 1e-6, 1e-4, 1e-3, 1e-3},
                                        {"sun of 20 degrees", sun(20), 1e-6, 5e-4, 5e-3, 0.1, 0.03},
                                        {"sphere", sphere(0.7), 2e-6, 5e-4, 5e-3, 0.1, 0.03},
                                        {"disc", disc(0.5), 1e-3, 5e-4, 5e-3, 0.1, 0.03},
                                        {"strip", rectangle(0.1, 3), 1e-3, 3e-3, 0.04, 0.1, 0.05},
                                        {"wall", rectangle(4, 3), 1e-3, 5e-3, 0.05, 0.1, 0.08}};
    for (const LightCase& c : lights) {
        const Surfaces plain = surfaces(c.light, Where::above, 160), any = surfaces(c.light, Where::anywhere, 160);
        for (const int lanes : lanes_to_try({1, 16})) {
            const Errors flat(plain, lanes), bumped(any, lanes);
            fmt::print(
                "{}, {} lanes: above, diffuse {:.1e}, specular {:.1e} {:.1e} {:.1e}; anywhere, diffuse {:.1e} {:.1e} "
                "{:.1e}, specular {:.1e} {:.1e} {:.1e}\n",
                c.name, lanes, flat.diffuse.back(), share(flat.specular, 0.5), share(flat.specular, 0.9),
                flat.specular.back(), share(bumped.diffuse, 0.5), share(bumped.diffuse, 0.9), bumped.diffuse.back(),
                share(bumped.specular, 0.5), share(bumped.specular, 0.9), bumped.specular.back());
            EXPECT_LE(flat.diffuse.back(), c.exact) << c.name;
            EXPECT_LE(share(flat.specular, 0.5), c.median) << c.name;
            EXPECT_LE(share(flat.specular, 0.9), c.p90) << c.name;
            EXPECT_LE(share(bumped.diffuse, 0.9), c.across) << c.name;
            EXPECT_LE(share(bumped.specular, 0.9), c.bumped) << c.name;
        }
    }
}

TEST(AreaLight, IsFiniteWhereverThePointIs) {
    const float far = 1e20f, near = 1e-20f;
    const Columns columns{{"p.x", {1, 1, far, near, 1, 1.2f}}, {"p.y", {0.5, 0.5, far, near, 0.5, 0.5}},
                          {"p.z", {3, 3, far, near, 2.9f, 3}}, {"n.x", {0, 0, 0, 0, 1, 0}},
                          {"n.y", {0, 0, 0, 0, 0, 0}},         {"n.z", {1, -1, 1, 1, 0, 1}},
                          {"m.x", {0, 0, 0, 0, 1, 0}},         {"m.y", {0, 0, 0, 0, 0, 0}},
                          {"m.z", {1, -1, 1, -1, 0, -1}},      {"v.x", {0, 0, 0, 0, 0, 0}},
                          {"v.y", {0, 0, 0, 0, 0, 0}},         {"v.z", {1, -1, 1, -1, -1, 1}},
                          {"roughness", {0, 0, 1, 0, 0, 0.5f}}};
    for (const Light& light : {sphere(0.3), disc(0.5), rectangle(1, 2), sun(0.01), sun(170)}) {
        ColumnData data;
        data.constants = constants_of(light);
        const Results r = run_kernel({light_it, {"diffuse", "specular"}}, columns, {1, false}, data);
        for (const auto& channel : r)
            for (std::size_t i = 0; i < channel.size(); ++i) {
                EXPECT_TRUE(std::isfinite(channel[i])) << "row " << i;
                EXPECT_GE(channel[i], 0) << "row " << i;
            }
    }
}

}  // namespace
}  // namespace wrinkle::test
