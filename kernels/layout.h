// Structs that a host fills and kernels read; both include this file. Every member is a WR_SCALAR, without gaps: a
// float, or a double in programs with WR_FP64. Wrinkle's host sets WR_SCALAR to double and narrows number by number for
// a float program, so one declaration serves every precision.
#ifndef WR_LAYOUT_H
#define WR_LAYOUT_H

#ifdef __OPENCL_C_VERSION__
#include "lanes.clh"
#endif

// A camera and the size of its frame. World space, metres; image points in pixels, x right, y down, centres at .5.
typedef struct {
    WR_SCALAR width, height;            // of the frame, pixels
    WR_SCALAR eye_high[3], eye_low[3];  // position of the eye, as the sum of two floats
    WR_SCALAR d0[3], dx[3], dy[3];      // pinhole: the ray d = d0 + x dx + y dy, from the eye to view depth 1
    WR_SCALAR dx_cross_d0[3], dx_cross_dy[3];  // dx x d = dx_cross_d0 + y dx_cross_dy, because dx x dx = 0
    WR_SCALAR dy_cross_d0[3], dy_cross_dx[3];  // dy x d = dy_cross_d0 + x dy_cross_dx
    // Any projection: columns of the inverse view-projection-screen matrix, relative to the eye, and their w
    WR_SCALAR c0[3], c1[3], c2[3], c3[3], w[4];
    WR_SCALAR forward[3];  // parallel: the way along the rays per unit of view depth
    // What the float of the same name lacks, for the exact variants; programs in double do not read it
    WR_SCALAR d0_low[3], dx_low[3], dy_low[3], c0_low[3], c1_low[3], c2_low[3], c3_low[3], w_low[4];
} wr_camera;

// A decal's box. q = to_box (p - center) is in [-1,1]^3 inside.
typedef struct {
    WR_SCALAR center[3];                              // relative to the eye, metres
    WR_SCALAR to_box_x[3], to_box_y[3], to_box_z[3];  // unit axis / half size
    WR_SCALAR gradient_s[3], gradient_t[3];           // volume gradient for a slope of 1 along s, t
    WR_SCALAR axis_z[3];                              // unit, towards the projector
    WR_SCALAR falloff;                                // 1 / share of the half size that fades; 0: a hard edge
    WR_SCALAR fade_zero, fade_slope;                  // angle fade = clamp((n . axis_z - fade_zero) fade_slope, 0, 1)
    WR_SCALAR texture;                                // number of its texture
} wr_decal;

// A row of a table of decals. q = to_box (p - center) is in [-1,1]^3 inside its box.
typedef struct {
    WR_SCALAR center[3];              // relative to the eye, metres
    WR_SCALAR to_box_x[3], to_box_y[3], to_box_z[3];  // unit axis / half size
    WR_SCALAR strength[2];    // volume gradient along to_box_x, to_box_y for a slope of 1 along s, t
    WR_SCALAR repeat[2];      // how often the image repeats over the box
    WR_SCALAR falloff[3];     // 1 / share of the half size that fades; 0: a hard edge
    WR_SCALAR fade_slope, fade_zero;  // angle fade = clamp((n . to_box_z) fade_slope - fade_zero, 0, 1)
    WR_SCALAR two_sided;      // 1: the angle fade takes |n . to_box_z|
    WR_SCALAR shape;          // 0 box, 1 sphere, 2 cone
    WR_SCALAR per_size;       // 1: slopes of a cone's image grow as the image shrinks towards the apex
    WR_SCALAR texture;        // number of its texture
    WR_SCALAR tile;           // 1: repeated, 0: clamped
    WR_SCALAR opacity;        // factor of the gradient, in [0,1]
    WR_SCALAR replace;        // 1: replaces what the rows before have made, 0: adds to it
    WR_SCALAR mask;           // 0 none, 1 object, 2 Cryptomatte
    WR_SCALAR object;         // index of the object; or the upper 16 bits of the hash of its name
    WR_SCALAR object_low;     // ... and the lower 16 bits
    WR_SCALAR unused;         // makes a row two whole cache lines
} wr_projector;

// A light.
typedef struct {
    WR_SCALAR kind;                 // 0 sun, 1 point, 2 spot
    WR_SCALAR color[3];             // times intensity; a sun's is the irradiance, the others' falls with distance^2
    WR_SCALAR position[3];          // relative to the eye, metres; not of a sun
    WR_SCALAR to_light[3];          // unit, world, against the way the light travels; of a sun and a spot
    WR_SCALAR cos_inner, cos_outer; // of a spot: cosine of the angle up to which light is full, and from which none
} wr_light;

// Lighting of a frame.
typedef struct {
    WR_SCALAR ambient[3];         // radiance from all around
    WR_SCALAR albedo[3];          // where the frame has none
    WR_SCALAR roughness;          // where the frame has none
    WR_SCALAR f0;                 // reflectance at normal incidence
    WR_SCALAR max_ratio, lights;  // bound of wr_relight_ratio; number of lights
} wr_lighting;

// Texture table: WR_TEXTURE_WORDS 32-bit numbers a texture.
#define WR_MAX_LEVELS 16
#define WR_TEXTURE_WIDTH 0
#define WR_TEXTURE_HEIGHT 1
#define WR_TEXTURE_LEVELS 2
#define WR_TEXTURE_OFFSETS 3  // from here on: where each level's first float lies in the texel buffer
#define WR_TEXTURE_WORDS 19
// A volume takes the same number of words in the same table.
#define WR_VOLUME_BLOCKS 0  // three words: number of blocks of 8^3 cells along x, y, z
#define WR_VOLUME_FIRST 3   // three words, signed: index of the first voxel of the first block
#define WR_VOLUME_INDEX 6   // where in the texel buffer the blocks' offsets begin

#endif
