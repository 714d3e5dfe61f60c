"""Render a picture without bumps, with passes, and the same with bumps in the materials: what relighting is measured against.

    python3.11 render.py DATA_FOLDER OUT.exr      Python with PyPI's bpy 5.0 and numpy 1.26; two minutes on two cores

OUT.exr has Blender's names for what a frame holds (ViewLayer.*: 64 samples of the picture, of the sun's own light and of what is mirrored; depth, normal,
UV and object index by one sample in the middle of each pixel) and two layers that a frame never has: Bumped, the picture rendered again
with a Bump node in every material, and BumpedAgain, with another seed. Objects: 1 a torus, 2 a metal ball, 3 the ground. The camera
lies beside it as OUT.camera.json. Pictures and normals are half floats, depth and UV floats whose last bits are rounded off.
"""
import json
import math
import os
import sys
import tempfile

import bpy
import numpy as np
from mathutils import Vector

sys.path.append(bpy.utils.system_resource("PYTHON", path="lib/python3.11/site-packages"))  # bpy brings it along
import OpenImageIO as oiio  # noqa: E402

WIDTH, HEIGHT, SAMPLES = 320, 180, 64
SUN = Vector((0.70, 0.48, -0.53))  # the way it travels
DATA = ("Depth.Z", "Normal.X", "Normal.Y", "Normal.Z", "UV.U", "UV.V", "Object Index.X")
COLOURS = ("Combined.R", "Combined.G", "Combined.B", "Combined_sun.R", "Combined_sun.G", "Combined_sun.B",
           "Diffuse Color.R", "Diffuse Color.G", "Diffuse Color.B",
           *(f"Glossy {part}.{c}" for part in ("Direct", "Indirect", "Color") for c in "RGB"))

data, out = sys.argv[-2:]
bpy.ops.wm.read_factory_settings(use_empty=True)
scene = bpy.context.scene
bumps = []


def dress(name, index, colour, roughness, metallic, uv_scale, distance):
    obj = bpy.context.object
    obj.name, obj.pass_index = name, index
    for face in obj.data.polygons:
        face.use_smooth = True
    material = bpy.data.materials.new(name)
    material.use_nodes = True
    nodes, links = material.node_tree.nodes, material.node_tree.links
    shader = nodes["Principled BSDF"]
    shader.inputs["Base Color"].default_value = (*colour, 1)
    shader.inputs["Roughness"].default_value = roughness
    shader.inputs["Metallic"].default_value = metallic
    uv, mapping, image, bump = (nodes.new("ShaderNode" + kind) for kind in ("UVMap", "Mapping", "TexImage", "Bump"))
    mapping.inputs["Scale"].default_value = (*uv_scale, 1)
    image.image = bpy.data.images.load(os.path.abspath(data + "/textures/swell_height.png"), check_existing=True)
    image.image.colorspace_settings.name = "Non-Color"
    image.interpolation, image.extension = "Cubic", "REPEAT"
    bump.inputs["Strength"].default_value, bump.inputs["Distance"].default_value = 1, distance
    links.new(uv.outputs["UV"], mapping.inputs["Vector"])
    links.new(mapping.outputs["Vector"], image.inputs["Vector"])
    links.new(image.outputs["Color"], bump.inputs["Height"])
    obj.data.materials.append(material)
    bumps.append((links, bump.outputs["Normal"], shader.inputs["Normal"]))


def switch_bumps(on):
    for links, normal, target in bumps:
        for link in list(target.links):
            links.remove(link)
        if on:
            links.new(normal, target)


bpy.ops.mesh.primitive_torus_add(location=(-0.7, 0.3, 0.75), rotation=(math.radians(62), 0, math.radians(-28)),
                                 major_radius=0.85, minor_radius=0.38, major_segments=384, minor_segments=192)
dress("Torus", 1, (0.62, 0.33, 0.2), 0.45, 0, (6, 3), 0.06)
bpy.ops.mesh.primitive_uv_sphere_add(location=(1.55, -0.2, 0.6), radius=0.6, segments=192, ring_count=96)
dress("Ball", 2, (0.8, 0.75, 0.6), 0.3, 1, (6, 3), 0.05)
bpy.ops.mesh.primitive_plane_add(size=40)
for loop in bpy.context.object.data.uv_layers[0].data:
    loop.uv = (loop.uv[0] * 40, loop.uv[1] * 40)  # metres
dress("Ground", 3, (0.36, 0.38, 0.34), 0.6, 0, (1.1, 1.1), 0.1)

