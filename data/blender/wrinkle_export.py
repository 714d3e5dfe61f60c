"""Sets a Blender scene up for wrinkle: passes, cameras, lights and a scene.toml to start from. Blender 3.4 to 5.x, Cycles.

As a script, which leaves the .blend file as it is:

    blender -b shot.blend -P wrinkle_export.py -- --output out [--frames 1-10] [--render] [--light-groups] [--keep-bumps]

As an add-on: Edit, Preferences, Add-ons, Install from Disk; then Render Properties, wrinkle.

A view layer "wrinkle_data" gets the passes that have to be unfiltered, with one sample; the first view layer keeps the picture.
Bump and Normal Map nodes fed by an image become layers of scene.toml; unless --keep-bumps is given, the script takes them out of
the materials, as Cycles' Normal pass has their bumps in it already. What has no counterpart is listed in scene.toml.
"""
import argparse
import json
import math
import os
import sys

import bpy

bl_info = {
    "name": "wrinkle export",
    "author": "wrinkle",
    "version": (0, 2, 0),
    "blender": (3, 4, 0),
    "location": "Render Properties > wrinkle",
    "description": "Passes, cameras, lights and a starter scene for wrinkle",
    "category": "Render",
}

DATA_LAYER = "wrinkle_data"


# --- Passes -------------------------------------------------------------------------------------------------------------


def copy_exclusions(source, target):
    """Layer collections that the picture leaves out are left out of the data."""
    for child in source.children:
        twin = target.children.get(child.name)
        if twin is None:
            continue
        for name in ("exclude", "holdout", "indirect_only", "hide_viewport"):
            setattr(twin, name, getattr(child, name))
        copy_exclusions(child, twin)


def beauty_layer(scene):
    return next(layer for layer in scene.view_layers if layer.name != DATA_LAYER)


def set_up_passes(scene, light_groups=False):
    """Turns passes on, and returns what else the user should know."""
    notes = []
    beauty = beauty_layer(scene)
    beauty.use_pass_combined = True
    for name in ("diffuse_color", "glossy_direct", "glossy_indirect", "glossy_color"):
        setattr(beauty, "use_pass_" + name, True)
    data = scene.view_layers.get(DATA_LAYER) or scene.view_layers.new(DATA_LAYER)
    copy_exclusions(beauty.layer_collection, data.layer_collection)
    for name in ("position", "normal", "z", "uv", "object_index", "cryptomatte_object"):
        setattr(data, "use_pass_" + name, True)
    data.pass_cryptomatte_depth = 6
    data.samples = 1  # one sample is one point of one surface; an average of several is a normal that no surface has
    scene.render.engine = "CYCLES"
    image = scene.render.image_settings
    if hasattr(image, "media_type"):  # Blender 5
        image.media_type = "MULTI_LAYER_IMAGE"
    image.file_format = "OPEN_EXR_MULTILAYER"
    image.color_depth = "32"
    image.exr_codec = "ZIP"
    if light_groups:
        set_up_light_groups(scene, beauty)
    if bpy.app.version < (5, 0, 0):
        notes.append("Blender before 5 filters even a single sample: where edges matter, set Film, Pixel Filter to Box, 0.01 px")
    if scene.render.use_motion_blur:
        notes.append("motion blur is on, and scatters the data passes: turn it off, or the camera will not fit")
    if scene.camera and scene.camera.data.dof.use_dof:
        notes.append("depth of field is on, and scatters the data passes: turn it off, or the camera will not fit")
    if scene.render.use_border and scene.render.use_crop_to_border:
        notes.append("a render border that crops is set: camera files are for the whole picture, so turn Crop off")
    return notes


def set_up_light_groups(scene, beauty):
    """A light group for each light and one for the world, so that each light's own picture can be relit."""
    for item in scene.objects:
        if item.type == "LIGHT":
            if item.name not in beauty.lightgroups:
                beauty.lightgroups.add(name=item.name)
            item.lightgroup = item.name
    if scene.world:
        if "world" not in beauty.lightgroups:
            beauty.lightgroups.add(name="world")
        scene.world.lightgroup = "world"


