// Resolve alone, from G-buffers that are stored in fewer bytes. wr_resolve_only of memory.cl is the same from floats. It
// takes normals as unit, as stored; what rounding does to their lengths shows in the errors.
#define WR_FEW_OUTPUTS
#include "wrinkle.clh"

wr_fn wr_stored wr_half_of(global const uchar *pixels, uint stride, uint offset)
{
    return (wr_stored){(global uchar *)pixels, WR_STORED_HALF, 2, stride, offset, 0, 1.0f, 0.0f};
}

wr_fn wr_vec3 wr_load_halves(global const uchar *x, global const uchar *y, global const uchar *z, size_t at)
{
    return wr_v3(wr_load(wr_half_of(x, 2, 0), at), wr_load(wr_half_of(y, 2, 0), at), wr_load(wr_half_of(z, 2, 0), at));
}

wr_fn wr_vec3 wr_load_pixels(global const uchar *p, size_t at)
{
    return wr_v3(wr_load(wr_half_of(p, 8, 0), at), wr_load(wr_half_of(p, 8, 2), at), wr_load(wr_half_of(p, 8, 4), at));
}

wr_fn wr_real wr_load_axis(global const uchar *pixels, uint axis, size_t at)
{
    wr_stored plane = {(global uchar *)pixels, WR_STORED_OCTAHEDRAL, 4, 4, 0, axis, 1.0f, 0.0f};
    return wr_load(plane, at);
}

wr_fn void wr_resolve_and_store(wr_vec3 n, wr_vec3 g, global WR_SCALAR *x, global WR_SCALAR *y, global WR_SCALAR *z,
                                size_t at)
{
    n = wr_resolve(n, g);
    wr_stream(n.x, x, at);
    wr_stream(n.y, y, at);
    wr_stream(n.z, z, at);
}

wr_kernel void wr_resolve_halves(global const uchar *restrict n_x, global const uchar *restrict n_y,
                                 global const uchar *restrict n_z, global const uchar *restrict g_x,
                                 global const uchar *restrict g_y, global const uchar *restrict g_z,
                                 global WR_SCALAR *restrict out_x, global WR_SCALAR *restrict out_y,
                                 global WR_SCALAR *restrict out_z, uint pixels)
{
    size_t at = get_global_id(0) * WR_LANES;
    if (at >= pixels) return;
    wr_resolve_and_store(wr_load_halves(n_x, n_y, n_z, at), wr_load_halves(g_x, g_y, g_z, at), out_x, out_y, out_z, at);
}

wr_kernel void wr_resolve_octahedral(global const uchar *restrict n, global const uchar *restrict g_x,
                                     global const uchar *restrict g_y, global const uchar *restrict g_z,
                                     global WR_SCALAR *restrict out_x, global WR_SCALAR *restrict out_y,
                                     global WR_SCALAR *restrict out_z, uint pixels)
{
    size_t at = get_global_id(0) * WR_LANES;
    if (at >= pixels) return;
    wr_vec3 direction = wr_v3(wr_load_axis(n, 0, at), wr_load_axis(n, 1, at), wr_load_axis(n, 2, at));
    wr_resolve_and_store(wr_normalize(direction), wr_load_halves(g_x, g_y, g_z, at), out_x, out_y, out_z, at);
}

wr_kernel void wr_resolve_pixels(global const uchar *restrict n, global const uchar *restrict g,
                                 global WR_SCALAR *restrict out_x, global WR_SCALAR *restrict out_y,
                                 global WR_SCALAR *restrict out_z, uint pixels)
{
    size_t at = get_global_id(0) * WR_LANES;
    if (at >= pixels) return;
    wr_resolve_and_store(wr_load_pixels(n, at), wr_load_pixels(g, at), out_x, out_y, out_z, at);
}
