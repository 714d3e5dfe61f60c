"""Render the courtyard: unfiltered data passes, a lit picture on the same pixels, and the camera beside them.

    blender -b --factory-startup -P render_gbuffer.py -- WIDTH HEIGHT SAMPLES STEM

writes STEM.data.exr (one sample, box filter of 0.01 pixel: every value belongs to one point of one surface),
STEM.beauty.exr (SAMPLES samples through the same pixel centres, so that edges agree with the data) and
STEM.camera.json. pack_gbuffer.py makes one file of the two. Blender 3.4, two cores: seconds for the data, one or two
minutes for 96 samples at 960x540.

World: metres, z up. Objects by pass index: 1 Suzanne, 2 Torus, 3 Rock, 4 Ground, 5 Wall. The sun travels along
SUN_DIRECTION with SUN_IRRADIANCE; the scenes in ../scenes repeat both.
"""
import json
import math
import sys

import bpy
from mathutils import Vector

SUN_DIRECTION = Vector((0.66, 0.42, -0.62))
SUN_COLOR = (1.0, 0.93, 0.82)
SUN_IRRADIANCE = 3.6
GROUND_RADIUS = 2000.0  # far enough to end within two pixels of the horizon
GROUND_UV_METRES = 100.0  # metres per unit of the ground's UV, (0, 0) at the world's origin

width, height, samples, stem = sys.argv[sys.argv.index("--") + 1:]
width, height, samples = int(width), int(height), int(samples)

bpy.ops.wm.read_factory_settings(use_empty=True)
scene = bpy.context.scene


def finish(obj, name, index, color, roughness, smooth=True):
    obj.name, obj.pass_index = name, index
    obj.data.name = name
    for face in obj.data.polygons:
        face.use_smooth = smooth
    material = bpy.data.materials.new(name)
    material.use_nodes = True
    shader = material.node_tree.nodes["Principled BSDF"]
    shader.inputs["Base Color"].default_value = (*color, 1)
    shader.inputs["Roughness"].default_value = roughness
    obj.data.materials.append(material)
    return obj


def roughen(obj, noise_scale, strength):
    texture = bpy.data.textures.new(obj.name, "CLOUDS")
    texture.noise_scale = noise_scale
    modifier = obj.modifiers.new("roughen", "DISPLACE")
    modifier.texture, modifier.strength, modifier.mid_level = texture, strength, 0.5


def mesh(vertices, faces, uv_of):
    """A mesh object whose UV of every corner is uv_of(vertex index, face index)."""
    data = bpy.data.meshes.new("mesh")
    data.from_pydata(vertices, [], faces)
    layer = data.uv_layers.new(name="UVMap")
    for face in data.polygons:
        for loop in face.loop_indices:
            layer.data[loop].uv = uv_of(data.loops[loop].vertex_index, face.index)
    obj = bpy.data.objects.new("mesh", data)
    scene.collection.objects.link(obj)
    return obj


def ground(steps=260):
    """Low swells near the origin, flat further out; cells grow with the distance."""
    def spread(i):
        t = 2 * i / steps - 1
        return math.copysign(24 * abs(t) + (GROUND_RADIUS - 24) * abs(t) ** 7, t)

    def z(x, y):
        swell = math.sin(0.45 * x + 0.3) * math.sin(0.37 * y + 1.1) + 0.5 * math.sin(0.8 * x - 0.6 * y)
        return -0.05 + 0.09 * swell / (1 + (x * x + y * y) / 30 ** 2) ** 2

    line = [spread(i) for i in range(steps + 1)]
    vertices = [(x, y, z(x, y)) for y in line for x in line]
    row = steps + 1
    faces = [(j * row + i, j * row + i + 1, (j + 1) * row + i + 1, (j + 1) * row + i)
             for j in range(steps) for i in range(steps)]
    return mesh(vertices, faces, lambda v, f: (vertices[v][0] / GROUND_UV_METRES, vertices[v][1] / GROUND_UV_METRES))


def wall(lower, upper):
    """A box whose UVs are metres along and up each side: front, back, left, right, top."""
    (x0, y0, z0), (x1, y1, z1) = lower, upper
    vertices = [(x, y, z) for z in (z0, z1) for y in (y0, y1) for x in (x0, x1)]
    faces = [(0, 1, 5, 4), (3, 2, 6, 7), (2, 0, 4, 6), (1, 3, 7, 5), (4, 5, 7, 6)]
    axes = [(0, 2), (0, 2), (1, 2), (1, 2), (0, 1)]
    turned = [1, -1, -1, 1, 1]  # keeps u running to the right seen from outside
    return mesh(vertices, faces, lambda v, f: (turned[f] * vertices[v][axes[f][0]] + 8, vertices[v][axes[f][1]] + 1))


