"""The frame relit.exr: a torus (object 1), a metal ball (2) and the ground (3), in the light of a sun and a sky."""
import math

import bpy
from blender_scene import camera, dress, ground, sky, sun

SIZE = (320, 180)
SAMPLES = 256
PASSES = ("diffuse_color", "glossy_direct", "glossy_indirect", "glossy_color")
FINER = 1


def make(texture):
    bpy.ops.mesh.primitive_torus_add(location=(-0.7, 0.3, 0.75), rotation=(math.radians(62), 0, math.radians(-28)),
                                     major_radius=0.85, minor_radius=0.38, major_segments=384, minor_segments=192)
    dress("Torus", 1, (0.62, 0.33, 0.2), 0.45, bump=(texture, (6, 3), 0.06))
    bpy.ops.mesh.primitive_uv_sphere_add(location=(1.55, -0.2, 0.6), radius=0.6, segments=192, ring_count=96)
    dress("Ball", 2, (0.8, 0.75, 0.6), 0.3, metallic=1, bump=(texture, (6, 3), 0.05))
    ground()
    dress("Ground", 3, (0.36, 0.38, 0.34), 0.6, bump=(texture, (1.1, 1.1), 0.1))
    sun((0.70, 0.48, -0.53), 3.4, (1, 0.93, 0.82))
    sky(horizon=(0.62, 0.62, 0.58), zenith=(0.2, 0.34, 0.7), strength=0.55)
    camera((0.3, -5.2, 2.0), (0.2, 0, 0.55), 45)