# --- Cameras and lights -------------------------------------------------------------------------------------------------


def rows(matrix):
    return [list(row) for row in matrix]


def camera_json(scene, depsgraph):
    render = scene.render
    width = render.resolution_x * render.resolution_percentage // 100
    height = render.resolution_y * render.resolution_percentage // 100
    camera = scene.camera.evaluated_get(depsgraph)
    projection = camera.calc_matrix_camera(
        depsgraph, x=width, y=height, scale_x=render.pixel_aspect_x, scale_y=render.pixel_aspect_y
    )
    view = camera.matrix_world.normalized().inverted()  # a camera's scale does not count
    return {"width": width, "height": height, "view": rows(view), "proj": rows(projection)}


def numbers(values):
    return "[" + ", ".join("%.6g" % value for value in values) + "]"


def quoted(text):
    return json.dumps(text, ensure_ascii=False)


MOST_PICTURES = 16  # of lights, that wrinkle takes apart in one picture


def extent_of(item):
    """The shape of an area light. An ellipse becomes a rectangle of its area."""
    lamp, scale = item.data, item.matrix_world.to_scale()
    width = lamp.size * abs(scale.x)
    height = (lamp.size_y if lamp.shape in ("RECTANGLE", "ELLIPSE") else lamp.size) * abs(scale.y)
    width, height = max(width, 1e-4), max(height, 1e-4)
    if lamp.shape in ("DISK", "ELLIPSE"):
        if abs(width - height) < 1e-3 * width:
            return {"kind": "disc", "radius": width / 2}
        width, height = width * math.sqrt(math.pi) / 2, height * math.sqrt(math.pi) / 2
    return {"kind": "rectangle", "size": [width, height], "up": list(item.matrix_world.normalized().col[1])[:3]}


def light_values(item, beauty, light_groups):
    """The keys of a [[light]]. Watts become radiant intensity: P / 4 pi, along an area light P / pi. With light groups it has
    a picture of its own."""
    lamp = item.data
    values = {}
    energy = lamp.energy * 2 ** getattr(lamp, "exposure", 0)
    color = list(lamp.color)
    if getattr(lamp, "use_temperature", False):
        color = [c * t for c, t in zip(color, lamp.temperature_color)]
    along = [-item.matrix_world.normalized().col[2][k] for k in range(3)]
    if lamp.type == "SUN":
        values.update(kind="sun", direction=along, intensity=energy)
        if lamp.angle > 0:
            values.update(angle=min(math.degrees(lamp.angle), 170.0))
    elif lamp.type == "AREA":
        values.update(position=list(item.matrix_world.translation), direction=along, intensity=energy / math.pi)
        values.update(extent_of(item))
    elif lamp.type in ("POINT", "SPOT"):
        values.update(
            kind="spot" if lamp.type == "SPOT" else "point",
            position=list(item.matrix_world.translation),
            intensity=energy / (4 * math.pi),
        )
        if lamp.type == "POINT" and lamp.shadow_soft_size > 0:
            values.update(kind="sphere", radius=lamp.shadow_soft_size)
        if lamp.type == "SPOT":
            outer = min(math.degrees(lamp.spot_size) / 2, 89.0)
            values.update(
                direction=along,
                inner_angle=outer * min(math.sqrt(1 - min(lamp.spot_blend, 0.99)), 0.999),
                outer_angle=outer,
            )
    values["color"] = color
    if light_groups:
        values["picture"] = "%s.Combined_%s" % (beauty, item.name)
    return values


def light_toml(item, beauty, light_groups):
    lines = ["[[light]]                                   # " + item.name]
    for key, value in light_values(item, beauty, light_groups).items():
        text = quoted(value) if isinstance(value, str) else numbers(value) if isinstance(value, list) else "%.6g" % value
        lines.append("%s = %s" % (key, text))
    return "\n".join(lines)


