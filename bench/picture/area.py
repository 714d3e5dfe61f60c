#!/usr/bin/env python3
"""How far normals and pictures of pixels' areas are from 1024 samples a pixel, and how pictures flicker.

    build/venv/bin/python bench/picture/area.py [normals|pictures|flicker] [--quick]     needs PyPI's flip-evaluator and numpy

normals: cobbles and noise on a ground to the horizon, by thirds of the picture: degrees between normals and that of the mean
surface gradient, median and 99%; and the slopes' standard deviation within pixels (output.slope_covariance), as a share of the
truth's, median.
pictures: layers on a ground to the horizon, a sphere and a wall along the view; FLIP (NVIDIA's, at 67 pixels a degree, of
pictures in sRGB) and decibels of the linear ones, where the surface covers pixels whole.
flicker: a camera flies over the ground for 24 frames. The mean absolute difference between the change of the picture from
frame to frame and that of the truth, with 256 samples a pixel.
"""
import pathlib
import sys

import flip_evaluator
import numpy as np

sys.path.append(str(pathlib.Path(__file__).parents[2] / "data" / "make"))

import wrinkle  # noqa: E402
from area_views import View, ball, data, ground, scene, truth, wall  # noqa: E402

WAYS = [("1 tap", {"taps": 1}), ("2 taps", {"taps": 2}), ("4 taps", {"taps": 4}), ("8 taps", {"taps": 8}), ("16 taps", {}),
        ("16, mean normal", {"light": "mean"})]
FLAT = wrinkle.Uv(source="planar", scale=1 / 1.8)
ON_WALL = wrinkle.Uv(source="planar", scale=1 / 1.8, axis_u=(0, 1, 0), axis_v=(0, 0, 1))
GROUND_NOISE = wrinkle.Noise(frequency=2, octaves=6, scale=0.06)
NOISE = wrinkle.Noise(frequency=6, octaves=4, scale=0.05)
FOG = wrinkle.Volume(volume="../volumes/noise.vdb", grid="density", scale=0.2,
                     transform=((2.4, 0, 0, -1.2), (0, 2.4, 0, -1.2), (0, 0, 2.4, -1.2), (0, 0, 0, 1)))


def cobbles(uv):
    return wrinkle.HeightMap(texture="cobbles_height.png", scale=0.05, uv=uv)


def decal(center, axis_x, axis_y):
    return wrinkle.Decal(texture="cracks_height.png", center=center, axis_x=axis_x, axis_y=axis_y, half_size=(2, 4, 0.5),
                         scale=0.2)


def of_ground(quick):
    size = (160, 90) if quick else (480, 270)
    return View(*size, ground, eye=(0, -6, 1.6), target=(0, 0, 0.6), fov_y=0.698)


def cases(quick):
    """Surface, view, layer, roughness and sun."""
    size = (120, 50) if quick else (240, 100)
    grazing = View(*size, wall, eye=(1.2, -6, 0.4), target=(0, 0, 0.3), fov_y=0.6)
    near = View(*size, ball, eye=(0, -5, 0.3), target=(0, 0, 0), fov_y=0.42)
    far = View(60, 25, ball, eye=(0, -150, 9), target=(0, 0, 0), fov_y=0.014)
    sun, side = (0.6, 0.5, -0.6), (0.6, 0.7, -0.5)
    yield "ground, cobbles", of_ground(quick), (cobbles(FLAT), 0.3, sun)
    yield "ground, noise", of_ground(quick), (GROUND_NOISE, 0.3, sun)
    yield "ground, decal", of_ground(quick), (decal((0, 0, 0), (1, 0, 0), (0, 1, 0)), 0.3, sun)
    yield "wall, cobbles", grazing, (cobbles(ON_WALL), 0.3, (-0.6, 0.5, -0.4))
    yield "wall, decal", grazing, (decal((0, 0, 0), (0, 1, 0), (0, 0, 1)), 0.3, (-0.6, 0.5, -0.4))
    yield "sphere, noise", near, (NOISE, 0.2, side)
    yield "sphere 150 m away, noise", far, (NOISE, 0.2, side)
    yield "sphere 150 m away, volume", far, (FOG, 0.2, side)


def shown(lit):
    linear = np.clip(lit, 0, 1)
    return np.where(linear <= 0.0031308, 12.92 * linear, 1.055 * linear ** (1 / 2.4) - 0.055).astype(np.float32)


