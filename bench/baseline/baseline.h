#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "wrinkle/camera.h"
#include "wrinkle/error.h"
#include "wrinkle/scene.h"

/// The layers as a good programmer writes them in plain C++ from the listings of [Mik20]: float, float3 structs, one
/// pixel at a time, OpenMP over rows, -O3 -march=native -ffast-math. Formulas and clamps are the published ones.
/// The kernels are compared with this, so it is made fast by every means that leaves it readable: constants computed
/// once per scene, textures stored as slopes, padded mips, no work where a mask is zero. It is not vectorised by hand.
namespace wrinkle::baseline {

/// Thrown for a layer that has no plain C++ form.
struct Unsupported : Error {
    using Error::Error;
};

struct Image {
    int width = 0, height = 0, channels = 0;
    std::vector<float> texels;  ///< rows bottom first, channels interleaved, [0,1]
};

/// Planes by name as in wrinkle/gbuffer.h, one float per pixel.
using PlaneMap = std::map<std::string, std::span<const float>>;

class Evaluator {
public:
    /// Prepares everything that does not depend on the pixels. `textures`: by the file names used in the scene.
    /// `cryptomatte`: hashes by object name; names written as "#" and 8 hex digits need no entry. Throws Error when a
    /// texture or hash is missing, Unsupported when there is no plain C++ form of a layer.
    Evaluator(const Scene& scene, Size size, const Camera& camera,
              const std::map<std::filesystem::path, Image>& textures,
              const std::map<std::string, std::uint32_t>& cryptomatte = {});
    ~Evaluator();
    Evaluator(Evaluator&&) noexcept;
    Evaluator& operator=(Evaluator&&) noexcept;

    /// Writes the new normals of a frame. Where the scene does not say what kind of depth it has, depth is planar.
    /// Throws Error when a plane is missing or not of the frame's size.
    void run(const PlaneMap& planes, std::span<float> nx, std::span<float> ny, std::span<float> nz) const;

private:
    struct Prepared;
    std::unique_ptr<const Prepared> prepared_;
};

struct ConstPlanes {
    std::span<const float> x, y, z;
};
struct Planes {
    std::span<float> x, y, z;
};

/// out = normalize(n - g): 24 bytes read and 12 written per pixel, and hardly any arithmetic.
void resolve(ConstPlanes n, ConstPlanes g, Planes out);

/// The same with stores that bypass the cache, where the machine has AVX. Planes must be aligned to 32 bytes.
void resolve_streaming(ConstPlanes n, ConstPlanes g, Planes out);

/// out = a + 3 b as in the STREAM benchmark, with stores that bypass the cache: 8 bytes read and 4 written per pixel.
void triad_streaming(std::span<const float> a, std::span<const float> b, std::span<float> out);

}  // namespace wrinkle::baseline
