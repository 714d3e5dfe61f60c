#include "tools/frame_provenance.h"

#include <fmt/format.h>

#include "device/kernel_sources.h"
#include "io/camera_file.h"
#include "io/frame_path.h"
#include "io/provenance.h"
#include "io/udim.h"

namespace wrinkle {

std::string frame_provenance(const scene::SceneFile& file, const RenderOptions& options, int frame) {
    const Scene& scene = file.scene;
    io::Provenance hash;
    hash.add(WRINKLE_VERSION);
    for (const KernelSource& source : embedded_kernel_sources()) hash.add(kernel_source(source.name));
    hash.add(file.text);
    hash.add(fmt::format("{} {} {} {} {} {}", static_cast<int>(options.precision), options.lanes,
                         scene.budget.max_error.value_or(0), scene.budget.max_area_error.value_or(0),
                         scene.budget.sample, scene.budget.seed));
    for (const std::filesystem::path& of_frame : file.kept_files) hash.add_file(frame_path(of_frame, frame));
    if (const auto beside = camera_beside(frame_path(scene.gbuffer.file, frame))) hash.add_file(*beside);
    for (const std::filesystem::path& of_layer : file.files) {
        hash.add_file(of_layer);
        for (const io::UdimTile& tile : io::udim_tiles(of_layer)) hash.add_file(tile.file);
    }
    return hash.digest();
}

}  // namespace wrinkle
