// Noise in several ways: value and analytic gradient, gradient by differences, value alone. Each sums WR_OCTAVES
// octaves.
#define WR_FEW_OUTPUTS
#include "wrinkle.clh"

#define WR_OCTAVES 8

/// The point in octave k, which is 2^k times finer and moved, so that the octaves' lattices do not line up.
wr_fn wr_vec3 wr_octave(wr_vec3 p, int k)
{
    wr_real scale = (wr_real)((float)(1 << k)), offset = (wr_real)(WR_R(17.25) * k);
    return wr_v3(fma(p.x, scale, offset), fma(p.y, scale, offset), fma(p.z, scale, offset));
}

/// Perlin noise without a table, as FastNoise2 does it: corners are hashed by multiplication, and bits of the hash
/// choose the direction. The fastest way to values that we know.
wr_fn wr_real wr_hashed_corner(wr_index hash, wr_real x, wr_real y, wr_real z)
{
    hash *= 0x27d4eb2d;
    hash = (hash >> 15) ^ hash;
    wr_index h = hash & 13;
    wr_real u = h < 8 ? x : y;
    wr_real v = h == 12 ? x : z;
    v = h < 2 ? y : v;
    wr_index a = wr_bits(u) ^ (hash << 31), b = wr_bits(v) ^ ((hash & 2) << 30);
    return WR_JOIN(as_, WR_WIDTH(float))(a) + WR_JOIN(as_, WR_WIDTH(float))(b);
}
wr_fn wr_real wr_mixed(wr_real a, wr_real b, wr_real w) { return fma(w, b - a, a); }
wr_fn wr_real wr_hashed_noise(wr_vec3 p)
{
    wr_vec3 cell = wr_v3(wr_floor(p.x), wr_floor(p.y), wr_floor(p.z));
    wr_real x = p.x - cell.x, y = p.y - cell.y, z = p.z - cell.z;
    wr_index x0 = wr_to_index(cell.x) * 501125321, y0 = wr_to_index(cell.y) * 1136930381,
             z0 = wr_to_index(cell.z) * 1720413743;
    wr_index x1 = x0 + 501125321, y1 = y0 + 1136930381, z1 = z0 + 1720413743;
    wr_real u = wr_fade_quintic(x).weight, v = wr_fade_quintic(y).weight, w = wr_fade_quintic(z).weight;
    wr_real a = wr_mixed(wr_hashed_corner(x0 ^ y0 ^ z0, x, y, z), wr_hashed_corner(x1 ^ y0 ^ z0, x - 1, y, z), u);
    wr_real b =
        wr_mixed(wr_hashed_corner(x0 ^ y1 ^ z0, x, y - 1, z), wr_hashed_corner(x1 ^ y1 ^ z0, x - 1, y - 1, z), u);
    wr_real c =
        wr_mixed(wr_hashed_corner(x0 ^ y0 ^ z1, x, y, z - 1), wr_hashed_corner(x1 ^ y0 ^ z1, x - 1, y, z - 1), u);
    wr_real d = wr_mixed(wr_hashed_corner(x0 ^ y1 ^ z1, x, y - 1, z - 1),
                         wr_hashed_corner(x1 ^ y1 ^ z1, x - 1, y - 1, z - 1), u);
    return wr_mixed(wr_mixed(a, b, v), wr_mixed(c, d, v), w);
}

// The volatile vector forces the stack to be aligned, as it is in fused kernels. Without it, LLVM may place values that
// do not fit into registers across two cache lines, depending on the thread, and the kernel takes up to a fifth longer.
#define WR_NOISE_KERNEL(name, octave)                                                               \
    wr_kernel void name(global const float *restrict in_x, global const float *restrict in_y,       \
                        global const float *restrict in_z, global WR_SCALAR *restrict out_value,    \
                        global WR_SCALAR *restrict out_x, global WR_SCALAR *restrict out_y,         \
                        global WR_SCALAR *restrict out_z, uint pixels)                              \
    {                                                                                               \
        size_t at = get_global_id(0) * WR_LANES;                                                    \
        if (at >= pixels) return;                                                                   \
        volatile wr_real on_the_stack = 0;                                                          \
        wr_vec3 p = wr_v3(wr_load(in_x, at), wr_load(in_y, at), wr_load(in_z, at));                 \
        wr_real value = 0;                                                                          \
        wr_vec3 gradient = wr_zero3();                                                              \
        for (int k = 0; k < WR_OCTAVES; ++k) {                                                      \
            wr_vec3 q = wr_octave(p, k);                                                            \
            octave                                                                                  \
        }                                                                                           \
        wr_store(value, out_value, at);                                                             \
        wr_store(gradient.x, out_x, at);                                                            \
        wr_store(gradient.y, out_y, at);                                                            \
        wr_store(gradient.z, out_z, at);                                                            \
    }

WR_NOISE_KERNEL(wr_value_and_gradient, wr_field f = wr_perlin_noise(wr_lattice_at(q)); value += f.value;
                gradient = wr_add(gradient, f.gradient);)
WR_NOISE_KERNEL(wr_value_by_table, value += wr_perlin_noise(wr_lattice_at(q)).value;)
WR_NOISE_KERNEL(wr_value_by_hash, value += wr_hashed_noise(q);)

#define WR_STEP WR_R(0.0078125)
#define WR_MOVED(dx, dy, dz) wr_add(q, wr_v3((wr_real)(dx), (wr_real)(dy), (wr_real)(dz)))
WR_NOISE_KERNEL(wr_forward_by_table, wr_real f = wr_perlin_noise(wr_lattice_at(q)).value; value += f;
                gradient.x += (wr_perlin_noise(wr_lattice_at(WR_MOVED(WR_STEP, 0, 0))).value - f) / WR_STEP;
                gradient.y += (wr_perlin_noise(wr_lattice_at(WR_MOVED(0, WR_STEP, 0))).value - f) / WR_STEP;
                gradient.z += (wr_perlin_noise(wr_lattice_at(WR_MOVED(0, 0, WR_STEP))).value - f) / WR_STEP;)
WR_NOISE_KERNEL(wr_forward_by_hash, wr_real f = wr_hashed_noise(q); value += f;
                gradient.x += (wr_hashed_noise(WR_MOVED(WR_STEP, 0, 0)) - f) / WR_STEP;
                gradient.y += (wr_hashed_noise(WR_MOVED(0, WR_STEP, 0)) - f) / WR_STEP;
                gradient.z += (wr_hashed_noise(WR_MOVED(0, 0, WR_STEP)) - f) / WR_STEP;)
