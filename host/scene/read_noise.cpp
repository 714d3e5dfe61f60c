#include "scene/layer_readers.h"

namespace wrinkle::scene {

void read_noise(Table& table, Layer& layer) {
    // The bounds keep the frequency and the amplitude of a 16th octave within float32.
    NoiseLayer bump;
    table.read("frequency", bump.frequency, {.low = 0, .high = 1e9, .low_is_allowed = false});
    table.read("octaves", bump.octaves, 1, 16);
    table.read("lacunarity", bump.lacunarity, {.low = 0, .high = 16, .low_is_allowed = false});
    table.read("gain", bump.gain, {.low = 0, .high = 16});
    read_project(table, layer);
    read_weight(table, layer);
    layer.bump = bump;
}

}  // namespace wrinkle::scene
