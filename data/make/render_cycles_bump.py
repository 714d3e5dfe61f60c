"""Render what Cycles' own Bump node makes of a height map, and the unbumped passes of the same pixels.

    blender -b --factory-startup -P render_cycles_bump.py -- TEXTURES OUT      Blender 3.4; minutes on two cores

writes OUT/cycles_torus.exr, OUT/cycles_ground.exr and their cameras: passes Normal, UV and Depth of the bare surface, and
BumpedNormal, the Normal pass with a Bump node (strength 1) in the material. The height map is TEXTURES/swell_height.png,
interpolated by Cycles' cubic filter.

The Bump node takes forward differences as far as a pixel is wide, so it answers for half a pixel to the right and up.
The picture is therefore rendered FINER times as large, of which the middle pixel of every FINER x FINER is kept: the same
points on the same surfaces, with a step of 1/FINER of a pixel.

Depth and UV are rounded to 2^-16 of the depth and 2^-20, normals to half floats (0.03 degrees): the last bits do not
compress.
"""
import json
import math
import sys

import bpy
import numpy as np
import OpenImageIO as oiio
from mathutils import Vector

FINER = 9
textures, out = sys.argv[sys.argv.index("--") + 1:]


def ground(steps=160, size=7.0):
    """Low swells; one unit of UV is a metre."""
    def z(x, y):
        return 0.12 * math.sin(1.1 * x + 0.3) * math.sin(0.9 * y + 1.1)

    line = [size * (i / steps - 0.5) for i in range(steps + 1)]
    vertices = [(x, y, z(x, y)) for y in line for x in line]
    row = steps + 1
    faces = [(j * row + i, j * row + i + 1, (j + 1) * row + i + 1, (j + 1) * row + i)
             for j in range(steps) for i in range(steps)]
    data = bpy.data.meshes.new("ground")
    data.from_pydata(vertices, [], faces)
    layer = data.uv_layers.new(name="UVMap")
    for loop, uv in zip(data.loops, layer.data):
        uv.uv = vertices[loop.vertex_index][:2]
    obj = bpy.data.objects.new("ground", data)
    bpy.context.scene.collection.objects.link(obj)
    return obj


def torus():
    bpy.ops.mesh.primitive_torus_add(rotation=(math.radians(8), math.radians(-6), 0), major_radius=0.9,
                                     minor_radius=0.4, major_segments=384, minor_segments=192)
    return bpy.context.object


def material_of(obj, uv_scale, distance):
    """A material with a Bump node; returns what switches it."""
    material = bpy.data.materials.new("bump")
    material.use_nodes = True
    nodes, links = material.node_tree.nodes, material.node_tree.links
    uv, mapping, image, bump = (nodes.new("ShaderNode" + kind) for kind in ("UVMap", "Mapping", "TexImage", "Bump"))
    mapping.vector_type = "POINT"
    mapping.inputs["Scale"].default_value = (*uv_scale, 1)
    image.image = bpy.data.images.load(textures + "/swell_height.png")
    image.image.colorspace_settings.name = "Non-Color"
    image.interpolation, image.extension = "Cubic", "REPEAT"
    bump.inputs["Strength"].default_value, bump.inputs["Distance"].default_value = 1, distance
    links.new(uv.outputs["UV"], mapping.inputs["Vector"])
    links.new(mapping.outputs["Vector"], image.inputs["Vector"])
    links.new(image.outputs["Color"], bump.inputs["Height"])
    obj.data.materials.append(material)
    target = nodes["Principled BSDF"].inputs["Normal"]

    def switch(bumped):
        for link in list(target.links):
            links.remove(link)
        if bumped:
            links.new(bump.outputs["Normal"], target)
    return switch


