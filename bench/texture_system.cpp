#include "texture_system.h"

#include <OpenImageIO/imagebufalgo.h>
#include <OpenImageIO/texture.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <cmath>

#include "io/texture_file.h"
#include "layout.h"
#include "resources/texture_heap.h"
#include "temporary_folder.h"

namespace wrinkle::bench {

namespace {

constexpr int kAnisotropy = 16;

/// The finest slopes that kernels sample, row 0 at t = 0, as a picture.
OIIO::ImageBuf finest_slopes(const TextureUse& use) {
    TextureHeap heap;
    add_texture(heap, load_bump(use), {use, TexelKind::slope, {}});
    const auto width = static_cast<int>(heap.table[WR_TEXTURE_WIDTH]),
               height = static_cast<int>(heap.table[WR_TEXTURE_HEIGHT]);
    OIIO::ImageBuf out(OIIO::ImageSpec(width, height, 2, OIIO::TypeFloat));
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            out.setpixel(x, y, &heap.texels[static_cast<std::size_t>(2 * ((y + 1) * (width + 2) + x + 1))]);
    return out;
}

void write_mips(const OIIO::ImageBuf& slopes, const std::string& file) {
    OIIO::ImageSpec config;
    config["maketx:filtername"] = "box";
    config.format = OIIO::TypeFloat;
    if (!OIIO::ImageBufAlgo::make_texture(OIIO::ImageBufAlgo::MakeTxTexture, slopes, file, config))
        throw Error("OpenImageIO makes no texture of slopes: " + OIIO::geterror());
}

/// Texture coordinates of a pixel of the ground, and their change to the right and down.
struct Lookup {
    float s, t, ds_dx, dt_dx, ds_dy, dt_dy;
};

std::vector<Lookup> lookups(const BenchFrame& frame) {
    const PinholeRays rays = pinhole_rays(frame.frame.camera, frame.frame.size).value();
    const auto &depth = frame.planes.at("depth"), &u = frame.planes.at("uv.u"), &v = frame.planes.at("uv.v");
    std::vector<Lookup> out(depth.size());
    for (std::size_t i = 0; i < out.size(); ++i) {
        if (depth[i] > 1e9f) continue;
        const double x = static_cast<double>(i % frame.frame.size.width) + 0.5,
                     y = static_cast<double>(i / frame.frame.size.width) + 0.5;
        Vec3 d{};
        for (std::size_t k = 0; k < 3; ++k) d[k] = rays.d0[k] + x * rays.dx[k] + y * rays.dy[k];
        const auto change = [&](const Vec3& step, std::size_t k) {  // of the point on the plane z = 0
            return static_cast<float>(depth[i] * (step[k] - d[k] * step[2] / d[2]) / kGroundRepeat);
        };
        out[i] = {u[i], v[i], change(rays.dx, 0), change(rays.dx, 1), change(rays.dy, 0), change(rays.dy, 1)};
    }
    return out;
}

}  // namespace

struct TextureSystemSlopes::State {
    TemporaryFolder folder;
    std::unique_ptr<OIIO::TextureSystem, void (*)(OIIO::TextureSystem*)> system{
        OIIO::TextureSystem::create(false), [](OIIO::TextureSystem* s) { OIIO::TextureSystem::destroy(s); }};
    OIIO::TextureSystem::TextureHandle* texture = nullptr;
    std::vector<Lookup> pixels;
    std::vector<std::array<float, 2>> slopes;
    double scale = 1;
};

TextureSystemSlopes::TextureSystemSlopes(const TextureUse& use, double scale, const BenchFrame& frame)
    : state_(std::make_unique<State>()) {
    const std::string file = state_->folder.path() / "slopes.exr";
    write_mips(finest_slopes(use), file);
    state_->texture = state_->system->get_texture_handle(OIIO::ustring(file));
    state_->pixels = lookups(frame);
    state_->slopes.resize(state_->pixels.size());
    state_->scale = scale;
}

TextureSystemSlopes::~TextureSystemSlopes() = default;
TextureSystemSlopes::TextureSystemSlopes(TextureSystemSlopes&&) noexcept = default;

void TextureSystemSlopes::run() {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, state_->pixels.size(), 1024), [this](const auto& range) {
        OIIO::TextureSystem::Perthread* thread = state_->system->get_perthread_info();
        OIIO::TextureOpt options;
        options.swrap = options.twrap = OIIO::TextureOpt::WrapPeriodic;
        options.anisotropic = kAnisotropy;
        for (std::size_t i = range.begin(); i < range.end(); ++i) {
            const Lookup& at = state_->pixels[i];
            state_->system->texture(state_->texture, thread, options, at.s, at.t, at.ds_dx, at.dt_dx, at.ds_dy,
                                    at.dt_dy, 2, state_->slopes[i].data());
        }
    });
}

std::vector<std::array<double, 3>> TextureSystemSlopes::normals() const {
    std::vector<std::array<double, 3>> out;
    for (const auto& slope : state_->slopes) {
        const double x = -state_->scale * slope[0], y = -state_->scale * slope[1], size = std::hypot(x, y, 1.0);
        out.push_back({x / size, y / size, 1 / size});
    }
    return out;
}

}  // namespace wrinkle::bench
