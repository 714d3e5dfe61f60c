// sources/noise.clh
#include "tests/cases/noise.h"

#include "tests/kernels/check.h"

namespace wrinkle::test {
namespace {

TEST(Noise, ValueAndGradient) {
    check(cases::noise_cases(), {"sources/noise_table.clh", "sources/noise.clh"},
          "wr_noise_value v = wr_perlin_noise(p);",
          {{"value", {"v.value"}, Metric::absolute, cases::noise_value_absolute, cases::noise_value_absolute},
           {"gradient", xyz("v.gradient"), Metric::absolute, cases::noise_gradient_absolute,
            cases::noise_gradient_absolute}},
          {}, INFINITY);
}

TEST(Noise, LanesAgree) {
    const cases::Cases c = cases::noise_cases();
    const KernelFunction f{{"sources/noise_table.clh", "sources/noise.clh"},
                           "wr_noise_value v = wr_perlin_noise(p);",
                           {"v.value", "v.gradient.x", "v.gradient.y", "v.gradient.z"}};
    const Results eight = run_kernel(f, c.inputs, {8, false});
    for (const int lanes : {1, 4, 16}) {
        const Results other = run_kernel(f, c.inputs, {lanes, false});
        for (std::size_t k = 0; k < eight.size(); ++k)
            for (std::size_t row = 0; row < c.size(); ++row)
                EXPECT_NEAR(other[k][row], eight[k][row], 1e-6) << f.outputs[k] << ", " << c.labels[row];
    }
}

}  // namespace
}  // namespace wrinkle::test