def read(path):
    channels, file, part = {}, oiio.ImageInput.open(path), 0
    while file.seek_subimage(part, 0):
        pixels = file.read_image(part, 0, 0, file.spec().nchannels, "float")
        middle = pixels[FINER // 2::FINER, FINER // 2::FINER]
        channels.update({name: middle[..., i].copy() for i, name in enumerate(file.spec().channelnames)})
        part += 1
    file.close()
    return channels


def rounded(values, step):
    return (np.round(values / step) * step).astype(np.float32)


def render(name, width, height, make, uv_scale, distance, eye, target, lens):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    obj = make()
    for face in obj.data.polygons:
        face.use_smooth = True
    bump = material_of(obj, uv_scale, distance)
    bpy.ops.object.camera_add(location=eye)
    camera = scene.camera = bpy.context.object
    camera.rotation_euler = (Vector(target) - camera.location).to_track_quat("-Z", "Y").to_euler()
    camera.data.lens = lens

    scene.render.engine = "CYCLES"
    scene.cycles.samples = 1
    scene.cycles.pixel_filter_type, scene.cycles.filter_width = "BOX", 0.01
    scene.cycles.use_denoising = scene.cycles.use_adaptive_sampling = False
    scene.cycles.max_bounces = 0
    scene.render.threads_mode, scene.render.threads = "FIXED", 2
    scene.render.resolution_x, scene.render.resolution_y = width * FINER, height * FINER
    scene.render.resolution_percentage = 100
    settings = scene.render.image_settings
    settings.file_format, settings.color_depth, settings.exr_codec = "OPEN_EXR_MULTILAYER", "32", "ZIP"
    for wanted in ("z", "position", "normal", "uv"):
        setattr(scene.view_layers[0], "use_pass_" + wanted, True)
    passes = {}
    for bumped in (False, True):
        bump(bumped)
        scene.render.filepath = f"{bpy.app.tempdir}/{name}.exr"
        bpy.ops.render.render(write_still=True)
        passes[bumped] = read(scene.render.filepath)
    view = camera.matrix_world.inverted()
    projection = camera.calc_matrix_camera(bpy.context.evaluated_depsgraph_get(), x=width, y=height)
    with open(f"{out}/{name}.camera.json", "w") as file:
        rows = lambda m: "[\n" + ",\n".join("  " + json.dumps(list(r)) for r in m) + "\n ]"
        file.write(f'{{\n "width": {width},\n "height": {height},\n "view": {rows(view)},\n "proj": {rows(projection)}\n}}\n')

    bare = passes[False]
    depth = bare["ViewLayer.Depth.Z"]
    planes = {"Depth.Z": rounded(depth, np.exp2(np.floor(np.log2(np.minimum(depth, 1e9))) - 16))}
    planes.update({"UV." + c: rounded(bare["ViewLayer.UV." + c], 2.0**-20) for c in "UV"})
    planes.update({"Normal." + c: bare["ViewLayer.Normal." + c] for c in "XYZ"})
    planes.update({"BumpedNormal." + c: passes[True]["ViewLayer.Normal." + c] for c in "XYZ"})
    spec = oiio.ImageSpec(width, height, len(planes), "float")
    spec.channelnames = ["ViewLayer." + n for n in planes]
    spec.channelformats = tuple(oiio.TypeDesc("half" if "Normal" in n else "float") for n in planes)
    spec.attribute("compression", "zip:9")
    spec.attribute("Software", "Blender 3.4, repacked by wrinkle data/make/render_cycles_bump.py")
    spec.attribute("DateTime", "2000:01:01 00:00:00")  # a fixed date: the same input gives the same bytes
    file = oiio.ImageOutput.create(f"{out}/{name}.exr")
    if not file.open(f"{out}/{name}.exr", spec) or not file.write_image(np.stack(list(planes.values()), -1)):
        sys.exit(file.geterror())
    file.close()

    # --- check: the points of the finer picture are those of this camera's pixels ---
    seen = depth < 1e9
    p = np.stack([bare["ViewLayer.Position." + c][seen] for c in "XYZ"] + [np.ones(seen.sum())], axis=-1)
    clip = p @ (np.array(projection) @ np.array(view)).T
    j, i = np.nonzero(seen)
    residual = np.hypot((clip[:, 0] / clip[:, 3] + 1) / 2 * width - i - 0.5,
                        (1 - clip[:, 1] / clip[:, 3]) / 2 * height - j - 0.5)
    print(f"{name}: {seen.mean():.1%} covered; reprojection p50 {np.median(residual):.5f}, max {residual.max():.5f} pixel")
    if residual.max() > 0.02:
        sys.exit("the camera misses")


render("cycles_torus", 120, 90, torus, (2, 1), 0.18, (0.4, -2.6, 2.0), (0.1, -0.4, 0.03), 55)
render("cycles_ground", 120, 90, ground, (0.3, 0.3), 0.3, (0.3, -2.3, 3.4), (0, -0.1, 0), 36)
