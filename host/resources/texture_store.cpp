#include "resources/texture_store.h"

#include <algorithm>

#include "base/limits.h"
#include "resources/texture_heap.h"

namespace wrinkle {

namespace {

bool same_texels(const PlannedTexture& a, const PlannedTexture& b) {
    return a.kind == b.kind && a.use == b.use && a.grid == b.grid && a.region == b.region && a.levels == b.levels &&
           a.products == b.products;
}

template <class T>
cl::Buffer upload(const Device& device, std::vector<T> values) {
    if (values.empty()) values.resize(1);  // OpenCL has no empty buffers
    return {device.context, CL_MEM_READ_ONLY | CL_MEM_COPY_HOST_PTR, values.size() * sizeof(T), values.data()};
}

}  // namespace

std::shared_ptr<const DeviceTextures> TextureStore::get(const std::vector<PlannedTexture>& wanted) {
    const auto known = std::ranges::find_if(
        entries_, [&](const Entry& entry) { return std::ranges::equal(entry.planned, wanted, same_texels); });
    if (known != entries_.end()) {
        known->used = true;
        return known->textures;
    }
    TextureHeap heap = load_textures(wanted);
    check_fits(heap, device_.info);
    if (device_.info.type == "cpu")
        check_memory("the scene", static_cast<double>(heap.texels.size() * sizeof(float)),
                     "the device's copy of all textures and volumes");
    for (std::string& doubt : heap.doubts)
        if (std::ranges::find(doubts_, doubt) == doubts_.end()) doubts_.push_back(std::move(doubt));
    auto textures = std::make_shared<const DeviceTextures>(
        DeviceTextures{upload(device_, std::move(heap.texels)), upload(device_, std::move(heap.table))});
    entries_.push_back({wanted, textures});
    ++loads_;
    return textures;
}

void TextureStore::keep_latest() {
    std::erase_if(entries_, [](const Entry& entry) { return !entry.used; });
    for (Entry& entry : entries_) entry.used = false;
}

}  // namespace wrinkle
