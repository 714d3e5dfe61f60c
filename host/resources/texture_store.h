#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "plan/plan.h"
#include "wrinkle/device.h"

namespace wrinkle {

/// Textures and volumes of a plan on a device, as kernels take them.
struct DeviceTextures {
    cl::Buffer texels, table;
};

/// Loads textures and volumes once for all passes of a run that want the same ones: a pass, the one in double that it
/// is measured against, the one that a budget raises it to.
class TextureStore {
public:
    explicit TextureStore(const Device& device) : device_(device) {}

    /// They stay on the device while the store, or somebody else, holds them. Throws Error naming the layer whose file
    /// cannot be used, or the sizes where they do not fit into one buffer.
    std::shared_ptr<const DeviceTextures> get(const std::vector<PlannedTexture>& wanted);

    /// Forgets what get() did not give since this was called last, so that memory does not grow with a sequence.
    void keep_latest();

    /// How often files were read.
    std::size_t loads() const { return loads_; }

    /// What looks wrong in the files that were read, a line each.
    const std::vector<std::string>& doubts() const { return doubts_; }

private:
    struct Entry {
        std::vector<PlannedTexture> planned;
        std::shared_ptr<const DeviceTextures> textures;
        bool used = true;
    };

    Device device_;
    std::vector<Entry> entries_;
    std::size_t loads_ = 0;
    std::vector<std::string> doubts_;
};

}  // namespace wrinkle
