#include "scene/layer_readers.h"

namespace wrinkle::scene {

void read_parallax(Table& table, Layer& layer) {
    ParallaxLayer bump;
    read_texture_file(table, bump.texture);
    read_mapped(table, bump.texture, bump.uv);
    table.choose("mode", bump.mode, {{"offset", ParallaxMode::offset}, {"march", ParallaxMode::march}});
    table.read("steps", bump.steps, 1, 1024);
    table.read("refine", bump.refine, 0, 16);
    for (const char* key : {"steps", "refine"}) table.only_with(key, bump.mode == ParallaxMode::march, "mode", "march");
    table.read("level", bump.level, zero_to_one);
    table.read("curved", bump.curved);
    table.read("scale", layer.scale, {.low = 0, .high = 1e6, .low_is_allowed = false});
    read_place(table, layer);
    layer.bump = bump;
}

}  // namespace wrinkle::scene
