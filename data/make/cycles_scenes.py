"""Scenes of one surface with a Bump node, whose normals Cycles tells: what render_cycles_bump.py and render_cycles_area.py share.

In Blender 3.4 or 5.0. The height map is swell_height.png, or what Scene says, interpolated by Cycles' cubic filter.
"""
import dataclasses
import json
import math
import sys
import typing

import bpy
import numpy as np

try:
    import OpenImageIO as oiio
except ImportError:  # Blender as a module brings it along
    sys.path.append(bpy.utils.system_resource("PYTHON", path="lib/python3.11/site-packages"))
    import OpenImageIO as oiio
from mathutils import Vector


def _ground(steps=160, size=7.0):
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


def _plain(size=80.0):
    """Flat, as far as the camera looks; one unit of UV is a metre."""
    bpy.ops.mesh.primitive_plane_add(size=size)
    for loop in bpy.context.object.data.uv_layers[0].data:
        loop.uv = (loop.uv[0] * size, loop.uv[1] * size)
    return bpy.context.object


def _torus():
    bpy.ops.mesh.primitive_torus_add(rotation=(math.radians(8), math.radians(-6), 0), major_radius=0.9,
                                     minor_radius=0.4, major_segments=384, minor_segments=192)
    return bpy.context.object


@dataclasses.dataclass
class Scene:
    make: typing.Callable
    uv_scale: tuple
    distance: float
    eye: tuple
    target: tuple
    lens: float
    texture: str = "swell_height.png"
    size: tuple = (120, 90)


SCENES = {"torus": Scene(_torus, (2, 1), 0.18, (0.4, -2.6, 2.0), (0.1, -0.4, 0.03), 55),
          "ground": Scene(_ground, (0.3, 0.3), 0.3, (0.3, -2.3, 3.4), (0, -0.1, 0), 36),
          "plain": Scene(_plain, (0.55, 0.55), 0.05, (0, -6, 1.6), (0, 0, 0.2), 50, "cobbles_height.png")}


def _material_of(obj, scene, textures, diffuse):
    """A material with a Bump node; returns what switches it."""
    material = bpy.data.materials.new("bump")
    material.use_nodes = True
    nodes, links = material.node_tree.nodes, material.node_tree.links
    uv, mapping, image, bump = (nodes.new("ShaderNode" + kind) for kind in ("UVMap", "Mapping", "TexImage", "Bump"))
    mapping.vector_type = "POINT"
    mapping.inputs["Scale"].default_value = (*scene.uv_scale, 1)
    image.image = bpy.data.images.load(f"{textures}/{scene.texture}")
    image.image.colorspace_settings.name = "Non-Color"
    image.interpolation, image.extension = "Cubic", "REPEAT"
    bump.inputs["Strength"].default_value, bump.inputs["Distance"].default_value = 1, scene.distance
    links.new(uv.outputs["UV"], mapping.inputs["Vector"])
    links.new(mapping.outputs["Vector"], image.inputs["Vector"])
    links.new(image.outputs["Color"], bump.inputs["Height"])
    obj.data.materials.append(material)
    shader = nodes["Principled BSDF"]
    if diffuse:
        shader = nodes.new("ShaderNodeBsdfDiffuse")
        links.new(shader.outputs["BSDF"], nodes["Material Output"].inputs["Surface"])
    target = shader.inputs["Normal"]

    def switch(bumped):
        for link in list(target.links):
            links.remove(link)
        if bumped:
            links.new(bump.outputs["Normal"], target)
    return switch


