"""The frame yard.exr: a wall (1) that casts its shadow onto the ground (2), a rough pot (3), a chrome ball (4) and a leaf that half
the light passes (5), in the light of a sun from behind, a lamp and a sky."""
import math

import bpy
from blender_scene import box, camera, dress, ground, lamp, sky, sun

SIZE = (256, 144)
SAMPLES = 256
PASSES = ("diffuse_color", "glossy_direct", "glossy_indirect", "glossy_color", "cryptomatte_object")
FINER = 2  # times as many pixels along each side of the data in yard_data.exr


def make(texture):
    box((-0.75, 0.7, 0.6), (1.9, 0.35, 1.2), 14)
    dress("Wall", 1, (0.58, 0.36, 0.27), 0.7, bump=(texture, (1.5, 1.5), 0.07), smooth=False)
    ground()
    dress("Ground", 2, (0.4, 0.37, 0.32), 0.8, bump=(texture, (1.2, 1.2), 0.08))
    bpy.ops.mesh.primitive_uv_sphere_add(location=(1.15, 0.05, 0.5), radius=0.5, segments=256, ring_count=128)
    dress("Pot", 3, (0.3, 0.45, 0.55), 0.55, bump=(texture, (6, 3), 0.05))
    bpy.ops.mesh.primitive_uv_sphere_add(location=(0.15, -1.15, 0.22), radius=0.22, segments=192, ring_count=96)
    dress("Chrome", 4, (0.85, 0.85, 0.86), 0.06, metallic=1, bump=(texture, (6, 3), 0.02))
    bpy.ops.mesh.primitive_plane_add(size=0.45, location=(-0.85, -1.3, 0.5),
                                     rotation=(math.radians(65), math.radians(15), math.radians(20)))
    dress("Leaf", 5, (0.25, 0.5, 0.12), 0.5, alpha=0.55, smooth=False)
    sun((0.62, -0.42, -0.52), 3.2, (1, 0.93, 0.82))
    lamp((2.2, -2.4, 1.9), 110, (1, 0.75, 0.5), 0.08)
    sky(horizon=(0.62, 0.62, 0.58), zenith=(0.2, 0.34, 0.7), strength=0.5)
    camera((0.25, -5.0, 2.1), (0.15, 0, 0.4), 45)
