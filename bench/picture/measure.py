#!/usr/bin/env python3
"""How far relit pictures are from a re-render: FLIP and decibels, of the whole frame and of each object.

    python3 measure.py FRAME.exr [NAME=LIT.exr ...]      needs PyPI's flip-evaluator, numpy and openimageio

FRAME.exr is render.py's. Rows: the unbumped picture, a re-render with another seed, and each LIT.exr that `wrinkle run` wrote.
FLIP is NVIDIA's at 67 pixels a degree, of pictures in sRGB; decibels are the peak signal to noise ratio of the same.
"""
import sys

import flip_evaluator
import numpy as np
import OpenImageIO as oiio

OBJECTS = {"torus": 1, "ball": 2, "ground": 3}


def planes(path):
    image = oiio.ImageBuf(path)
    pixels = image.get_pixels("float")
    return {name: pixels[..., i] for i, name in enumerate(image.spec().channelnames)}


def picture(channels, layer=""):
    linear = np.clip(np.stack([channels[layer + c] for c in "RGB"], axis=2), 0, 1)
    return np.where(linear <= 0.0031308, 12.92 * linear, 1.055 * linear ** (1 / 2.4) - 0.055).astype(np.float32)


frame = planes(sys.argv[1])
wanted, index = picture(frame, "Bumped."), frame["ViewLayer.Object Index.X"]
rows = {"unbumped": picture(frame, "ViewLayer.Combined."), "another seed": picture(frame, "BumpedAgain.")}
for argument in sys.argv[2:]:
    name, _, path = argument.rpartition("=")
    rows[name or path] = picture(planes(path))
print(f"{'':24}{'FLIP':>7}{'dB':>7}" + "".join(f"{name + ' FLIP':>13}{'dB':>7}" for name in OBJECTS))
for name, image in rows.items():
    error = flip_evaluator.evaluate(wanted, image, "LDR", inputsRGB=True, applyMagma=False)[0][..., 0]
    square = ((wanted - image) ** 2).mean(axis=2)
    line = f"{name:24}{error.mean():7.3f}{-10 * np.log10(square.mean()):7.1f}"
    for label in OBJECTS.values():
        line += f"{error[index == label].mean():13.3f}{-10 * np.log10(square[index == label].mean()):7.1f}"
    print(line)
