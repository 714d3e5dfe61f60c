#!/usr/bin/env python3
"""Draws data/pictures/area.jpg: what a pixel's area shows, by one point, by sixteen, and by a thousand.

A ground of cobbles to the horizon, and a glossy sphere of noise, near and so far away that a pixel holds many bumps. Each
is lit by a sun with one point of every pixel (as if its area were round), with the sixteen along its long axis that are
wrinkle's default, and, as the truth, by the mean light of 32 x 32 points a pixel that are not filtered at all. Says how
far from that truth the others are, in dB of the linear picture. Run it by the Python package:

    build/venv/bin/python data/make/area_figure.py
"""

import pathlib

import matplotlib
import numpy as np

import wrinkle

matplotlib.use("Agg")
import matplotlib.pyplot as plt

data = pathlib.Path(__file__).parents[1]
POINTS = 32


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


def scene(taps, layer, roughness, sun, **keys):
    return wrinkle.Scene(layers=[layer.replace(**keys)], lights=[wrinkle.Light("sun", direction=sun, intensity=2.5)],
                         lighting={"relight": "lit", "roughness": roughness, "ambient": [0.05] * 3},
                         output={"surface_gradient": True}, filter={"taps": taps}, folder=data / "textures")


def evaluated(view, *what):
    """By one point, by sixteen, and the truth; and the pixels that the surface covers whole."""
    frame = view.gbuffer()
    out = [wrinkle.evaluate(scene(taps, *what), frame) for taps in (1, 16)]
    points = wrinkle.Pass(scene(1, *what, footprint=False), frame)
    truth, covered = {}, True
    for y in range(POINTS):
        for x in range(POINTS):
            point = view.gbuffer((x + 0.5) / POINTS, (y + 0.5) / POINTS)
            covered &= np.isfinite(point.plane("depth"))
            for name, plane in points.run(point).items():
                truth[name] = truth.get(name, 0) + plane.astype(np.float64) / POINTS**2
    return [*out, truth], covered


def decibels(picture, truth, where):
    return -10 * np.log10(((picture["lit"] - truth["lit"])[where] ** 2).mean())


def degrees(picture, truth, where):
    """How far the ground's normals are from that of the mean surface gradient."""
    a, b = ([0, 0, 1] - p["surface_gradient"][where].astype(np.float64) for p in (picture, truth))
    return np.degrees(np.arctan2(np.linalg.norm(np.cross(a, b), axis=-1), (a * b).sum(-1)))


cobbles = wrinkle.HeightMap(texture="cobbles_height.png", scale=0.05, uv=wrinkle.Uv(source="planar", scale=1 / 1.8))
noise = wrinkle.Noise(frequency=6, octaves=4, scale=0.05)
rows = [
    ("ground to the horizon", View(480, 270, ground, eye=(0, -6, 1.6), target=(0, 0, 0.6), fov_y=0.698),
     (cobbles, 0.3, (0.6, 0.5, -0.6))),
    ("glossy sphere, near", View(480, 200, ball, eye=(0, -5, 0.3), target=(0, 0, 0), fov_y=0.42),
     (noise, 0.2, (0.6, 0.7, -0.5))),
    ("glossy sphere, 150 m away", View(60, 25, ball, eye=(0, -150, 9), target=(0, 0, 0), fov_y=0.014),
     (noise, 0.2, (0.6, 0.7, -0.5))),
]
figure, axes = plt.subplots(3, 3, figsize=(14.4, 6.9), gridspec_kw={"height_ratios": [270, 200, 200]})
for row, (name, view, what) in zip(axes, rows):
    shown, covered = evaluated(view, *what)
    for axis, picture, title in zip(row, shown, ("one point of a pixel", "sixteen", "1024: the truth")):
        axis.imshow(np.clip(picture["lit"], 0, 1) ** (1 / 2.2), interpolation="nearest", aspect="auto")
        axis.set(xticks=[], yticks=[])
        if picture is not shown[2]:
            title += f", {decibels(picture, shown[2], covered):.1f} dB"
        axis.set_title(title, fontsize=10)
        print(f"{name}: {title}")
    row[0].set_ylabel(name, fontsize=9)
    if name.startswith("ground"):
        for zone, lines in (("near", slice(181, None)), ("middle", slice(111, 181)), ("far", slice(0, 111))):
            where = covered & np.isin(np.arange(view.height), np.arange(view.height)[lines])[:, None]
            for picture, title in zip(shown, ("one point", "sixteen")):
                median, most = np.percentile(degrees(picture, shown[2], where), [50, 99])
                print(f"  normals, {zone}, {title}: {median:.2f} degrees off (median), {most:.1f} (99 %)")
figure.subplots_adjust(left=0.02, right=0.998, top=0.965, bottom=0.005, wspace=0.015, hspace=0.13)
figure.savefig(data / "pictures" / "area.jpg", dpi=100, pil_kwargs={"quality": 88})
