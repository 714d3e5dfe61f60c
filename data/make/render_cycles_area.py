"""Render what Cycles' own Bump node shows over the whole area of each pixel, and the unbumped passes of the pixels' middles.

    python3.11 render_cycles_area.py TEXTURES OUT      Python with PyPI's bpy 5.0 and numpy 1.26; a minute on two cores

writes OUT/cycles_NAME_area.exr and its camera for each of cycles_scenes.py's: passes Normal, UV and Depth of the bare surface by one
sample, which is in the middle of the pixel, and BumpedNormal, the Normal pass with a Bump node in the material by SAMPLES of them,
evenly over the pixel. From Blender 5.0 on, the node takes its differences over a tenth of a pixel, and Cycles bends normals that would
mirror what lies below the surface for closures that mirror only: the material has none.
"""
import os
import sys

sys.path.append(os.path.dirname(os.path.abspath(__file__)))
from cycles_scenes import SCENES, open_scene, render, write  # noqa: E402

SAMPLES = 256
textures, out = sys.argv[-2:]
for name, scene in SCENES.items():
    bump = open_scene(scene, textures, diffuse=True)
    bump(False)
    bare = render(scene.size, 1, 1)
    bump(True)
    write(f"{out}/cycles_{name}_area", scene.size, bare, render(scene.size, SAMPLES, 1),
          "Blender 5.0, repacked by wrinkle data/make/render_cycles_area.py")
