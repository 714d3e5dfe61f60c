// Structs that a host fills and kernels read, and numbers that both must agree on; both include this file. Every member
// of a struct is a WR_SCALAR, without gaps: a float, or a double in programs with WR_FP64. Wrinkle's host has doubles and
// narrows number by number for a float program, so one declaration serves every precision.
#ifndef WR_LAYOUT_H
#define WR_LAYOUT_H

#ifdef __OPENCL_C_VERSION__
#include "lanes.clh"
#elif !defined(WR_SCALAR)
#define WR_SCALAR double
#endif

// Depth at and beyond which a pixel is background: writers store 1e10 (Blender) or more there.
#define WR_BACKGROUND_DEPTH 1e9f

// Largest slope of a tangent-space normal, 89.55 degrees [Mik20 listing 2].
#define WR_MAX_SLOPE 128

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
    // Of a depth buffer's number d = clip z / clip w: view depth is scale / (d + offset), parallel (d + offset) scale
    WR_SCALAR depth_scale, depth_offset, depth_offset_low;
} wr_camera;

// A projector: a decal, or a row of a table of them. q = to_box (p - center) is in [-1,1]^3 inside its box.
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
    WR_SCALAR kind;                 // 0 sun, 1 point, 2 spot; with an extent: 3 sun, 4 sphere, 5 disc, 6 rectangle
    // Times intensity: of a sun irradiance at normal incidence, of others radiant intensity, which falls with distance^2
    WR_SCALAR color[3];
    WR_SCALAR position[3];          // relative to the eye, metres; not of a sun
    WR_SCALAR fade;                 // 1 / range^2, the range being where it has faded away; 0: it reaches everywhere
    // World, against the way the light travels; unit, but of a disc its radius, of a rectangle half its height
    WR_SCALAR to_light[3];
    // Of a spot: cosine of the angle up to which light is full, and from which none. Of a sun with an extent: tangent of
    // half its angle. Of a sphere: radius. Of a disc or a rectangle: the vector along half its width
    WR_SCALAR shape[3];
    // Numbers of the pictures that show what of this light is diffuse, and what is specular, from 1 on; 0: none does
    WR_SCALAR diffuse, specular;
} wr_light;

// Lighting of a frame.
typedef struct {
    WR_SCALAR sky[27];            // irradiance / pi by the normal: 9 coefficients of red, green, blue; see wr_sky
    WR_SCALAR albedo[3];          // where the frame has none
    WR_SCALAR roughness;          // where the frame has none
    WR_SCALAR f0;                 // reflectance at normal incidence
    WR_SCALAR max_ratio;          // bound of wr_relight_ratio
    WR_SCALAR lights;             // how many lights there are
    WR_SCALAR shadow;             // share of a light's radiance that a picture shows of other light in its shadow
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
#define WR_VOLUME_LEVELS 7  // how many coarser levels there are; 0: none
#define WR_VOLUME_COARSER 8 // row of the table where they begin; rows of their products follow, two a level

// Prefiltered pictures of skies (shade/sky.clh): texels along the finest level, levels, alpha of the finest, and by what it
// grows from level to level; by how much the mean of each level's lobe of directions is shorter than 1.
#define WR_SKY_SIZE 256
#define WR_SKY_LEVELS 6
#define WR_SKY_ALPHA 0.0125
#define WR_SKY_ALPHA_RATIO 2.4
#define WR_SKY_KNOTS {0.002216f, 0.009573f, 0.037252f, 0.118735f, 0.263605f, 0.370269f}
// The table of GGX's lobes: along each side, over the root of the cosine to the normal and over the roughness.
#define WR_LOBE_SIZE 32

// Pictures of what metal mirrors (shade/metal.clh): cells along each side.
#define WR_METAL_SIZE 32
// So many of a scene are relit: constant memory holds their numbers everywhere, in double, too.
#define WR_METALS 2

// Columns of a block of pixels (surface/pixel_block.clh), whose rows are loaded by vload4. Host and kernels count the
// blocks of a frame by it.
#define WR_BLOCK_WIDTH 4

// Bins of decals and lights: pixels of a tile; 4 x 4 tiles are a block, 4 x 4 blocks a super block.
#define WR_TILE_WIDTH_LOG2 4
#define WR_TILE_HEIGHT_LOG2 3
#define WR_TILE_WIDTH (1 << WR_TILE_WIDTH_LOG2)
#define WR_TILE_HEIGHT (1 << WR_TILE_HEIGHT_LOG2)
// A super block of 16 x 16 tiles, in pixels.
#define WR_SUPER_WIDTH (16 * WR_TILE_WIDTH)
#define WR_SUPER_HEIGHT (16 * WR_TILE_HEIGHT)
#define WR_TILES_OF_SUPER 256
// Number of tile (x, y), of which `supers` super blocks make a row. Children are numbered within their parent, so
// those of block or super block i are 16 i to 16 i + 15. A macro, as kernels number whole vectors of lanes.
#define WR_TILE_NUMBER(x, y, supers)                                                                                  \
    ((((y) >> 4) * (supers) + ((x) >> 4)) << 8 | ((y) >> 2 & 3) << 6 | ((x) >> 2 & 3) << 4 | ((y) & 3) << 2 | ((x) & 3))
// A tile's list: where it begins, its length, and whether it is its own or a parent's.
#define WR_LIST_FIRST 0
#define WR_LIST_COUNT 1
#define WR_LIST_OWN 2
#define WR_LIST_WORDS 3
// Numbers of a decal in the table of boxes: centre, the three rows of to_box, half size of the box around it, shape.
#define WR_BOX_NUMBERS 16
// The low corner of a box around nothing; its high corner is -WR_BIN_NOTHING.
#define WR_BIN_NOTHING 3e37f
// Decals are grown by this share of their half size, for the rounding of the tests.
#define WR_BIN_BOX_SLACK 1.00002f

#endif