def lamps_of(scene):
    return [item for item in scene.objects if item.type == "LIGHT" and not item.hide_render]


def lights_json(scene, light_groups):
    """What `lights = "frame.####.lights.json"` of [lighting] reads: the lights of one frame, as [[light]]s."""
    beauty = beauty_layer(scene).name
    lamps = enumerate(lamps_of(scene))
    return {"lights": [light_values(item, beauty, light_groups and place < MOST_PICTURES) for place, item in lamps]}


def world_radiance(world):
    """The background's colour times strength, and whether that is all there is to it."""
    if world is None:
        return [0.0, 0.0, 0.0], True
    tree = world.node_tree
    background = next((n for n in tree.nodes if n.type == "BACKGROUND"), None) if tree else None
    if background is None:
        return list(world.color), True
    color, strength = background.inputs["Color"], background.inputs["Strength"]
    plain = not color.is_linked and not strength.is_linked
    return [c * strength.default_value for c in color.default_value[:3]], plain


# --- Bumps of materials -------------------------------------------------------------------------------------------------


def source_of(socket):
    """The node that feeds a socket, through reroutes; none."""
    while socket.is_linked:
        node = socket.links[0].from_node
        if node.type != "REROUTE":
            return node
        socket = node.inputs[0]
    return None


def output_of(socket):
    """The output that feeds a linked socket, through reroutes."""
    link = socket.links[0]
    return link.from_socket if link.from_node.type != "REROUTE" else output_of(link.from_node.inputs[0])


class Unknown(Exception):
    """A node that has no counterpart in wrinkle."""


def number_of(socket, what):
    if socket.is_linked:
        raise Unknown("%s comes from another node" % what)
    return socket.default_value


def require_rendered_uv(name, rendered):
    """The UV pass has one map of each mesh, the one that is rendered."""
    if name and any(name != other for other in rendered):
        raise Unknown("the UV map %r, which is not the one that is rendered" % name)


def mapping_of(image_node, rendered):
    """The uv table of an image's coordinates."""
    node, parts = source_of(image_node.inputs["Vector"]), []
    if node is not None and node.type == "MAPPING":
        if node.vector_type not in ("POINT", "TEXTURE"):
            raise Unknown("mapping of type %s" % node.vector_type)
        scale = number_of(node.inputs["Scale"], "the mapping's scale")
        offset = number_of(node.inputs["Location"], "the mapping's location")
        angles = number_of(node.inputs["Rotation"], "the mapping's rotation")
        if node.vector_type == "TEXTURE" or abs(angles[0]) + abs(angles[1]) > 1e-6:
            raise Unknown("a mapping that is not scale, rotation about z, then location")
        if abs(scale[0] - 1) + abs(scale[1] - 1) > 1e-6:
            parts.append("scale = " + numbers(scale[:2]))
        if abs(angles[2]) > 1e-6:
            parts.append("rotation = %.6g" % math.degrees(angles[2]))
        if abs(offset[0]) + abs(offset[1]) > 1e-6:
            parts.append("offset = " + numbers(offset[:2]))
        node = source_of(node.inputs["Vector"])
    if node is not None and node.type not in ("TEX_COORD", "UVMAP"):
        raise Unknown("coordinates of %s" % node.name)
    if node is not None and node.type == "UVMAP":
        require_rendered_uv(node.uv_map, rendered)
    if node is not None and node.type == "TEX_COORD":
        used = [link.from_socket.name for output in node.outputs for link in output.links]
        if any(name != "UV" for name in used):
            raise Unknown("%s coordinates" % ", ".join(sorted(set(used))))
    return "{ %s }" % ", ".join(parts) if parts else ""


