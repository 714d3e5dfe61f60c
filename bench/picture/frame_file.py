"""Writes frames and their cameras as small as what they are for allows."""
import json

import numpy as np
import OpenImageIO as oiio  # Blender's, which blender_render found

WHOLE = (".Depth.Z", ".UV.U", ".UV.V", *(f".CryptoObject0{k}.{c}" for k in range(3) for c in "rgRGbaBA"))


def _rounded(name, plane):
    """Last bits do not compress: depth to 2^-16 m, UV to 2^-18."""
    if name.endswith(".Depth.Z"):
        return np.where(plane < 1e9, np.round(plane * 2.0**16) / 2.0**16, plane)
    return np.round(plane * 2.0**18) / 2.0**18 if ".UV." in name else plane


def write_frame(path, planes, told):
    """planes: name to pixels; floats where WHOLE says so, else half floats. told: attributes of the header."""
    names = list(planes)
    height, width = planes[names[0]].shape
    spec = oiio.ImageSpec(width, height, len(names), "float")
    spec.channelnames = names
    spec.channelformats = tuple(oiio.TypeDesc("float" if n.endswith(WHOLE) else "half") for n in names)
    spec.attribute("compression", "zip:9")
    spec.attribute("Software", "Blender 5.0, bench/picture/render.py")
    for name, value in told.items():
        spec.attribute(name, value)
    file = oiio.ImageOutput.create(path)
    pixels = np.stack([_rounded(n, planes[n]) for n in names], axis=2).astype(np.float32)
    if not file.open(path, spec) or not file.write_image(pixels):
        raise SystemExit(file.geterror())
    file.close()


def write_camera(path, scene_camera, depsgraph, size):
    projection = scene_camera.calc_matrix_camera(depsgraph, x=size[0], y=size[1])
    view = scene_camera.matrix_world.inverted()
    with open(path, "w") as file:
        json.dump({"width": size[0], "height": size[1], "view": [list(row) for row in view],
                   "proj": [list(row) for row in projection]}, file, indent=1)
