// Resolve from G-buffers that are stored in fewer bytes, to see what that costs in degrees. wr_resolve_only of
// memory.cl is the same from floats.
#define WR_FEW_OUTPUTS
#include "wrinkle.clh"

#if WR_LANES == 1
#define wr_load_half(plane, at) vload_half(at, plane)
#define wr_load_shorts(plane, at) convert_float(plane[at])
#else
#define wr_load_half(plane, at) WR_JOIN(vload_half, WR_LANES)(0, plane + (at))
#define wr_load_shorts(plane, at)                                                                            \
    WR_JOIN(convert_, WR_WIDTH(float))(WR_JOIN(vload, WR_LANES)(0, plane + (at)))
#endif

wr_fn void wr_resolve_and_store(wr_vec3 n, wr_vec3 g, global WR_SCALAR *x, global WR_SCALAR *y, global WR_SCALAR *z,
                                size_t at)
{
    n = wr_resolve(n, g);
    wr_stream(n.x, x, at);
    wr_stream(n.y, y, at);
    wr_stream(n.z, z, at);
}

kernel void wr_from_halves(global const half *restrict n_x, global const half *restrict n_y,
                           global const half *restrict n_z, global const half *restrict g_x,
                           global const half *restrict g_y, global const half *restrict g_z,
                           global WR_SCALAR *restrict out_x, global WR_SCALAR *restrict out_y,
                           global WR_SCALAR *restrict out_z, uint pixels)
{
    size_t at = get_global_id(0) * WR_LANES;
    if (at >= pixels) return;
    wr_vec3 n = wr_v3(wr_load_half(n_x, at), wr_load_half(n_y, at), wr_load_half(n_z, at));
    wr_vec3 g = wr_v3(wr_load_half(g_x, at), wr_load_half(g_y, at), wr_load_half(g_z, at));
    wr_resolve_and_store(wr_normalize(n), g, out_x, out_y, out_z, at);
}

/// The unit vector of two octahedral coordinates in [-1, 1] [Cigolle et al. 2014].
wr_fn wr_vec3 wr_from_octahedron(wr_real u, wr_real v)
{
    wr_real z = 1 - fabs(u) - fabs(v), fold = fmax(-z, (wr_real)(0));
    return wr_normalize(wr_v3(u - copysign(fold, u), v - copysign(fold, v), z));
}

/// From octahedral normals and float gradients.
kernel void wr_from_octahedral(global const short *restrict n_u, global const short *restrict n_v,
                               global const float *restrict g_x, global const float *restrict g_y,
                               global const float *restrict g_z, global WR_SCALAR *restrict out_x,
                               global WR_SCALAR *restrict out_y, global WR_SCALAR *restrict out_z, uint pixels)
{
    size_t at = get_global_id(0) * WR_LANES;
    if (at >= pixels) return;
    wr_real scale = (wr_real)(1 / WR_R(32767.0));
    wr_vec3 n = wr_from_octahedron(wr_load_shorts(n_u, at) * scale, wr_load_shorts(n_v, at) * scale);
    wr_resolve_and_store(n, wr_v3(wr_load(g_x, at), wr_load(g_y, at), wr_load(g_z, at)), out_x, out_y, out_z, at);
}