def image_of(socket, what):
    node = source_of(socket)
    if node is None or node.type != "TEX_IMAGE" or node.image is None:
        raise Unknown("%s is no image%s" % (what, "" if node is None else " but " + node.name))
    if node.image.source == "TILED":
        raise Unknown("an image of UDIM tiles")
    if output_of(socket).name != "Color":
        raise Unknown("%s is the %s of an image" % (what, output_of(socket).name.lower()))
    if node.projection != "FLAT":
        raise Unknown("an image projected as a %s" % node.projection.lower())
    if node.extension not in ("REPEAT", "EXTEND"):
        raise Unknown("an image continued by %s" % node.extension.lower())
    space = node.image.colorspace_settings
    if not space.is_data and not space.name.startswith("Linear"):
        raise Unknown("an image in the colour space %s; set it to Non-Color" % space.name)
    return node


def image_path(image, folder):
    """The image's file; one that is packed into the .blend file is written out."""
    path = bpy.path.abspath(image.filepath, library=image.library) if image.filepath else ""
    if path and os.path.exists(path) and not image.packed_file:
        return os.path.relpath(path, folder)
    name = bpy.path.clean_name(image.name) + (".exr" if image.is_float else ".png")
    copy = image.copy()
    copy.filepath_raw, copy.file_format = os.path.join(folder, name), "OPEN_EXR" if image.is_float else "PNG"
    copy.save()
    bpy.data.images.remove(copy)
    return name


def layer_of(node, folder, rendered):
    """The lines of a [[layer]] that bump as this node does; `rendered` names the UV maps of the meshes that have it."""
    if node.type == "BUMP":
        image = image_of(node.inputs["Height"], "the height")
        strength = number_of(node.inputs["Strength"], "the strength")
        distance = number_of(node.inputs["Distance"], "the distance")
        scale = strength * distance * (-1 if node.invert else 1)
        kind = "height_map"
    else:
        if node.space != "TANGENT":
            raise Unknown("normals of the space %s" % node.space)
        require_rendered_uv(node.uv_map, rendered)
        image = image_of(node.inputs["Color"], "the colour")
        scale, kind = number_of(node.inputs["Strength"], "the strength"), "normal_map"
    if abs(scale) < 1e-9:
        return None
    lines = ['kind = "%s"' % kind, "texture = " + quoted(image_path(image.image, folder)), "scale = %.6g" % abs(scale)]
    if scale < 0:
        lines.append('blend = "subtract"')
    uv = mapping_of(image, rendered)
    if uv:
        lines.append("uv = " + uv)
    if image.extension != "REPEAT":
        lines.append('wrap = "clamp"')
    return lines


def bumps_of(material):
    """Bump and Normal Map nodes that reach a shader, the deepest first, since a Bump node may follow another."""
    found = []

    def visit(socket):
        node = source_of(socket)
        if node is None or node in found or node.mute:
            return
        if node.type == "BUMP":
            visit(node.inputs["Normal"])
        if node.type in ("BUMP", "NORMAL_MAP"):
            found.append(node)

    for node in material.node_tree.nodes if material.node_tree else []:
        if "Normal" in node.inputs and node.type not in ("BUMP", "NORMAL_MAP"):
            visit(node.inputs["Normal"])
    return found


def translate_bumps(scene, folder, keep_bumps):
    """Layers as TOML, and what could not be translated."""
    layers, untranslated, done = [], [], []
    for item in scene.objects:
        if item.type not in ("MESH", "CURVE", "SURFACE", "META", "FONT") or item.hide_render:
            continue
        maps = item.data.uv_layers if item.type == "MESH" else []
        rendered = [layer.name for layer in maps if layer.active_render]
        for material in {slot.material.name: slot.material for slot in item.material_slots if slot.material}.values():
            for node in bumps_of(material):
                where = "%s, %s, %s" % (item.name, material.name, node.name)
                try:
                    lines = layer_of(node, folder, rendered)
                except Unknown as reason:
                    untranslated.append("%s: %s" % (where, reason))
                    continue
                if lines is None:
                    continue
                if len(item.material_slots) > 1:
                    untranslated.append("%s: the layer covers the whole object, which has several materials" % where)
                mask = "mask = { cryptomatte = %s }" % quoted(item.name)
                layers.append("\n".join(["[[layer]]", "name = " + quoted("%s %d" % (where, len(layers) + 1))] + lines + [mask]))
                done.append((material, node))
    if not keep_bumps:
        for material, node in done:
            for output in node.outputs:
                for link in list(output.links):
                    material.node_tree.links.remove(link)
    return layers, untranslated


