// Bumps with the renderer's tangents, against the normal that mikkTSpace maps are baked for.
#include "tests/cases/mikktspace.h"
#include "tests/kernels/check.h"

namespace wrinkle::test {
namespace {

class MikkTSpace : public testing::TestWithParam<std::string> {};

TEST_P(MikkTSpace, SurfaceGradientsDecodeAsTheStandardDoes) {
    check(cases::mikktspace_cases(GetParam()),
          "wr_tangents f = wr_vertex_frame(n, tangent, tangent_sign);\n"
          "wr_vec3 g = wr_surface_gradient_from_tbn(wr_tangent_normal_slope(m), f);\n"
          "wr_vec3 normal = wr_resolve(wr_normalize(n), g);",
          {{"normal", xyz("normal"), ErrorMeasure::degrees, 2e-5, 2e-5}});
}

INSTANTIATE_TEST_SUITE_P(Meshes, MikkTSpace,
                         testing::Values("mikktspace_torus_degenerate_tris", "mikktspace_torus_mirrored_uv_tris",
                                         "mikktspace_torus_quads"),
                         [](const auto& info) { return info.param; });

TEST(VertexFrame, TakesABitangentThatIsGiven) {
    cases::Cases c = cases::mikktspace_cases("mikktspace_torus_mirrored_uv_tris");
    for (std::size_t i = 0; i < c.size(); ++i) {
        const V n = c.vec(i, "n"), tangent = c.vec(i, "tangent");
        const V bitangent = cases::Random::rounded(cross(n, tangent) * real{c.inputs.at("tangent_sign")[i]});
        c.in("bitangent", bitangent);
        c.out("B", bitangent / length(n));
    }
    check(c, "wr_tangents f = wr_vertex_frame(n, tangent, bitangent);",
          {{"B", xyz("f.b"), ErrorMeasure::relative, 4e-7, 4e-7}});
}

}  // namespace
}  // namespace wrinkle::test
