// surface/screen_derivative.clh
#include "tests/cases/screen_derivative.h"

#include "tests/kernels/check.h"

namespace wrinkle::test {
namespace {

const std::vector<std::string> includes{"surface/gbuffer.clh", "surface/screen_derivative.clh"};

/// Relative errors may grow as 1 / |cos(n, ray)|, angles otherwise: rows have an allowance for each.
void check_derivatives(cases::FrameCases c, const std::string& call) {
    const double relative = cases::screen_derivative_relative;
    KernelData data;
    data.constants = std::move(c.frames);
    data.constants_per_row = sizeof(wr_frame) / sizeof(double);
    const std::string body =
        "constant const wr_frame *frame = (constant const wr_frame *)constants;\nvec3 dx, dy;\n" + call;
    // In double the golden answers differ by what rounding the eye-relative position to float costs.
    std::vector<Answer> answers;
    for (const char* axis : {"dx", "dy"}) {
        answers.push_back({std::string("dp_") + axis, xyz(axis), Metric::relative, relative, relative, 1e-12});
        answers.push_back({std::string("golden_") + axis, xyz(axis), Metric::relative, relative, relative, relative});
    }
    check(c.cases, includes, body, answers, data);
    c.cases.allowance = c.angle_allowance;
    for (Answer& answer : answers) {
        const bool golden = answer.name.starts_with("golden");
        answer.metric = Metric::angle;
        answer.regular = answer.hard = cases::screen_derivative_degrees;
        answer.fp64 = golden ? cases::screen_derivative_degrees : 1e-10;
    }
    check(c.cases, includes, body, answers, data);
}

TEST(ScreenDerivative, GeneralForm) {
    check_derivatives(cases::screen_derivative_cases(false),
                      "wr_screen_derivatives_general(frame, unit(n), p, x, y, &dx, &dy);");
}

TEST(ScreenDerivative, PinholeForm) {
    check_derivatives(cases::screen_derivative_cases(true),
                      "vec3 d = wr_ray(frame, x, y);\n"
                      "wr_screen_derivatives(frame, unit(n), d, wr_along_ray(p, d), x, y, &dx, &dy);");
}

}  // namespace
}  // namespace wrinkle::test
