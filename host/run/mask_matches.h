#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <unordered_map>
#include <vector>

#include "io/object_ids.h"
#include "wrinkle/passes.h"

namespace wrinkle {

/// Finds out, while the planes of frames are read, which objects that masks and decals name no pixel shows.
class MaskMatches {
public:
    /// Takes what the scene's masks and tables of decals name, but inverted masks, which may well match nothing.
    explicit MaskMatches(const Scene& scene);

    /// Whether both were made for the same names and layers, so that one will do.
    bool looks_for_the_same(const MaskMatches& other) const;

    /// The frame whose rows come next; its Cryptomatte has a hash for every name of the scene. `objects`: how it holds
    /// object numbers.
    void begin(const Frame& frame, io::ObjectStorage objects = io::ObjectStorage::single);
    /// Pixels as they were read; of the planes, only object and crypto.* are looked at.
    void see(const std::map<std::string, const float*>& planes, std::size_t pixels);
    /// A line for each layer that names objects which no pixel of any frame showed, with what the frames show; and one
    /// if many pixels mix objects, or nothing tells which of several is in front.
    std::vector<std::string> warnings() const;

private:
    struct Wanted {
        std::size_t layer = 0;
        std::string name{};  ///< Cryptomatte; empty: an index
        double index = 0;
        std::string place{};  ///< the first row that names it; empty: the layer's mask
        bool seen = false;
    };
    /// Labels of pixels by their bits: object indices, or ids of Cryptomatte.
    struct Labels {
        std::unordered_map<std::uint32_t, std::vector<std::size_t>> unseen{};  ///< indices into wanted_, by label
        std::vector<std::uint32_t> shown{};                                    ///< the first ones of the frames
        bool more = false;                                                     ///< than those
    };

    void add(const Mask& mask, std::size_t layer);
    void look(Labels& labels, const float* values, const float* coverages, std::size_t pixels);
    double number_of(std::uint32_t label) const;
    std::vector<std::string> warnings_of_pixels() const;
    std::string shown(const Labels& labels, bool names) const;

    std::vector<std::string> layers_;  ///< labels
    std::vector<Wanted> wanted_;
    Labels objects_, ids_;
    std::map<std::uint32_t, std::string> names_;  ///< of ids, as the frames know them
    io::ObjectStorage storage_ = io::ObjectStorage::single;
    std::uint64_t object_pixels_ = 0, mixed_pixels_ = 0;
    std::uint64_t front_pixels_ = 0, unknown_pixels_ = 0;  ///< those whose object in front was looked for, not found
};

}  // namespace wrinkle
