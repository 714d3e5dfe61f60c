"""A small frame that the tests share: a wall seen from 2 m, its right half object 7."""

import pathlib

import numpy as np
import pytest

import wrinkle

DATA = pathlib.Path(__file__).parents[2] / "data"
SHAPE = (48, 64)


@pytest.fixture(scope="session")
def camera():
    return wrinkle.Camera.look_at(eye=(0, 0, 2), target=(0, 0, 0), up=(0, 1, 0), fov_y=1.0, aspect=64 / 48)


@pytest.fixture(scope="session")
def planes():
    normal = np.zeros((3, *SHAPE), np.float32)
    normal[2] = 1
    object_index = np.zeros(SHAPE, np.float32)
    object_index[:, 32:] = 7
    return {"normal": np.moveaxis(normal, 0, -1), "depth": np.full(SHAPE, 2, np.float32), "object": object_index}


@pytest.fixture(scope="session")
def gbuffer(camera, planes):
    return wrinkle.GBuffer(camera=camera, **planes)


@pytest.fixture(scope="session")
def noise():
    return wrinkle.Scene(layers=[wrinkle.Noise(frequency=8, octaves=2, scale=0.02)], filter={"taps": 1})
