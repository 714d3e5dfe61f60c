#include "io/grid_bytes.h"

#include <fmt/format.h>

#include <cstdint>
#include <cstring>
#include <type_traits>

#include "wrinkle/error.h"

namespace wrinkle::io {
namespace {

constexpr std::uint32_t kGrid = 0x64697267, kFailure = 0x6c696166;  // "grid", "fail"

class Packer {
public:
    template <class T>
    void put(const T& value) {
        static_assert(std::is_trivially_copyable_v<T>);
        bytes_.append(reinterpret_cast<const char*>(&value), sizeof value);
    }

    template <class List>
    void put_list(const List& list) {
        using T = typename List::value_type;
        static_assert(std::is_trivially_copyable_v<T>);
        put(std::uint64_t{list.size()});
        bytes_.append(reinterpret_cast<const char*>(list.data()), list.size() * sizeof(T));
    }

    std::string take() { return std::move(bytes_); }

private:
    std::string bytes_;
};

class Unpacker {
public:
    Unpacker(std::span<const std::byte> bytes, const std::string& file) : rest_(bytes), file_(file) {}

    template <class T>
    void get(T& value) {
        take(&value, 1, sizeof value);
    }

    template <class List>
    void get_list(List& list) {
        std::uint64_t size = 0;
        get(size);
        if (size > rest_.size() / sizeof(typename List::value_type)) damaged();
        list.resize(size);
        take(list.data(), size, sizeof(typename List::value_type));
    }

    [[noreturn]] void damaged() const {
        throw Error(
            fmt::format("{}: cannot be read: OpenVDB did not come to an end; it may be truncated or damaged", file_));
    }

    bool empty() const { return rest_.empty(); }

private:
    void take(void* to, std::uint64_t count, std::size_t size) {
        if (count > rest_.size() / size) damaged();
        if (count != 0) std::memcpy(to, rest_.data(), count * size);
        rest_ = rest_.subspan(count * size);
    }

    std::span<const std::byte> rest_;
    const std::string& file_;
};

}  // namespace

std::string pack_grid(const RawVolume& raw, const std::string& name) {
    Packer out;
    out.put(kGrid);
    out.put_list(name);
    out.put(std::int32_t{raw.channels});
    out.put(std::int32_t{raw.affine});
    out.put(raw.world_from_index);
    out.put(raw.background);
    out.put_list(raw.tiles);
    out.put_list(raw.leaves);
    out.put_list(raw.voxels);
    return out.take();
}

std::string pack_failure(const std::string& message) {
    Packer out;
    out.put(kFailure);
    out.put_list(message);
    return out.take();
}

std::pair<RawVolume, std::string> unpack_grid(std::span<const std::byte> bytes, const std::string& file) {
    Unpacker in(bytes, file);
    std::uint32_t kind = 0;
    in.get(kind);
    std::string text;
    in.get_list(text);
    if (kind == kFailure) throw Error(text);
    RawVolume raw;
    std::int32_t channels = 0, affine = 0;
    in.get(channels), in.get(affine);
    raw.channels = channels, raw.affine = affine != 0;
    in.get(raw.world_from_index);
    in.get(raw.background);
    in.get_list(raw.tiles);
    in.get_list(raw.leaves);
    in.get_list(raw.voxels);
    const bool fits =
        (channels == 1 || channels == 3) &&
        raw.voxels.size() == raw.leaves.size() * Volume::block_voxels * static_cast<std::size_t>(channels);
    if (kind != kGrid || !in.empty() || !(fits || raw.voxels.empty())) in.damaged();
    if (raw.voxels.empty()) raw.leaves.clear();
    for (const RawVolume::Tile& tile : raw.tiles)
        for (std::size_t k = 0; k < 3; ++k)
            if (tile.first[k] > tile.last[k]) in.damaged();
    return {std::move(raw), std::move(text)};
}

}  // namespace wrinkle::io
