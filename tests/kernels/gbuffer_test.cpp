// surface/gbuffer.clh
#include <gtest/gtest.h>

#include "resources/frame_constants.h"
#include "tests/kernels/check.h"
#include "tests/reference/resolve.h"

namespace wrinkle::test {
namespace {

constexpr float inf = INFINITY, nan = NAN, tiny = 1e-45f, huge = 3.4e38f;

TEST(GBuffer, ValidityIsDecidedFromBits) {
    const std::vector<float> numbers{0, -0.0f, tiny, 1e-38f, 1, -1, 0.999e9f, 1e9f, 1e10f, huge, inf, -inf, nan};
    Columns columns;
    std::vector<double> depth, normal;
    for (const float a : numbers)
        for (const float b : numbers) {
            columns["a"].push_back(a), columns["b"].push_back(b);
            const auto gone = [](float v) { return std::abs(v) < std::numeric_limits<float>::min(); };
            depth.push_back(std::isfinite(a) && !gone(a) && a > 0 && a < 1e9f);
            normal.push_back(std::isfinite(a) && std::isfinite(b) && !(gone(a) && gone(b)));
        }
    const ColumnData planes = float_planes({columns["a"], columns["b"]});
    for (const bool fp64 : precisions_to_try())
        for (const int lanes : lanes_to_try()) {
            const Results r = run_kernel(
                {"wr_floats fa = wr_load_floats(texels, at), fb = wr_load_floats(texels + stride, at), zero = 0;",
                 {"truth(wr_valid_depth(fa))", "truth(wr_valid_normal(fa, fb, zero))",
                  "truth(wr_valid_normal(zero, fa, fb))", "truth(wr_valid_position(fa, fb, zero))",
                  "wr_to_real(wr_valid_or(fa, wr_finite(fa), 7))"}},
                columns, {lanes, fp64}, planes);
            for (std::size_t i = 0; i < depth.size(); ++i) {
                const float a = columns["a"][i], b = columns["b"][i];
                const std::string row = fmt::format("{}, {} on {} lanes", a, b, lanes);
                EXPECT_EQ(r[0][i], depth[i]) << row;
                EXPECT_EQ(r[1][i], normal[i]) << row;
                EXPECT_EQ(r[2][i], normal[i]) << row;
                EXPECT_EQ(r[3][i], std::isfinite(a) && std::isfinite(b)) << row;
                EXPECT_EQ(r[4][i], std::isfinite(a) ? double{a} : 7) << row;
            }
        }
}

/// The pixels of a work-item have the right coordinates in rows of any width, also narrower than the lanes, and in
/// bands that do not start at row 0.
TEST(GBuffer, PixelsOfAWorkItem) {
    for (const int width : {1, 2, 3, 7, 16, 31, 97}) {
        const std::size_t pixels = static_cast<std::size_t>(width) * 11;
        const Columns columns{{"nothing", std::vector<float>(pixels)}};
        ColumnData data;
        data.constants = {static_cast<double>(width)};
        for (const bool fp64 : precisions_to_try())
            for (const int lanes : lanes_to_try()) {
                const Results r = run_kernel(
                    {"wr_pixels px = wr_pixels_of(get_global_id(0), 50, 20, (uint)constants[0]);",
                     {"px.x", "px.y", "(wr_real)((WR_SCALAR)(px.in - at))", "(wr_real)((WR_SCALAR)(px.out - at))"}},
                    columns, {lanes, fp64}, data);
                for (std::size_t i = 0; i < pixels; ++i) {
                    ASSERT_EQ(r[0][i], static_cast<double>(i % width) + 0.5) << i << " of " << width << ", " << lanes;
                    ASSERT_EQ(r[1][i], static_cast<double>(i / width) + 20.5) << i << " of " << width << ", " << lanes;
                    ASSERT_EQ(r[2][i], 50);
                    ASSERT_EQ(r[3][i], 0);
                }
            }
    }
}

cases::Cases face_viewer_cases() {
    cases::Cases c{.name = "face the viewer"};
    for (unsigned seed = 1; seed <= 400; ++seed) {
        cases::Random random(seed);
        const bool hard = seed % 2 == 0;
        const V n = random.unit();
        V p = random.unit() * (hard ? random.magnitude(-30, 30) : random.magnitude(-1, 2));
        if (seed % 4 == 0) p = (cross(n, random.unit()) + n * random.magnitude(-6, -2)) * random.magnitude(-3, 3);
        p = cases::Random::rounded(p);
        const real along = dot(normalize(n), normalize(p));
        if (std::abs(along) < 3e-7L) continue;  // rounding decides: either answer is right
        c.add("face the viewer, seed " + std::to_string(seed), hard);
        c.in("n", n), c.in("p", p);
        c.out("normal", reference::face_viewer(normalize(n), normalize(-p)));
        c.out("away", real(along > 0));
    }
    return c;
}

TEST(GBuffer, NormalsFaceTheViewer) {
    const cases::Cases c = face_viewer_cases();
    check(c,
          "wr_mask away;\n"
          "wr_vec3 r = wr_face_viewer(unit(n), p, &away);",
          {{"normal", xyz("r"), ErrorMeasure::degrees, 2e-5, 2e-5},
           {"away", {"truth(away)"}, ErrorMeasure::absolute, 0, 0, 0}});
}

/// With an eye 1e6 metres away, a position relative to the eye is exact to an ulp of itself, not of the eye's
/// coordinates.
TEST(GBuffer, PositionsRelativeToTheEye) {
    cases::Cases c{.name = "positions"};
    wr_camera frame{};
    const V eye{1234567.8901L, -54321.0625L, 3.14159265L}, d0{-0.5L, 0.25L, -1}, dx{0.001L, 0, 0},
        dy{0, -0.002L, 1e-5L};
    const V forward{0.6L, 0, -0.8L};
    const auto put = [](double(&to)[3], V v) { to[0] = double(v.x), to[1] = double(v.y), to[2] = double(v.z); };
    put(frame.eye_high, cases::Random::rounded(eye));
    put(frame.eye_low, eye - cases::Random::rounded(eye));
    put(frame.d0, d0), put(frame.dx, dx), put(frame.dy, dy), put(frame.forward, forward);
    for (unsigned seed = 1; seed <= 200; ++seed) {
        cases::Random random(seed);
        const V world = cases::Random::rounded(eye + random.unit() * random.magnitude(-1, 4));
        const real x = random.below(4096) + 0.5L, y = random.below(2160) + 0.5L, depth = random.magnitude(-1, 4);
        c.add("position, seed " + std::to_string(seed), false);
        c.in("P", world), c.in("x", x), c.in("y", y), c.in("depth", depth);
        c.out("relative", world - eye), c.out("ray", d0 + dx * x + dy * y);
        c.out("parallel", d0 + dx * x + dy * y + forward * depth);
    }
    const double* first = &frame.width;
    c.data.constants.assign(first, first + sizeof frame / sizeof(double));
    check(c, "constant const wr_camera *camera = (constant const wr_camera *)constants;",
          {{"relative",
            {"wr_eye_relative(camera, P).x", "wr_eye_relative(camera, P).y", "wr_eye_relative(camera, P).z"},
            ErrorMeasure::relative,
            1.2e-7,
            0,
            1e-9},
           {"ray",
            {"wr_ray(camera, x, y).x", "wr_ray(camera, x, y).y", "wr_ray(camera, x, y).z"},
            ErrorMeasure::relative,
            3e-7,
            0},
           {"parallel",
            {"wr_parallel_position(camera, x, y, depth).x", "wr_parallel_position(camera, x, y, depth).y",
             "wr_parallel_position(camera, x, y, depth).z"},
            ErrorMeasure::relative,
            5e-7,
            0}});
}

/// Steps to a neighbouring pixel are exact to the rounding of their own terms, also when they are as short as a ten
/// thousandth of the distance.
TEST(GBuffer, StepsToNeighbours) {
    cases::Cases c{.name = "steps"};
    for (unsigned seed = 1; seed <= 400; ++seed) {
        cases::Random random(seed);
        const bool hard = seed % 2 == 0;
        const V ray = cases::Random::rounded(V{random.uniform(-1, 1), random.uniform(-1, 1), -1});
        const V along = random.unit() * random.magnitude(hard ? -6 : -4, -2);
        const real from = random.magnitude(-2, 5);
        const real to = static_cast<float>(from * (1 + random.uniform(-1, 1) * random.magnitude(hard ? -7 : -4, -2)));
        const V next = ray + cases::Random::rounded(along);
        const real terms = std::abs(to - from) * length(ray) + to * length(along);
        c.add("steps, seed " + std::to_string(seed), hard, terms);
        c.in("ray", ray), c.in("along", along), c.in("from", from), c.in("to", to);
        c.out("planar", next * to - ray * from), c.out("distant", normalize(next) * to - normalize(ray) * from);
    }
    check(c, "wr_vec3 a = wr_planar_step(ray, along, from, to), b = wr_distant_step(ray, along, from, to);",
          {{"planar", xyz("a"), ErrorMeasure::absolute, 3e-7, 3e-7},
           {"distant", xyz("b"), ErrorMeasure::absolute, 6e-7, 6e-7}});
}

/// As pairs of floats, positions have about twice as many digits.
TEST(GBuffer, PositionsInPairs) {
    wr_camera frame{};
    const V eye{1234567.8901L, -54321.0625L, 3.14159265L}, d0{-0.51L, 0.27L, -1.1L}, dx{0.0013L, 1e-4L, 0},
        dy{0, -0.0021L, 1e-5L};
    const auto put = [](double(&to)[3], V v) { to[0] = double(v.x), to[1] = double(v.y), to[2] = double(v.z); };
    put(frame.eye_high, cases::Random::rounded(eye));
    put(frame.eye_low, eye - cases::Random::rounded(eye));
    put(frame.d0, d0), put(frame.dx, dx), put(frame.dy, dy);
    split_constants(frame);
    Columns columns;
    std::vector<std::array<V, 3>> want;
    for (unsigned seed = 1; seed <= 200; ++seed) {
        cases::Random random(seed);
        const V world = cases::Random::rounded(eye + random.unit() * random.magnitude(-1, 4));
        const real x = random.below(4096) + 0.5L, y = random.below(2160) + 0.5L, depth = random.magnitude(-1, 4);
        const real row[] = {world.x, world.y, world.z, x, y, depth};
        const char* const names[] = {"P.x", "P.y", "P.z", "x", "y", "depth"};
        for (std::size_t k = 0; k < 6; ++k) columns[names[k]].push_back(static_cast<float>(row[k]));
        const V ray = d0 + dx * x + dy * y;
        want.push_back({ray * depth, reference::normalize(ray) * depth, world - eye});
    }
    ColumnData data;
    data.constants.assign(&frame.width, &frame.width + sizeof frame / sizeof(double));
    ColumnKernel kernel{
        "constant const wr_camera *camera = (constant const wr_camera *)constants;\n"
        "wr_pair3 a = wr_position_pairs(camera, x, y, depth), b = wr_distant_position_pairs(camera, x, y, depth);\n"
        "wr_pair3 c = wr_eye_relative_pairs(camera, P);",
        {}};
    for (const char* name : {"a", "b", "c"})
        for (const char* part : {"high", "low"})
            for (const char axis : {'x', 'y', 'z'}) kernel.outputs.push_back(fmt::format("{}.{}.{}", name, axis, part));
    for (const int lanes : lanes_to_try()) {
        const Results got = run_kernel(kernel, columns, {lanes, false}, data);
        for (std::size_t i = 0; i < want.size(); ++i)
            for (std::size_t k = 0; k < 3; ++k) {
                const V sum = cases::value_at(got, 6 * k, 3, i) + cases::value_at(got, 6 * k + 3, 3, i);
                const double off = double(reference::length(sum - want[i][k]));
                EXPECT_LE(off, k == 2 ? 5e-9 : 1e-12 * double(reference::length(want[i][k])))
                    << "position " << k << ", seed " << i + 1 << " on " << lanes << " lanes";
            }
    }
}

}  // namespace
}  // namespace wrinkle::test
