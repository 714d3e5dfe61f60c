// Structs that the host fills and kernels read. Included by both. Every member is a WR_SCALAR: the host fills double
// and narrows number by number for a float program, so one declaration serves every precision.
#ifndef WR_LAYOUT_H
#define WR_LAYOUT_H

// What changes from frame to frame. Positions are relative to the eye.
typedef struct {
    WR_SCALAR width, height;
    WR_SCALAR eye_high[3], eye_low[3];  // world position of the eye as an unevaluated sum of two floats
    // Pinhole: ray through pixel (x, y): d = d0 + x dx + y dy, view depth 1
    WR_SCALAR d0[3], dx[3], dy[3];
    WR_SCALAR dx_cross_d0[3], dx_cross_dy[3];  // dx x d = dx_cross_d0 + y dx_cross_dy, because dx x dx = 0
    WR_SCALAR dy_cross_d0[3], dy_cross_dx[3];  // dy x d = dy_cross_d0 + x dy_cross_dx
    // Any projection: columns of the inverse view-projection-screen matrix, eye-relative, and their w
    WR_SCALAR c0[3], c1[3], c2[3], c3[3], w[4];
    WR_SCALAR forward[3];  // along the rays of a parallel projection, per unit of view depth
    // What a float leaves of d0 ... w, for exact variants; not to be added in double
    WR_SCALAR d0_low[3], dx_low[3], dy_low[3], c0_low[3], c1_low[3], c2_low[3], c3_low[3], w_low[4];
} wr_camera;

// A projector: a decal, or a row of a table of them. q = to_box (p - center) is in [-1,1]^3 inside its box. Shapes: 0
// box, 1 sphere, 2 cone.
typedef struct {
    WR_SCALAR center[3];
    WR_SCALAR to_box_x[3], to_box_y[3], to_box_z[3];  // unit axis / half size
    WR_SCALAR strength[2];    // volume gradient along to_box_x, to_box_y for a slope of 1 along s, t
    WR_SCALAR repeat[2];      // of the image over the box
    WR_SCALAR falloff[3];     // 1 / share that fades; 0: a hard edge
    WR_SCALAR fade_slope, fade_zero;  // angle fade = clamp((n . to_box_z) fade_slope - fade_zero, 0, 1)
    WR_SCALAR two_sided;      // 1: the angle fade takes |n . to_box_z|
    WR_SCALAR shape;
    WR_SCALAR per_size;       // 1: slopes of a cone's image grow as the image shrinks towards the apex
    WR_SCALAR texture;        // number of its texture
    WR_SCALAR tile;           // 1: repeated, 0: clamped
    WR_SCALAR opacity;
    WR_SCALAR replace;        // 1: takes the place of what the table's rows before made, 0: adds to it
    WR_SCALAR mask;           // 0 none, 1 object, 2 Cryptomatte
    WR_SCALAR object;         // index; or upper and lower half of the hash
    WR_SCALAR object_low;
    WR_SCALAR unused;         // two whole cache lines a row
} wr_projector;

// A light. Kinds: 0 sun, 1 point, 2 spot.
typedef struct {
    WR_SCALAR kind;
    WR_SCALAR color[3];      // times intensity
    WR_SCALAR position[3];   // eye-relative
    WR_SCALAR to_light[3];   // unit, against the way the light travels
    WR_SCALAR cos_inner, cos_outer;
} wr_light;

// Lighting of a frame.
typedef struct {
    WR_SCALAR ambient[3], albedo[3];
    WR_SCALAR roughness, f0, max_ratio, lights;
} wr_lighting;

// Texture table: WR_TEXTURE_WORDS 32-bit numbers a texture.
#define WR_MAX_LEVELS 16
#define WR_TEXTURE_WIDTH 0
#define WR_TEXTURE_HEIGHT 1
#define WR_TEXTURE_LEVELS 2
#define WR_TEXTURE_OFFSETS 3  // of each level's first float in the texel buffer
#define WR_TEXTURE_WORDS 19
// ... and of a volume, in the same table
#define WR_VOLUME_BLOCKS 0  // of 8^3 cells along x, y, z
#define WR_VOLUME_FIRST 3   // index of the first voxel of the first block, signed
#define WR_VOLUME_INDEX 6   // of the texel that holds the first of the blocks' offsets

#endif
