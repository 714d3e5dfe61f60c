"""Renders Blender's open scene by Cycles, and gives the channels of its passes."""
import sys
import tempfile

import bpy

sys.path.append(bpy.utils.system_resource("PYTHON", path="lib/python3.11/site-packages"))  # bpy brings it along
import OpenImageIO as oiio  # noqa: E402


def prepare(passes):
    """passes: Blender's names of those wanted beside depth, normal, UV and object index, as in use_pass_NAME."""
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    scene.cycles.use_denoising = scene.cycles.use_adaptive_sampling = False
    scene.render.resolution_percentage = 100
    view = scene.view_layers[0]
    for wanted in ("z", "normal", "uv", "object_index", *passes):
        setattr(view, "use_pass_" + wanted, True)
    view.pass_cryptomatte_depth = 4
    settings = scene.render.image_settings
    try:
        settings.media_type = "MULTI_LAYER_IMAGE"
    except AttributeError:
        pass  # before Blender 5
    settings.file_format, settings.color_depth, settings.exr_codec = "OPEN_EXR_MULTILAYER", "32", "ZIP"


def render(size, samples, seed):
    """The planes by their channels' names, and what the header says of Cryptomatte. One sample is taken in the middle of a pixel."""
    scene = bpy.context.scene
    scene.render.resolution_x, scene.render.resolution_y = size
    scene.cycles.samples, scene.cycles.seed = samples, seed
    scene.cycles.pixel_filter_type = "BOX" if samples == 1 else "BLACKMAN_HARRIS"
    with tempfile.TemporaryDirectory() as folder:
        scene.render.filepath = folder + "/frame.exr"
        bpy.ops.render.render(write_still=True)
        file, channels, told, part = oiio.ImageInput.open(scene.render.filepath), {}, {}, 0
        while file.seek_subimage(part, 0):
            spec = file.spec()
            pixels = file.read_image(part, 0, 0, spec.nchannels, "float")
            channels.update({n: pixels[..., i].copy() for i, n in enumerate(spec.channelnames)})
            told.update({a.name: a.value for a in spec.extra_attribs if a.name.startswith("cryptomatte/")})
            part += 1
        file.close()
    return channels, told