bpy.ops.object.light_add(type="SUN")
sun = bpy.context.object
sun.rotation_euler = (-SUN).to_track_quat("Z", "Y").to_euler()
sun.data.energy, sun.data.angle, sun.data.color = 3.4, math.radians(0.53), (1, 0.93, 0.82)
world = scene.world = bpy.data.worlds.new("World")
world.use_nodes = True
background, nodes, links = world.node_tree.nodes["Background"], world.node_tree.nodes, world.node_tree.links
# Blue above, grey at the horizon, the ground's brown below.
coordinates, split, ramp = (nodes.new("ShaderNode" + k) for k in ("TexCoord", "SeparateXYZ", "MapRange"))
ramp.inputs["From Min"].default_value = 0
mix = nodes.new("ShaderNodeMix")
mix.data_type = "RGBA"
mix.inputs["A"].default_value, mix.inputs["B"].default_value = (0.62, 0.62, 0.58, 1), (0.2, 0.34, 0.7, 1)
links.new(coordinates.outputs["Generated"], split.inputs[0])
links.new(split.outputs["Z"], ramp.inputs["Value"])
links.new(ramp.outputs["Result"], mix.inputs["Factor"])
links.new(mix.outputs["Result"], background.inputs["Color"])
background.inputs["Strength"].default_value = 0.55

bpy.ops.object.camera_add(location=(0.3, -5.2, 2.0))
camera = scene.camera = bpy.context.object
camera.rotation_euler = (Vector((0.2, 0, 0.55)) - camera.location).to_track_quat("-Z", "Y").to_euler()
camera.data.lens = 45

scene.render.engine = "CYCLES"
scene.cycles.use_denoising = scene.cycles.use_adaptive_sampling = False
scene.render.resolution_x, scene.render.resolution_y, scene.render.resolution_percentage = WIDTH, HEIGHT, 100
view = scene.view_layers[0]
for wanted in ("z", "normal", "uv", "object_index", "diffuse_color", "glossy_direct", "glossy_indirect", "glossy_color"):
    setattr(view, "use_pass_" + wanted, True)
view.lightgroups.add(name="sun")
sun.lightgroup = "sun"
settings = scene.render.image_settings
try:
    settings.media_type = "MULTI_LAYER_IMAGE"
except AttributeError:
    pass  # before Blender 5
settings.file_format, settings.color_depth, settings.exr_codec = "OPEN_EXR_MULTILAYER", "32", "ZIP"


def render(samples, seed, bumped, unfiltered=False):
    switch_bumps(bumped)
    scene.cycles.samples, scene.cycles.seed = samples, seed
    scene.cycles.pixel_filter_type = "BOX" if unfiltered else "BLACKMAN_HARRIS"
    with tempfile.TemporaryDirectory() as folder:
        scene.render.filepath = folder + "/frame.exr"
        bpy.ops.render.render(write_still=True)
        file, channels, part = oiio.ImageInput.open(scene.render.filepath), {}, 0
        while file.seek_subimage(part, 0):
            pixels = file.read_image(part, 0, 0, file.spec().nchannels, "float")
            channels.update({n: pixels[..., i].copy() for i, n in enumerate(file.spec().channelnames)})
            part += 1
        file.close()
    return channels


def rounded(values, step):
    return np.round(values / step) * step


layer = view.name + "."
planes = {}
passes, plain = render(1, 0, False, True), render(SAMPLES, 1, False)
planes.update({layer + n: passes[layer + n] for n in DATA})
planes.update({layer + n: plain[layer + n] for n in COLOURS})
for name, seed in (("Bumped", 2), ("BumpedAgain", 3)):
    again = render(SAMPLES, seed, True)
    planes.update({f"{name}.{c}": again[f"{layer}Combined.{c}"] for c in "RGB"})
depth = planes[layer + "Depth.Z"]
planes[layer + "Depth.Z"] = np.where(depth < 1e9, rounded(depth, 2.0**-16), depth)
for axis in "UV":
    planes[f"{layer}UV.{axis}"] = rounded(planes[f"{layer}UV.{axis}"], 2.0**-18)

names = list(planes)
spec = oiio.ImageSpec(WIDTH, HEIGHT, len(names), "float")
spec.channelnames = names
whole = (".Depth.Z", ".UV.U", ".UV.V")
spec.channelformats = tuple(oiio.TypeDesc("float" if n.endswith(whole) else "half") for n in names)
spec.attribute("compression", "zip:9")
spec.attribute("Software", "Blender 5.0, bench/picture/render.py")
file = oiio.ImageOutput.create(out)
file.open(out, spec)
file.write_image(np.stack([planes[n] for n in names], axis=2).astype(np.float32))
file.close()

view_matrix = camera.matrix_world.inverted()
projection = camera.calc_matrix_camera(bpy.context.evaluated_depsgraph_get(), x=WIDTH, y=HEIGHT)
with open(os.path.splitext(out)[0] + ".camera.json", "w") as file:
    json.dump({"width": WIDTH, "height": HEIGHT, "view": [list(row) for row in view_matrix],
               "proj": [list(row) for row in projection]}, file, indent=1)
