// shade/metal.clh
#include "tests/reference/metal.h"

#include "tests/kernels/check.h"

namespace wrinkle::test {
namespace {

TEST(Metal, ShowsWhatItsPictureDoesOfADirection) {
    MetalPicture picture;
    for (std::size_t k = 0; k < picture.seen.size(); ++k) {
        const double at = static_cast<double>(k);
        picture.seen[k] = {1.5 + std::sin(at / 5), 1.5 + std::cos(at / 70), 1.5 + std::sin(at / 11)};
    }
    cases::Cases c{.name = "metal picture"};
    for (const Vec3& colour : picture.seen)
        c.data.constants.insert(c.data.constants.end(), colour.begin(), colour.end());
    for (unsigned seed = 1; seed <= 200; ++seed) {
        const V l = cases::Random(seed).unit();
        c.add("seed " + std::to_string(seed), false);
        c.in("l", l), c.out("seen", reference::metal_seen(picture, normalize(l)));
    }
    check(c, "wr_vec3 seen = wr_metal_seen(constants, unit(l));",
          {{"seen", xyz("seen"), ErrorMeasure::absolute, 1e-4, 1e-4, 1e-11}});
}

}  // namespace
}  // namespace wrinkle::test
