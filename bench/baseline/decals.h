#pragma once

#include <map>
#include <memory>
#include <vector>

#include "baseline.h"
#include "camera_terms.h"

/// Tables of decals in plain C++ from listing 15 of [Mik20]: boxes, spheres and cones that add or replace. Which decals
/// touch which tile of the frame is given. One pixel at a time, OpenMP over rows.
namespace wrinkle::baseline {

struct TileLists {
    int tile_width = 0, tile_height = 0;
    std::vector<std::vector<std::uint32_t>> lists;  ///< of each tile, row by row: numbers of decals in the table
};

class DecalTable {
public:
    /// The table's rows may not have masks. `textures`: by the file names used in the layer.
    DecalTable(const DecalsLayer& layer, double scale, Size size, const Camera& camera,
               const std::map<std::filesystem::path, Image>& textures);
    ~DecalTable();

    /// Writes the new normals of a frame with planar depth.
    void run(const Scene& scene, const PlaneMap& planes, const TileLists& tiles, Planes out) const;

private:
    struct Prepared;
    std::unique_ptr<const Prepared> prepared_;
};

}  // namespace wrinkle::baseline
