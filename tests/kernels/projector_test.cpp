// sources/projector.clh followed by the projection onto the surface. (functions_test.cpp tests its functions one by
// one.)
#include "tests/cases/decal.h"

#include "tests/kernels/check.h"

namespace wrinkle::test {
namespace {

TEST(Projector, SurfaceGradient) {
    check(cases::projector_golden_cases(),
          "global const wr_projector *decal = (global const wr_projector *)records;\n"
          "wr_vec3 g = wr_projector_blend(decal, wr_project(decal, p), slope, weight, wr_zero3());\n"
          "wr_vec3 s = wr_surface_gradient_from_volume(unit(n), g);",
          {{"sg", xyz("s"), ErrorMeasure::relative, 4e-7, 4e-7, 1e-9}});
}

TEST(Projector, LinesThatMayCrossABox) {
    cases::Cases c{.name = "lines across a box"};
    wr_projector box{};
    cases::put(box.center, {1, 0, 0});
    cases::put(box.to_box_x, {2, 0, 0}), cases::put(box.to_box_y, {0.25L, 0.5L, 0}),
        cases::put(box.to_box_z, {0, 0, 4});
    const auto* numbers = reinterpret_cast<const double*>(&box);
    c.data.records.assign(numbers, numbers + sizeof box / sizeof(double));
    for (unsigned seed = 1; seed <= 2000; ++seed) {
        cases::Random random(seed);
        const V p = random.box(4), step = random.box(2);
        const real begin = random.uniform(-2, 0), end = random.uniform(0, 2);
        const auto in_box = [](const V& at) {
            return std::max({std::abs(2 * (at.x - 1)), std::abs(0.25L * (at.x - 1) + 0.5L * at.y), std::abs(4 * at.z)});
        };
        real nearest = 1e9L;
        for (int i = 0; i <= 2000; ++i)
            nearest = std::min(nearest, in_box(p + step * (begin + (end - begin) * i / 2000)));
        c.add("line, seed " + std::to_string(seed), false);
        c.in("p", p), c.in("step", step), c.in("begin", begin), c.in("end", end);
        c.in("crosses", nearest < 0.99L ? 1 : 0);
        c.out("missed", real{0});
    }
    // Of lines that cross no box, the axes of the box tell most: those that pass a corner they do not.
    check(c,
          "global const wr_projector *decal = (global const wr_projector *)records;\n"
          "wr_mask may = wr_may_cross_box(decal, p, step, begin, end);\n"
          "wr_real missed = (crosses > 0) & !may ? (wr_real)(1) : (wr_real)(0);",
          {{"missed", {"missed"}, ErrorMeasure::absolute, 0, 0, 0}});
}

}  // namespace
}  // namespace wrinkle::test