# --- scene.toml ---------------------------------------------------------------------------------------------------------


def scene_toml(scene, pattern, layers, untranslated, notes, light_groups):
    ambient, plain = world_radiance(scene.world)
    if not plain:
        notes = notes + ["the world is textured: ambient is a guess"]
    narrow = [item.name for item in scene.objects
              if item.type == "LIGHT" and item.data.type == "AREA" and item.data.spread < math.pi - 0.01]
    if narrow:
        notes = notes + ["area lights are taken to shine widely, with a spread of 180 degrees, but not so in the scene: "
                         + ", ".join(narrow)]
        plain = False
    lights = lamps_of(scene)
    text = ["# Written by wrinkle_export.py of Blender " + bpy.app.version_string]
    text += ["# note: " + note for note in notes]
    text += ["# not translated: " + line for line in untranslated]
    beauty = beauty_layer(scene).name
    text.append("""
[gbuffer]
file = %s
layer = "%s"
roles = { %s }

[camera]
file = %s
""" % (quoted(pattern + ".exr"), DATA_LAYER, roles_of(beauty), quoted(pattern + ".camera.json")))
    if layers:
        text.append("\n\n".join(layers))
    else:
        text.append("""[[layer]]                                   # no bumps were found; this one shows on everything
kind = "noise"
frequency = 8                               # cells per metre
scale = 0.02                                # metres of height""")
    text.append("\n[lighting]\nrelight = \"ratio\"")
    if lights and plain and not light_groups:  # then they are in the picture's units
        text.append("shadows = \"read\"")
    if any(ambient):
        text.append("ambient = " + numbers(ambient))
    elif not lights:
        text.append("# no lights were found: they are fitted to the picture")
    if lights and "#" in pattern:
        text.append("# lights = %s   # in place of each [[light]], where lights move" % quoted(pattern + ".lights.json"))
    for place, item in enumerate(lights):
        text.append("\n" + light_toml(item, beauty, light_groups and place < MOST_PICTURES))
    return "\n".join(text) + "\n"


def roles_of(beauty):
    """What the layer of the picture shows, by the names that its passes have in the file."""
    new = bpy.app.version >= (5, 0, 0)
    names = {"beauty": "Combined", "albedo": "Diffuse Color" if new else "DiffCol",
             "specular_direct": "Glossy Direct" if new else "GlossDir",
             "specular_indirect": "Glossy Indirect" if new else "GlossInd",
             "specular_color": "Glossy Color" if new else "GlossCol"}
    return ", ".join("%s = %s" % (role, quoted(beauty + "." + name)) for role, name in names.items())


