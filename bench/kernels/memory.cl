// Ceilings and the barest of passes, with the best stores there are.
#define WR_FEW_OUTPUTS
#include "lanes.clh"
#include "vec.clh"
#include "compose/resolve.clh"

kernel void wr_copy(global const float *restrict x, global const float *restrict y, global const float *restrict z,
                    global WR_SCALAR *restrict out_x, global WR_SCALAR *restrict out_y,
                    global WR_SCALAR *restrict out_z, uint pixels)
{
    size_t at = get_global_id(0) * WR_LANES;
    if (at >= pixels) return;
    wr_stream(wr_load(x, at), out_x, at);
    wr_stream(wr_load(y, at), out_y, at);
    wr_stream(wr_load(z, at), out_z, at);
}

kernel void wr_resolve_only(global const float *restrict n_x, global const float *restrict n_y,
                            global const float *restrict n_z, global const float *restrict g_x,
                            global const float *restrict g_y, global const float *restrict g_z,
                            global WR_SCALAR *restrict out_x, global WR_SCALAR *restrict out_y,
                            global WR_SCALAR *restrict out_z, uint pixels)
{
    size_t at = get_global_id(0) * WR_LANES;
    if (at >= pixels) return;
    vec3 n = wr_v3(wr_load(n_x, at), wr_load(n_y, at), wr_load(n_z, at));
    vec3 g = wr_v3(wr_load(g_x, at), wr_load(g_y, at), wr_load(g_z, at));
    n = wr_resolve(n, g);
    wr_stream(n.x, out_x, at);
    wr_stream(n.y, out_y, at);
    wr_stream(n.z, out_z, at);
}
