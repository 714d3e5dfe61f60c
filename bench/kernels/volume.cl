// Samples a volume at points that are given as planes.
#include "wrinkle.clh"

#define WR_SAMPLES(NAME, SAMPLE)                                                                                     \
    wr_kernel void NAME(global const float *restrict texels, global const uint *restrict textures,                   \
                        global const float *restrict x, global const float *restrict y,                              \
                        global const float *restrict z, global WR_SCALAR *restrict value,                            \
                        global WR_SCALAR *restrict gx, global WR_SCALAR *restrict gy, global WR_SCALAR *restrict gz) \
    {                                                                                                                \
        size_t at = get_global_id(0) * WR_LANES;                                                                     \
        wr_field s =                                                                                                 \
            SAMPLE(wr_volume_at(texels, textures, 0), wr_v3(wr_load(x, at), wr_load(y, at), wr_load(z, at)));        \
        wr_store(s.value, value, at);                                                                                \
        wr_store(s.gradient.x, gx, at);                                                                              \
        wr_store(s.gradient.y, gy, at);                                                                              \
        wr_store(s.gradient.z, gz, at);                                                                              \
    }
WR_SAMPLES(wr_linear_samples, wr_volume_trilinear)
WR_SAMPLES(wr_smooth_samples, wr_volume_bspline)
