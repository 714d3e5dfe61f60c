"""Render a picture without bumps, with passes, and the same with bumps in the materials: what relighting is measured against.

    python3.11 render.py torus|yard DATA_FOLDER OUT.exr      Python with PyPI's bpy 5.0 and numpy 1.26; minutes on two cores

OUT.exr has Blender's names for what a frame holds (ViewLayer.*: many samples of the picture, of each light's own and of what is mirrored; depth,
normal, UV and object index by one sample in the middle of each pixel) and two layers that a frame never has: Bumped, the picture rendered
again with a Bump node in every material, and BumpedAgain, with another seed. scene_torus.py and scene_yard.py say what is in it. The camera
lies beside it as OUT.camera.json. Pictures and normals are half floats, depth and UV floats whose last bits are rounded off. Where the scene
says FINER, OUT_data.exr has the data passes with that many times as many pixels along each side.
"""
import importlib
import os
import re
import sys

import bpy
from blender_render import prepare, render
from blender_scene import clear, switch_bumps
from frame_file import write_camera, write_frame

DATA = re.compile(r".*\.(Depth\.Z|Normal\.[XYZ]|UV\.[UV]|Object Index\.X)")
SURFACE = re.compile(DATA.pattern + r"|.*\.Diffuse Color\.[RGB]|.*\.CryptoObject00\..")
COLOURS = re.compile(r".*\.(Combined(_\w+)?|Diffuse Color|Glossy (Direct|Indirect|Color))\.[RGB]|.*\.CryptoObject0[01]\..")


def those(pattern, channels):
    return {name: plane for name, plane in channels.items() if pattern.fullmatch(name)}


name, data, out = sys.argv[-3:]
stem = os.path.splitext(out)[0]
frame = importlib.import_module("scene_" + name)
clear()
frame.make(data + "/textures/swell_height.png")
prepare(frame.PASSES)
switch_bumps(False)
passes, _ = render(frame.SIZE, 1, 0)
plain, told = render(frame.SIZE, frame.SAMPLES, 1)
planes = those(DATA, passes) | those(COLOURS, plain)
if frame.FINER > 1:
    finer, told_finer = render([frame.FINER * side for side in frame.SIZE], 1, 0)
    write_frame(stem + "_data.exr", those(SURFACE, finer), told_finer)
switch_bumps(True)
for again, seed in (("Bumped", 2), ("BumpedAgain", 3)):
    bumped, _ = render(frame.SIZE, frame.SAMPLES, seed)
    planes |= {f"{again}.{c}": bumped[f"ViewLayer.Combined.{c}"] for c in "RGB"}
write_frame(out, planes, told)
write_camera(stem + ".camera.json", bpy.context.scene.camera, bpy.context.evaluated_depsgraph_get(), frame.SIZE)
