#!/usr/bin/env python3
"""Draws data/pictures/area.jpg: what a pixel's area shows, by one point, by sixteen, and by a thousand.

A ground of cobbles to the horizon, and a glossy sphere of noise, near and so far away that a pixel holds many bumps. Each
is lit by a sun with one point of every pixel (as if its area were round), with the sixteen along its long axis that are
wrinkle's default, and, as the truth, by the mean light of 32 x 32 points a pixel that are not filtered at all. Says how
far from that truth the others are, in dB of the linear picture. Run it by the Python package:

    build/venv/bin/python data/make/area_figure.py
"""

import matplotlib
import numpy as np
from area_views import View, ball, data, ground, scene, truth

import wrinkle

matplotlib.use("Agg")
import matplotlib.pyplot as plt

POINTS = 32


def evaluated(view, *what):
    """By one point, by sixteen, and the truth; and the pixels that the surface covers whole."""
    mean, covered = truth(view, what, POINTS)
    return [*(wrinkle.evaluate(scene(*what, taps=taps), view.gbuffer()) for taps in (1, 16)), mean], covered


def decibels(picture, truth, where):
    return -10 * np.log10(((picture["lit"] - truth["lit"])[where] ** 2).mean())


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
figure.subplots_adjust(left=0.02, right=0.998, top=0.965, bottom=0.005, wspace=0.015, hspace=0.13)
figure.savefig(data / "pictures" / "area.jpg", dpi=100, pil_kwargs={"quality": 88})