def open_scene(scene, textures, diffuse=False):
    """Makes it Blender's scene, ready to render; returns what switches its bumps. diffuse: of nothing that mirrors, or else Principled."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    obj = scene.make()
    for face in obj.data.polygons:
        face.use_smooth = True
    bump = _material_of(obj, scene, textures, diffuse)
    bpy.ops.object.camera_add(location=scene.eye)
    camera = bpy.context.scene.camera = bpy.context.object
    camera.rotation_euler = (Vector(scene.target) - camera.location).to_track_quat("-Z", "Y").to_euler()
    camera.data.lens = scene.lens
    cycles, render = bpy.context.scene.cycles, bpy.context.scene.render
    render.engine = "CYCLES"
    cycles.use_denoising = cycles.use_adaptive_sampling = False
    cycles.max_bounces = 0
    render.threads_mode, render.threads = "FIXED", 2
    render.resolution_percentage = 100
    if hasattr(render.image_settings, "media_type"):
        render.image_settings.media_type = "MULTI_LAYER_IMAGE"
    settings = render.image_settings
    settings.file_format, settings.color_depth, settings.exr_codec = "OPEN_EXR_MULTILAYER", "32", "ZIP"
    for wanted in ("z", "position", "normal", "uv"):
        setattr(bpy.context.scene.view_layers[0], "use_pass_" + wanted, True)
    return bump


def render(size, samples, filter_width):
    """The channels of a picture by their names, as they are filtered by a box that many pixels wide."""
    scene = bpy.context.scene
    scene.cycles.samples = samples
    scene.cycles.pixel_filter_type, scene.cycles.filter_width = "BOX", filter_width
    scene.render.resolution_x, scene.render.resolution_y = size
    scene.render.filepath = f"{bpy.app.tempdir}/frame.exr"
    bpy.ops.render.render(write_still=True)
    channels, file, part = {}, oiio.ImageInput.open(scene.render.filepath), 0
    while file.seek_subimage(part, 0):
        pixels = file.read_image(part, 0, 0, file.spec().nchannels, "float")
        channels.update({name: pixels[..., i].copy() for i, name in enumerate(file.spec().channelnames)})
        part += 1
    file.close()
    return channels


def _rounded(values, step):
    return (np.round(values / step) * step).astype(np.float32)


def write(stem, size, bare, bumped, software):
    """STEM.exr and STEM.camera.json. bare, bumped: channels without and with the bumps, of `size`. Depth and UV are rounded to 2^-16 of
    the depth and 2^-20, normals to half floats (0.03 degrees): the last bits do not compress."""
    camera = bpy.context.scene.camera
    view = camera.matrix_world.inverted()
    projection = camera.calc_matrix_camera(bpy.context.evaluated_depsgraph_get(), x=size[0], y=size[1])
    with open(stem + ".camera.json", "w") as file:
        rows = lambda m: "[\n" + ",\n".join("  " + json.dumps(list(r)) for r in m) + "\n ]"
        file.write(f'{{\n "width": {size[0]},\n "height": {size[1]},\n "view": {rows(view)},\n "proj": {rows(projection)}\n}}\n')

    depth = bare["ViewLayer.Depth.Z"]
    planes = {"Depth.Z": _rounded(depth, np.exp2(np.floor(np.log2(np.minimum(depth, 1e9))) - 16))}
    planes.update({"UV." + c: _rounded(bare["ViewLayer.UV." + c], 2.0**-20) for c in "UV"})
    planes.update({"Normal." + c: bare["ViewLayer.Normal." + c] for c in "XYZ"})
    planes.update({"BumpedNormal." + c: bumped["ViewLayer.Normal." + c] for c in "XYZ"})
    spec = oiio.ImageSpec(*size, len(planes), "float")
    spec.channelnames = ["ViewLayer." + n for n in planes]
    spec.channelformats = tuple(oiio.TypeDesc("half" if "Normal" in n else "float") for n in planes)
    spec.attribute("compression", "zip:9")
    spec.attribute("Software", software)
    spec.attribute("DateTime", "2000:01:01 00:00:00")  # a fixed date: the same input gives the same bytes
    file = oiio.ImageOutput.create(stem + ".exr")
    if not file.open(stem + ".exr", spec) or not file.write_image(np.stack(list(planes.values()), -1)):
        sys.exit(file.geterror())
    file.close()

    # --- check: the points are those of this camera's pixels ---
    seen = depth < 1e9
    p = np.stack([bare["ViewLayer.Position." + c][seen] for c in "XYZ"] + [np.ones(seen.sum())], axis=-1)
    clip = p @ (np.array(projection) @ np.array(view)).T
    j, i = np.nonzero(seen)
    residual = np.hypot((clip[:, 0] / clip[:, 3] + 1) / 2 * size[0] - i - 0.5,
                        (1 - clip[:, 1] / clip[:, 3]) / 2 * size[1] - j - 0.5)
    print(f"{stem}: {seen.mean():.1%} covered; reprojection p50 {np.median(residual):.5f}, max {residual.max():.5f} pixel")
    if residual.max() > 0.02:
        sys.exit("the camera misses")
