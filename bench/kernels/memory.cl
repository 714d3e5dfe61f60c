// The machine's ceilings, and resolve, the pass that does least beside moving memory. Stores bypass the cache where
// they can.
#define WR_FEW_OUTPUTS
#include "wrinkle.clh"

wr_kernel void wr_copy(global const float *restrict x, global const float *restrict y, global const float *restrict z,
                       global WR_SCALAR *restrict out_x, global WR_SCALAR *restrict out_y,
                       global WR_SCALAR *restrict out_z, uint pixels)
{
    size_t at = get_global_id(0) * WR_LANES;
    if (at >= pixels) return;
    wr_stream(wr_load(x, at), out_x, at);
    wr_stream(wr_load(y, at), out_y, at);
    wr_stream(wr_load(z, at), out_z, at);
}

/// a + 3 b, as in the STREAM benchmark: two planes in, one out.
wr_kernel void wr_triad(global const float *restrict a, global const float *restrict b, global WR_SCALAR *restrict out,
                        uint pixels)
{
    size_t at = get_global_id(0) * WR_LANES;
    if (at >= pixels) return;
    wr_stream(fma(wr_load(b, at), (wr_real)(3), wr_load(a, at)), out, at);
}

#define WR_FMA_ROUNDS 256
#define WR_FMA_CHAINS 12

/// Nothing but arithmetic: as many independent chains of fma as it takes to hide their latency.
wr_kernel void wr_fma_chains(global const float *restrict in, global WR_SCALAR *restrict out, uint pixels)
{
    size_t at = get_global_id(0) * WR_LANES;
    if (at >= pixels) return;
    wr_real v = wr_load(in, at), chain[WR_FMA_CHAINS];
    _Pragma("unroll") for (int k = 0; k < WR_FMA_CHAINS; ++k) chain[k] = v + (WR_SCALAR)(k);
    for (int i = 0; i < WR_FMA_ROUNDS; ++i) {
        _Pragma("unroll") for (int k = 0; k < WR_FMA_CHAINS; ++k) chain[k] = fma(chain[k], v, v);
    }
    wr_real sum = 0;
    _Pragma("unroll") for (int k = 0; k < WR_FMA_CHAINS; ++k) sum += chain[k];
    wr_store(sum, out, at);
}

wr_kernel void wr_resolve_only(global const float *restrict n_x, global const float *restrict n_y,
                               global const float *restrict n_z, global const float *restrict g_x,
                               global const float *restrict g_y, global const float *restrict g_z,
                               global WR_SCALAR *restrict out_x, global WR_SCALAR *restrict out_y,
                               global WR_SCALAR *restrict out_z, uint pixels)
{
    size_t at = get_global_id(0) * WR_LANES;
    if (at >= pixels) return;
    wr_vec3 n = wr_v3(wr_load(n_x, at), wr_load(n_y, at), wr_load(n_z, at));
    wr_vec3 g = wr_v3(wr_load(g_x, at), wr_load(g_y, at), wr_load(g_z, at));
    n = wr_resolve(n, g);
    wr_stream(n.x, out_x, at);
    wr_stream(n.y, out_y, at);
    wr_stream(n.z, out_z, at);
}

/// Copies as many planes as screen derivatives read and write.
wr_kernel void wr_copy_four_to_six(global const float *restrict a, global const float *restrict b,
                                   global const float *restrict c, global const float *restrict d,
                                   global WR_SCALAR *restrict out_a, global WR_SCALAR *restrict out_b,
                                   global WR_SCALAR *restrict out_c, global WR_SCALAR *restrict out_d,
                                   global WR_SCALAR *restrict out_e, global WR_SCALAR *restrict out_f, uint pixels)
{
    size_t at = get_global_id(0) * WR_LANES;
    if (at >= pixels) return;
    wr_real x = wr_load(a, at), y = wr_load(b, at), z = wr_load(c, at), w = wr_load(d, at);
    wr_stream(x, out_a, at);
    wr_stream(y, out_b, at);
    wr_stream(z, out_c, at);
    wr_stream(w, out_d, at);
    wr_stream(x, out_e, at);
    wr_stream(y, out_f, at);
}
