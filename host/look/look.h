#pragma once

#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "io/gbuffer_reader.h"
#include "resources/texture_store.h"
#include "run/condition.h"
#include "run/open_frame.h"
#include "run/pass_impl.h"
#include "tools/frame_lights.h"
#include "tools/metal_pictures.h"

namespace wrinkle {

using WholePlanes = std::map<std::string, std::vector<float>>;

/// A frame as a scene evaluates it. It is not changed once it is made, so that any thread may show it.
struct LookImage {
    Size size;
    std::shared_ptr<const WholePlanes> frame;       ///< planes of the G-buffer
    std::shared_ptr<const WholePlanes> unbumped{};  ///< lit by the scene's lights without any layer; null: not so lit
    WholePlanes out{};                              ///< what the scene's pass writes, and "condition" where wanted
    Relight relight = Relight::off;
    double exposure = 0;                             ///< stops
    std::map<std::uint32_t, std::string> objects{};  ///< Cryptomatte's names by id
    double kernel_seconds = 0;
    bool built = false;  ///< a pass was made for it, in place of new numbers for the last one
};

/// Numbers of one pixel, from the evaluation itself.
struct LookPixel {
    std::vector<std::pair<std::string, Vec3>> gradients;  ///< of each layer alone, on the frame's own surface
};

/// Evaluates one frame of a scene over and over, in memory, while layers are switched and numbers change. Frame,
/// textures and program stay as long as they can serve; a change of numbers alone compiles and reads nothing.
class [[gnu::visibility("hidden")]] Look {
public:
    explicit Look(Device device);

    /// Opens the frame anew. Throws Error, and then keeps the one that it had.
    void open(const Scene& scene, int frame);
    /// Reads them again when they are next needed.
    void forget_textures();

    /// `off`: layers, by their place, that are evaluated at a scale of 0. Throws Error.
    std::shared_ptr<const LookImage> evaluate(const Scene& scene, const std::set<std::size_t>& off, bool condition);

    /// Of the scene that was evaluated last, whatever was off. Throws Error.
    LookPixel pixel(std::uint32_t x, std::uint32_t y);

    const GBufferReader& reader() const { return *reader_; }
    const FrameCamera& camera() const { return camera_; }
    /// What looks wrong in textures that were read, a line each.
    const std::vector<std::string>& doubts() const { return store_->doubts(); }
    const Device& device() const { return device_; }

private:
    Scene prepared(const Scene& scene);
    bool take(std::optional<Pass> & pass, const Scene& scene);
    void read_missing(const std::vector<std::string>& names);
    WholePlanes run(Pass & pass);
    std::vector<float> condition(const Scene& scene);

    Device device_;
    std::unique_ptr<TextureStore> store_;
    std::unique_ptr<GBufferReader> reader_;
    FrameCamera camera_;
    int number_ = 0;
    std::optional<FoundLights> lights_;
    MetalPictures metals_;
    std::shared_ptr<WholePlanes> planes_;
    std::optional<Pass> pass_, bare_;  ///< of the scene; of its lights alone
    Frame pass_for_;
    Scene scene_;  ///< with all layers on
};

}  // namespace wrinkle
