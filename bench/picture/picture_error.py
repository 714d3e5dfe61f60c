"""How far pictures are from each other: NVIDIA's FLIP at 67 pixels a degree, of pictures in sRGB, and decibels of the same.

Needs PyPI's flip-evaluator, numpy and openimageio.
"""
import flip_evaluator
import numpy as np
import OpenImageIO as oiio


def planes(path):
    """The channels of an EXR by their names."""
    image = oiio.ImageBuf(str(path))
    pixels = image.get_pixels("float")
    return {name: pixels[..., i] for i, name in enumerate(image.spec().channelnames)}


def linear(channels, layer=""):
    """Three channels as a picture."""
    return np.stack([channels[layer + c] for c in "RGB"], axis=2)


def shown(picture):
    """In sRGB, from 0 to 1."""
    x = np.clip(picture, 0, 1)
    return np.where(x <= 0.0031308, 12.92 * x, 1.055 * x ** (1 / 2.4) - 0.055).astype(np.float32)


def flip(picture, wanted):
    """FLIP of each pixel."""
    return flip_evaluator.evaluate(shown(wanted), shown(picture), "LDR", inputsRGB=True, applyMagma=False)[0][..., 0]


def decibels(picture, wanted, where):
    """The peak signal to noise ratio where a mask says."""
    return -10 * np.log10(((shown(wanted) - shown(picture))[where] ** 2).mean())
