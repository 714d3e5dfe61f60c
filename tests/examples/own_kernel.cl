// A kernel of an engine's own: bumps a G-buffer by a height map that repeats every metre of the ground, and by a decal
// of the same image. Needs the folder of wrinkle's kernel files on the include path (-I), and nothing of its host.
#include "wrinkle.clh"

wr_kernel void bump(constant const wr_camera *camera, global const wr_projector *decal, global const float *texels,
                    global const uint *textures, global const float *depth, global const float *nx,
                    global const float *ny, global const float *nz, global float *bumped)
{
    // Work-item i has the pixels i WR_LANES and after. Positions are relative to the eye.
    wr_pixels at = wr_pixels_of(get_global_id(0), 0, 0, (uint)camera->width);
    wr_vec3 n = wr_v3(wr_load(nx, at.in), wr_load(ny, at.in), wr_load(nz, at.in));
    wr_real r = wr_load(depth, at.in);
    wr_vec3 ray = wr_ray(camera, at.x, at.y), p = wr_scale(ray, r), dp_dx, dp_dy;
    wr_screen_derivatives(camera, n, ray, r, at.x, at.y, &dp_dx, &dp_dy);
    wr_texture image = wr_texture_at(texels, textures, 0);

    // The height map: s and t are x and y of the world, in metres; a height of 1 is 3 cm.
    wr_vec3 along_x = wr_v3((wr_real)(1), (wr_real)(0), (wr_real)(0));
    wr_vec3 along_y = wr_v3((wr_real)(0), (wr_real)(1), (wr_real)(0));
    wr_texcoord uv = wr_planar(p, dp_dx, dp_dy, along_x, along_y, camera->eye_high[0], camera->eye_high[1]);
    wr_vec2 dh_dst = wr_scale(wr_slope(image, uv.st, wr_texture_lod(image, uv.dx, uv.dy)), (wr_real)(0.03f));
    wr_vec3 g = wr_surface_gradient_scale_dependent(n, dp_dx, dp_dy, uv.dx, uv.dy, dh_dst);

    // The decal: its volume gradient, weighted by its fades and projected onto the surface.
    wr_projected in = wr_project(decal, p);
    wr_real lod =
        wr_texture_lod(image, wr_projector_step(decal, in, dp_dx), wr_projector_step(decal, in, dp_dy));
    wr_real weight = wr_projector_falloff(decal, in) * wr_projector_angle_fade(decal, n);
    wr_vec2 slope = wr_projector_slope(image, decal, in, lod, in.inside);
    wr_vec3 dh_dp = wr_projector_blend(decal, in, slope, weight, wr_zero3());
    g = wr_add(g, wr_surface_gradient_from_volume(n, dh_dp));

    // Three planes, one after another.
    size_t plane = (size_t)camera->width * (size_t)camera->height;
    wr_vec3 normal = wr_resolve(n, g);
    wr_store(normal.x, bumped, at.out);
    wr_store(normal.y, bumped + plane, at.out);
    wr_store(normal.z, bumped + 2 * plane, at.out);
}
