"""Parts of the scenes that frames are rendered of, in Blender: surfaces with bumps that can be switched, lights, a sky, a camera.

Needs PyPI's bpy 5.0 for Python 3.11. Each function adds to the open file's scene.
"""
import math
import os

import bpy
from mathutils import Vector

bumps = []  # links, from, to: of each bumped material, since clear()


def clear():
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bumps.clear()


def _bump(nodes, links, shader, texture, uv_scale, distance):
    uv, mapping, image, bump = (nodes.new("ShaderNode" + kind) for kind in ("UVMap", "Mapping", "TexImage", "Bump"))
    mapping.inputs["Scale"].default_value = (*uv_scale, 1)
    image.image = bpy.data.images.load(os.path.abspath(texture), check_existing=True)
    image.image.colorspace_settings.name = "Non-Color"
    image.interpolation, image.extension = "Cubic", "REPEAT"
    bump.inputs["Strength"].default_value, bump.inputs["Distance"].default_value = 1, distance
    links.new(uv.outputs["UV"], mapping.inputs["Vector"])
    links.new(mapping.outputs["Vector"], image.inputs["Vector"])
    links.new(image.outputs["Color"], bump.inputs["Height"])
    bumps.append((links, bump.outputs["Normal"], shader.inputs["Normal"]))


def dress(name, index, colour, roughness, metallic=0, alpha=1, bump=None, smooth=True):
    """Names the object that was made last and gives it a material. bump: (texture, UV scale, distance)."""
    obj = bpy.context.object
    obj.name, obj.pass_index = name, index
    for face in obj.data.polygons:
        face.use_smooth = smooth
    material = bpy.data.materials.new(name)
    material.use_nodes = True
    nodes, links = material.node_tree.nodes, material.node_tree.links
    shader = nodes["Principled BSDF"]
    for key, value in (("Base Color", (*colour, 1)), ("Roughness", roughness), ("Metallic", metallic), ("Alpha", alpha)):
        shader.inputs[key].default_value = value
    if bump:
        _bump(nodes, links, shader, *bump)
    obj.data.materials.append(material)


def switch_bumps(on):
    for links, normal, target in bumps:
        for link in list(target.links):
            links.remove(link)
        if on:
            links.new(normal, target)


def ground():
    """40 m wide, with UV in metres."""
    bpy.ops.mesh.primitive_plane_add(size=40)
    for loop in bpy.context.object.data.uv_layers[0].data:
        loop.uv = (loop.uv[0] * 40, loop.uv[1] * 40)


def box(location, size, turn):
    """Turned around z by degrees, with UV in metres on each face, the second along z where the face is upright."""
    bpy.ops.mesh.primitive_cube_add(location=location, rotation=(0, 0, math.radians(turn)))
    mesh = bpy.context.object.data
    for vertex in mesh.vertices:
        vertex.co = [c * s / 2 for c, s in zip(vertex.co, size)]
    for face in mesh.polygons:
        upright = abs(face.normal.z) < 0.5
        across = Vector((-face.normal.y, face.normal.x, 0)) if upright else Vector((1, 0, 0))
        along = Vector((0, 0, 1)) if upright else Vector((0, 1, 0))
        for k in face.loop_indices:
            place = mesh.vertices[mesh.loops[k].vertex_index].co
            mesh.uv_layers[0].data[k].uv = (place.dot(across), place.dot(along))


def sun(direction, strength, colour):
    """direction: the way that it travels."""
    bpy.ops.object.light_add(type="SUN")
    light = bpy.context.object
    light.rotation_euler = (-Vector(direction)).to_track_quat("Z", "Y").to_euler()
    light.data.energy, light.data.angle, light.data.color = strength, math.radians(0.53), colour
    _group(light, "sun")


def lamp(location, watts, colour, radius):
    bpy.ops.object.light_add(type="POINT", location=location)
    light = bpy.context.object
    light.data.energy, light.data.color, light.data.shadow_soft_size = watts, colour, radius
    _group(light, "lamp")


def _group(light, name):
    bpy.context.scene.view_layers[0].lightgroups.add(name=name)
    light.lightgroup = name


def sky(horizon, zenith, strength):
    """Two colours, between them linear in the sine of the elevation; below the horizon the horizon's."""
    world = bpy.context.scene.world = bpy.data.worlds.new("World")
    world.use_nodes = True
    background, nodes, links = world.node_tree.nodes["Background"], world.node_tree.nodes, world.node_tree.links
    coordinates, split, ramp = (nodes.new("ShaderNode" + k) for k in ("TexCoord", "SeparateXYZ", "MapRange"))
    ramp.inputs["From Min"].default_value = 0
    mix = nodes.new("ShaderNodeMix")
    mix.data_type = "RGBA"
    mix.inputs["A"].default_value, mix.inputs["B"].default_value = (*horizon, 1), (*zenith, 1)
    links.new(coordinates.outputs["Generated"], split.inputs[0])
    links.new(split.outputs["Z"], ramp.inputs["Value"])
    links.new(ramp.outputs["Result"], mix.inputs["Factor"])
    links.new(mix.outputs["Result"], background.inputs["Color"])
    background.inputs["Strength"].default_value = strength


def camera(location, target, lens):
    bpy.ops.object.camera_add(location=location)
    made = bpy.context.scene.camera = bpy.context.object
    made.rotation_euler = (Vector(target) - made.location).to_track_quat("-Z", "Y").to_euler()
    made.data.lens = lens