def export(scene, folder, frames, light_groups=False, keep_bumps=True, render=False):
    """Writes everything into a folder, and returns notes."""
    if scene.camera is None:
        raise RuntimeError("the scene has no camera")
    os.makedirs(folder, exist_ok=True)
    notes = set_up_passes(scene, light_groups)
    layers, untranslated = translate_bumps(scene, folder, keep_bumps)
    for frame in frames:
        scene.frame_set(frame)
        stem = os.path.join(folder, "frame.%04d" % frame)
        with open(stem + ".camera.json", "w") as out:
            json.dump(camera_json(scene, bpy.context.evaluated_depsgraph_get()), out, indent=1)
        with open(stem + ".lights.json", "w", encoding="utf-8") as out:
            json.dump(lights_json(scene, light_groups), out, indent=1)
        if render:
            scene.render.filepath = stem + ".exr"
            bpy.ops.render.render(write_still=True, scene=scene.name)
    scene.render.filepath = os.path.join(folder, "frame.####")
    pattern = "frame.%04d" % frames[0] if len(frames) == 1 else "frame.####"
    with open(os.path.join(folder, "scene.toml"), "w", encoding="utf-8") as out:
        out.write(scene_toml(scene, pattern, layers, untranslated, notes, light_groups))
    return notes + ["not translated: " + line for line in untranslated]


# --- As a script --------------------------------------------------------------------------------------------------------


def frame_list(text):
    frames = []
    for part in text.split(","):
        first, _, last = part.partition("-")
        frames += range(int(first), int(last or first) + 1)
    return frames


def main(arguments):
    parser = argparse.ArgumentParser(prog="wrinkle_export.py", description="Write what wrinkle needs of this .blend file.")
    parser.add_argument("--output", required=True, help="folder, made if missing")
    parser.add_argument("--frames", default="", help="as 1-10 or 1,5,9; the current one")
    parser.add_argument("--render", action="store_true", help="render the frames, too")
    parser.add_argument("--light-groups", action="store_true", help="a light group for each light")
    parser.add_argument("--keep-bumps", action="store_true", help="leave translated bumps in the materials")
    options = parser.parse_args(arguments)
    scene = bpy.context.scene
    frames = frame_list(options.frames) if options.frames else [scene.frame_current]
    folder = os.path.abspath(options.output)
    for note in export(scene, folder, frames, options.light_groups, options.keep_bumps, options.render):
        print("wrinkle: " + note)
    print("wrinkle: " + os.path.join(folder, "scene.toml"))


# --- As an add-on -------------------------------------------------------------------------------------------------------


class WRINKLE_OT_export(bpy.types.Operator):
    """Turn passes on, and write cameras, lights and a starter scene.toml"""

    bl_idname = "wrinkle.export"
    bl_label = "Export for wrinkle"

    directory: bpy.props.StringProperty(subtype="DIR_PATH")
    animation: bpy.props.BoolProperty(name="All frames", description="A camera for each frame of the range")
    light_groups: bpy.props.BoolProperty(name="Light groups", description="A light group for each light")
    take_bumps: bpy.props.BoolProperty(
        name="Take bumps out", description="Disconnect the Bump and Normal Map nodes that became layers"
    )

    def invoke(self, context, event):
        context.window_manager.fileselect_add(self)
        return {"RUNNING_MODAL"}

    def execute(self, context):
        scene = context.scene
        current = scene.frame_current
        frames = list(range(scene.frame_start, scene.frame_end + 1)) if self.animation else [current]
        try:
            notes = export(scene, bpy.path.abspath(self.directory), frames, self.light_groups, not self.take_bumps)
        except (RuntimeError, OSError) as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        scene.frame_set(current)
        for note in notes:
            self.report({"WARNING"}, note)
        self.report({"INFO"}, "Now render; then: wrinkle run scene.toml")
        return {"FINISHED"}


class WRINKLE_PT_panel(bpy.types.Panel):
    bl_label = "wrinkle"
    bl_space_type, bl_region_type, bl_context = "PROPERTIES", "WINDOW", "render"

    def draw(self, context):
        self.layout.operator(WRINKLE_OT_export.bl_idname)


CLASSES = (WRINKLE_OT_export, WRINKLE_PT_panel)


def register():
    for each in CLASSES:
        bpy.utils.register_class(each)


def unregister():
    for each in reversed(CLASSES):
        bpy.utils.unregister_class(each)


if __name__ == "__main__":
    main(sys.argv[sys.argv.index("--") + 1:] if "--" in sys.argv else [])
