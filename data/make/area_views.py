"""Surfaces seen by a camera through any point of its pixels, as G-buffers: what pixels' areas show is the mean over many."""

import pathlib

import numpy as np

import wrinkle

data = pathlib.Path(__file__).parents[1]


class View:
    """A frame whose pixels are seen through one of its points, (0.5, 0.5) being the middle."""

    def __init__(self, width, height, surface, **camera):
        self.width, self.height, self.surface = width, height, surface
        self.camera = wrinkle.Camera.look_at(up=(0, 0, 1), aspect=width / height, **camera)
        self.eye = np.array(camera["eye"], float)

    def gbuffer(self, x=0.5, y=0.5):
        view, proj = np.array(self.camera.view), np.array(self.camera.proj)
        proj[0, 2] += (2 * x - 1) / self.width  # the picture, moved by part of a pixel
        proj[1, 2] -= (2 * y - 1) / self.height
        across = (np.arange(self.width) + 0.5) / self.width * 2 - 1
        down = 1 - (np.arange(self.height) + 0.5) / self.height * 2
        across, down = np.meshgrid(across, down)
        rays = np.stack([(across + proj[0, 2]) / proj[0, 0], (down + proj[1, 2]) / proj[1, 1],
                         np.full_like(across, -1)], -1) @ view[:3, :3]
        depth, normal = self.surface(self.eye, rays)
        planes = np.ascontiguousarray(np.moveaxis(normal, -1, 0).astype(np.float32))
        return wrinkle.GBuffer(camera=wrinkle.Camera(view.tolist(), proj.tolist()), depth=depth,
                               normal=np.moveaxis(planes, 0, -1))


def ground(eye, rays):
    falling = rays[..., 2]
    seen = falling < -0.002
    depth = np.where(seen, -eye[2] / np.where(seen, falling, -1), np.inf)
    return depth, np.broadcast_to([0.0, 0, 1], rays.shape)


def ball(eye, rays):
    a, b, c = (rays**2).sum(-1), rays @ eye, eye @ eye - 1
    root = b * b - a * c
    seen = root > 0
    depth = np.where(seen, (-b - np.sqrt(np.where(seen, root, 0))) / a, np.inf)
    return depth, np.where(seen[..., None], eye + np.where(seen, depth, 0)[..., None] * rays, 0)


def wall(eye, rays):
    """The plane x = 0, seen from its right."""
    nearing = rays[..., 0]
    seen = nearing < -0.002
    depth = np.where(seen, -eye[0] / np.where(seen, nearing, -1), np.inf)
    return depth, np.broadcast_to([1.0, 0, 0], rays.shape)


def scene(layer, roughness, sun, taps=16, light="taps", output=None, **keys):
    """One layer under a sun."""
    return wrinkle.Scene(layers=[layer.replace(**keys)], lights=[wrinkle.Light("sun", direction=sun, intensity=2.5)],
                         lighting={"relight": "lit", "roughness": roughness, "ambient": [0.05] * 3},
                         output=output or {"surface_gradient": True}, filter={"taps": taps, "light": light},
                         folder=data / "textures")


def truth(view, what, points):
    """The mean of unfiltered planes over points x points of every pixel, and of the square of the surface gradient's
    length; and the pixels that the surface covers whole."""
    unfiltered = wrinkle.Pass(scene(*what, taps=1, footprint=False), view.gbuffer())
    mean, covered = {}, True
    for y in range(points):
        for x in range(points):
            point = view.gbuffer((x + 0.5) / points, (y + 0.5) / points)
            covered &= np.isfinite(point.plane("depth"))
            planes = unfiltered.run(point)
            planes["square"] = (planes["surface_gradient"].astype(np.float64) ** 2).sum(-1)
            for name, plane in planes.items():
                mean[name] = mean.get(name, 0) + plane.astype(np.float64) / points**2
    return mean, covered