bpy.ops.mesh.primitive_monkey_add(size=2, location=(0, 0, 1.0), rotation=(math.radians(-20), 0, math.radians(14)))
suzanne = finish(bpy.context.object, "Suzanne", 1, (0.58, 0.33, 0.19), 0.45)
suzanne.modifiers.new("smooth", "SUBSURF").render_levels = 3
bpy.ops.mesh.primitive_torus_add(location=(2.5, -0.2, 0.36), rotation=(math.radians(8), math.radians(-6), 0),
                                 major_radius=0.9, minor_radius=0.36, major_segments=128, minor_segments=64)
finish(bpy.context.object, "Torus", 2, (0.16, 0.30, 0.42), 0.35)
bpy.ops.mesh.primitive_ico_sphere_add(subdivisions=7, radius=0.95, location=(-2.5, 0.2, 0.62))
roughen(finish(bpy.context.object, "Rock", 3, (0.37, 0.36, 0.33), 0.7), 0.8, 0.55)
finish(ground(), "Ground", 4, (0.36, 0.31, 0.25), 0.65)
finish(wall((-5.2, 3.4, -0.4), (5.4, 3.8, 1.15)), "Wall", 5, (0.47, 0.21, 0.14), 0.75, smooth=False)

bpy.ops.object.camera_add(location=(1.3, -7.2, 2.5))
camera = bpy.context.object
camera.rotation_euler = (Vector((0.05, 0, 0.72)) - camera.location).to_track_quat("-Z", "Y").to_euler()
camera.data.lens, camera.data.clip_end = 36, 10000
scene.camera = camera

bpy.ops.object.light_add(type="SUN", rotation=SUN_DIRECTION.to_track_quat("-Z", "Y").to_euler())
sun = bpy.context.object.data
sun.energy, sun.color, sun.angle = SUN_IRRADIANCE, SUN_COLOR, math.radians(0.5)

world = scene.world = bpy.data.worlds.new("sky")
world.use_nodes = True
nodes, links = world.node_tree.nodes, world.node_tree.links
direction = nodes.new("ShaderNodeTexCoord")
split = nodes.new("ShaderNodeSeparateXYZ")
ramp = nodes.new("ShaderNodeValToRGB")
links.new(direction.outputs["Generated"], split.inputs[0])
links.new(split.outputs["Z"], ramp.inputs["Fac"])
links.new(ramp.outputs["Color"], nodes["Background"].inputs["Color"])
ramp.color_ramp.elements[0].color = (0.72, 0.74, 0.74, 1)
ramp.color_ramp.elements[1].position, ramp.color_ramp.elements[1].color = 0.55, (0.20, 0.36, 0.62, 1)
nodes["Background"].inputs["Strength"].default_value = 0.85

scene.render.engine = "CYCLES"
scene.cycles.seed = 1
scene.cycles.pixel_filter_type, scene.cycles.filter_width = "BOX", 0.01
scene.cycles.use_denoising = scene.cycles.use_adaptive_sampling = False
scene.cycles.max_bounces = 3
scene.render.threads_mode, scene.render.threads = "FIXED", 2
scene.render.resolution_x, scene.render.resolution_y, scene.render.resolution_percentage = width, height, 100
settings = scene.render.image_settings
settings.file_format, settings.color_depth, settings.exr_codec = "OPEN_EXR_MULTILAYER", "32", "ZIP"
layer = scene.view_layers[0]
data_passes = ("z", "position", "normal", "uv", "object_index", "diffuse_color", "cryptomatte_object")
layer.pass_cryptomatte_depth = 2

for kind, count in (("data", 1), ("beauty", samples)):
    for wanted in data_passes:
        setattr(layer, "use_pass_" + wanted, kind == "data")
    scene.cycles.samples = count
    scene.render.filepath = f"{stem}.{kind}.exr"
    bpy.ops.render.render(write_still=True)

view = camera.matrix_world.inverted()
projection = camera.calc_matrix_camera(bpy.context.evaluated_depsgraph_get(), x=width, y=height)
with open(stem + ".camera.json", "w") as file:
    rows = lambda m: "[\n" + ",\n".join("  " + json.dumps(list(r)) for r in m) + "\n ]"
    file.write(f'{{\n "width": {width},\n "height": {height},\n "view": {rows(view)},\n "proj": {rows(projection)}\n}}\n')
