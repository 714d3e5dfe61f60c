"""Record what data/blender/wrinkle_export.py writes of Blender's default scene, whose cube gets a Bump node.

    blender -b --factory-startup -P record_blender.py -- FOLDER

writes FOLDER/frame.0001.exr, FOLDER/frame.0001.camera.json and FOLDER/scene.toml. FOLDER/rerendered.exr is the same view with the bump left
in the material, one sample a pixel: what Cycles makes of it. The recorded files are of Blender 5.0.1 as a Python module (`bpy`).
"""
import os
import runpy
import sys

import bpy

folder = os.path.abspath(sys.argv[sys.argv.index("--") + 1])
here = os.path.dirname(os.path.abspath(__file__))
export = runpy.run_path(os.path.join(here, "..", "blender", "wrinkle_export.py"), run_name="wrinkle_export")["export"]

bpy.ops.wm.read_factory_settings()
scene = bpy.context.scene
scene.render.resolution_x, scene.render.resolution_y = 64, 36
scene.cycles.samples = 16

image = bpy.data.images.load(os.path.join(here, "..", "textures", "swell_height.png"))
image.colorspace_settings.name = "Non-Color"
tree = bpy.data.objects["Cube"].active_material.node_tree
texture, bump, mapping, coordinates = (
    tree.nodes.new("ShaderNode" + kind) for kind in ("TexImage", "Bump", "Mapping", "TexCoord")
)
texture.image = image
bump.inputs["Strength"].default_value, bump.inputs["Distance"].default_value = 0.5, 0.2
mapping.inputs["Scale"].default_value = (2, 2, 1)
tree.links.new(coordinates.outputs["UV"], mapping.inputs["Vector"])
tree.links.new(mapping.outputs["Vector"], texture.inputs["Vector"])
tree.links.new(texture.outputs["Color"], bump.inputs["Height"])
tree.links.new(bump.outputs["Normal"], tree.nodes["Principled BSDF"].inputs["Normal"])

export(scene, folder, [1], keep_bumps=True, render=True)
os.replace(os.path.join(folder, "frame.0001.exr"), os.path.join(folder, "rerendered.exr"))
for note in export(scene, folder, [1], keep_bumps=False, render=True):
    print(note)