def distance(lit, wanted, where):
    """FLIP and decibels; pixels that the surface does not cover whole are alike."""
    lit = np.where(where[..., None], lit, wanted)
    error = flip_evaluator.evaluate(shown(wanted), shown(lit), "LDR", inputsRGB=True, applyMagma=False)[0][..., 0]
    square = ((np.clip(lit, 0, 1) - np.clip(wanted, 0, 1))[where] ** 2).mean()
    return error[where].mean(), -10 * np.log10(max(square, 1e-12))


def degrees(gradient, wanted):
    """How far the ground's normals are from those of other surface gradients."""
    a, b = ([0, 0, 1] - g.astype(np.float64) for g in (gradient, wanted))
    return np.degrees(np.arctan2(np.linalg.norm(np.cross(a, b), axis=-1), (a * b).sum(-1)))


def measure_normals(quick):
    view = of_ground(quick)
    for name, what in (("cobbles", (cobbles(FLAT), 0.3, (0.6, 0.5, -0.6))), ("noise", (GROUND_NOISE, 0.3, (0.6, 0.5, -0.6)))):
        wanted, where = truth(view, what, 8 if quick else 32)
        spread = np.sqrt(np.maximum(wanted["square"] - (wanted["surface_gradient"] ** 2).sum(-1), 0))
        for way, keys in WAYS[:1] + WAYS[4:5]:
            planes = wrinkle.evaluate(scene(*what, output={"surface_gradient": True, "slope_covariance": True}, **keys),
                                      view.gbuffer())
            off = degrees(planes["surface_gradient"], wanted["surface_gradient"])
            share = np.sqrt(planes["slope_covariance"][..., [0, 2]].sum(-1)) / np.maximum(spread, 1e-9)
            thirds = [(third, lines * view.height // 270) for third, lines in
                      (("near", np.r_[181:270]), ("middle", np.r_[111:181]), ("far", np.r_[0:111]))]
            for third, lines in thirds:
                rows = np.isin(np.arange(view.height), lines)[:, None] & where
                median, most = np.percentile(off[rows], [50, 99])
                print(f"  {name}, {way}, {third}: {median:.2f} degrees, {most:.1f} (99%); "
                      f"deviation {np.median(share[rows]):.2f} of the truth's")


def brute(view, what, points):
    return truth(view, what, points)[0]["lit"]


def measure_pictures(quick):
    rows = WAYS[::4] if quick else WAYS
    for name, view, what in cases(quick):
        wanted, where = truth(view, what, 8 if quick else 32)
        print(f"{name:28}{'FLIP':>8}{'dB':>8}")
        pictures = [(way, wrinkle.evaluate(scene(*what, **keys), view.gbuffer())["lit"]) for way, keys in rows]
        pictures += [(f"{n} x {n} evaluations", brute(view, what, n)) for n in ((2,) if quick else (2, 4, 8))]
        for way, lit in pictures:
            flip, decibels = distance(np.asarray(lit, np.float64), wanted["lit"], where)
            print(f"  {way:26}{flip:8.3f}{decibels:8.1f}", flush=True)


def measure_flicker(quick):
    what = (cobbles(FLAT), 0.3, (0.6, 0.5, -0.6))
    ways = [("1 tap", {"taps": 1}), ("16, mean normal", {"light": "mean"}), ("16 taps", {})]
    size = (160, 90) if quick else (480, 270)
    flicker, before = {way: [] for way, _ in ways}, None
    for frame in range(4 if quick else 24):
        eye = (0.02 * frame, -6 + 0.12 * frame, 1.6)
        view = View(*size, ground, eye=eye, target=(eye[0], eye[1] + 6, 0.6), fov_y=0.698)
        wanted, where = truth(view, what, 4 if quick else 16)
        now = {way: wrinkle.evaluate(scene(*what, **keys), view.gbuffer())["lit"] for way, keys in ways}
        if before:
            both = where & before[2]
            for way in flicker:
                change = (now[way] - before[0][way]) - (wanted["lit"] - before[1])
                flicker[way].append(np.abs(change[both]).mean())
        before = now, wanted["lit"], where
    one = np.mean(flicker["1 tap"])
    for way, values in flicker.items():
        print(f"  flicker, {way:26}{np.mean(values):8.4f}{np.mean(values) / one:8.2f} of one tap's")


parts = [a for a in sys.argv[1:] if not a.startswith("-")] or ["normals", "pictures", "flicker"]
for part in parts:
    {"normals": measure_normals, "pictures": measure_pictures, "flicker": measure_flicker}[part]("--quick" in sys.argv)
