#pragma once

/// A stack of box decals over planar depth, as arrays and pointers only: every compiler and every set of flags gets the
/// same data, so that only their code differs.
namespace wrinkle::baseline {

struct StackDecal {
    float to_x[3], to_y[3], to_z[3], centre[3];  ///< q.x = to_x . p - centre[0], inside the box within [-1, 1]
    float axis_z[3], grad_s[3], grad_t[3];       ///< volume gradient per unit slope
    float per_falloff, fade_from, per_fade;
    const float* slopes;        ///< d/ds and d/dt of a texel side by side; with a border of one texel all round
    int width, height, stride;  ///< in texels; stride: a row with its border
};

struct StackJob {
    const float *depth, *n_x, *n_y, *n_z;
    float *out_x, *out_y, *out_z;
    float d0[3], dx[3], dy[3];  ///< rays of view depth 1, eye-relative
    int width;
    const StackDecal* decals;
    int count;
};

/// Evaluates rows [first, last).
using StackRows = void (*)(const StackJob& job, int first, int last);

void stack_rows_plain(const StackJob& job, int first, int last);       ///< float3 structs, -O3 -march=native
void stack_rows_plain_fast(const StackJob& job, int first, int last);  ///< ... and -ffast-math
void stack_rows_simd(const StackJob& job, int first, int last);        ///< structure of arrays, omp simd, by g++
#ifdef WRINKLE_BASELINE_CLANG
void stack_rows_simd_clang(const StackJob& job, int first, int last);  ///< ... by clang++
#endif
#ifdef WRINKLE_BASELINE_AVX2
void stack_rows_hand8(const StackJob& job, int first, int last);  ///< by hand, pairs of texels by one load
#endif
#ifdef WRINKLE_BASELINE_AVX512
void stack_rows_hand16(const StackJob& job, int first, int last);
#endif

}  // namespace wrinkle::baseline
