"""Render what Cycles' own Bump node makes of a height map, and the unbumped passes of the same pixels.

    blender -b --factory-startup -P render_cycles_bump.py -- TEXTURES OUT      Blender 3.4; minutes on two cores

writes OUT/cycles_torus.exr, OUT/cycles_ground.exr and their cameras: passes Normal, UV and Depth of the bare surface, and
BumpedNormal, the Normal pass with a Bump node (strength 1) in the material. cycles_scenes.py says what is seen.

The Bump node takes forward differences as far as a pixel is wide, so it answers for half a pixel to the right and up.
The picture is therefore rendered FINER times as large, of which the middle pixel of every FINER x FINER is kept: the same
points on the same surfaces, with a step of 1/FINER of a pixel.
"""
import os
import sys

sys.path.append(os.path.dirname(os.path.abspath(__file__)))
from cycles_scenes import SCENES, open_scene, render, write  # noqa: E402

FINER = 9
textures, out = sys.argv[-2:]
for name in ("torus", "ground"):
    scene = SCENES[name]
    bump = open_scene(scene, textures)
    passes = []
    for bumped in (False, True):
        bump(bumped)
        finer = render([FINER * side for side in scene.size], 1, 0.01)
        passes.append({channel: pixels[FINER // 2::FINER, FINER // 2::FINER] for channel, pixels in finer.items()})
    write(f"{out}/cycles_{name}", scene.size, *passes, "Blender 3.4, repacked by wrinkle data/make/render_cycles_bump.py")
