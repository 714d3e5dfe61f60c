"""Bump mapping after the render: layers added up as surface gradients over a finished frame's G-buffer.

    import wrinkle

    scene = wrinkle.Scene(layers=[wrinkle.Noise(frequency=8, octaves=4, scale=0.02)])
    camera = wrinkle.Camera.look_at(eye=(0, -5, 2), target=(0, 0, 0), up=(0, 0, 1), fov_y=0.9, aspect=16 / 9)
    gbuffer = wrinkle.GBuffer(camera=camera, depth=depth, normal=normal)   # numpy: (height, width), (height, width, 3)
    normal = wrinkle.evaluate(scene, gbuffer)["normal"]

There is a class for each kind of layer of the scene format: wrinkle.HeightMap for "height_map", wrinkle.Noise for
"noise", ... Lengths are metres, angles of scenes degrees, colours linear, normals unit vectors in world space. What goes
wrong is a wrinkle.Error, whose text says where, what was found, what was expected and what to do.
"""

from ._wrinkle import Camera, Device, DeviceInfo, Error, cryptomatte_id, devices
from .functions import eval, functions
from .gbuffer import GBuffer
from .passes import Pass, accumulate_decals, evaluate, screen_derivatives
from .scenes import Layer, Light, Mask, Scene, Texture, Uv, explain, layer_classes, run

__all__ = [
    "Camera", "Device", "DeviceInfo", "Error", "GBuffer", "Layer", "Light", "Mask", "Pass", "Scene", "Texture", "Uv",
    "accumulate_decals", "cryptomatte_id", "devices", "eval", "evaluate", "explain", "functions", "run",
    "screen_derivatives", *layer_classes,
]


def __getattr__(name: str) -> type[Layer]:
    if name not in layer_classes:
        raise AttributeError(f"module wrinkle has no {name}; its layers are {', '.join(layer_classes)}")
    return layer_classes[name]


def __dir__() -> list[str]:
    return sorted(__all__)
