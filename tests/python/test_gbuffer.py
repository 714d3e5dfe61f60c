"""Planes: where they are used as they are, and what is refused."""

import numpy as np
import pytest

import wrinkle
from conftest import DATA, SHAPE


def test_contiguous_floats_are_used_where_they_are(camera, planes):
    gbuffer = wrinkle.GBuffer(camera=camera, **planes)
    assert np.shares_memory(gbuffer.plane("depth"), planes["depth"])
    assert np.shares_memory(gbuffer.plane("normal.y"), planes["normal"])
    interleaved = np.ascontiguousarray(planes["normal"])
    assert not np.shares_memory(wrinkle.GBuffer(camera=camera, normal=interleaved).plane("normal.y"), interleaved)


def test_other_types_strides_and_protocols_become_floats(camera, planes, noise):
    class Interface:
        def __init__(self, array):
            self.__array_interface__ = array.__array_interface__
            self.held = array

    class Dlpack:
        def __init__(self, array):
            self.held = array

        def __dlpack__(self, **options):
            return self.held.__dlpack__(**options)

        def __dlpack_device__(self):
            return self.held.__dlpack_device__()

    wanted = wrinkle.evaluate(noise, wrinkle.GBuffer(camera=camera, **planes))["normal"]
    wide = np.zeros((SHAPE[0], 2 * SHAPE[1]), np.float32)
    wide[:, ::2] = planes["depth"]
    for depth in (planes["depth"].astype(np.float64), planes["depth"].astype(np.float16), planes["depth"].astype(int),
                  wide[:, ::2], Interface(planes["depth"]), Dlpack(planes["depth"]), planes["depth"].tolist()):
        other = wrinkle.GBuffer(camera=camera, normal=planes["normal"], depth=depth)
        assert np.array_equal(wrinkle.evaluate(noise, other)["normal"], wanted)


@pytest.mark.parametrize("planes, said", [
    ({"norml": np.zeros(SHAPE)}, '"norml" is no role'),
    ({"normal": np.zeros((*SHAPE, 2))}, "(height, width, 3) is wanted; found (48, 64, 2)"),
    ({"depth": np.zeros((*SHAPE, 3))}, "(height, width) is wanted"),
    ({"depth": np.zeros(SHAPE), "object": np.zeros((3, 4))}, "4 x 3 pixels, where the planes before it have 64 x 48"),
    ({"depth": np.zeros(SHAPE, complex)}, "found complex128"),
    ({"depth": np.zeros((0, 64))}, "found (0, 64)"),
    ({"depth": np.array(["a"])}, '"depth"'),
    ({}, "without planes"),
])
def test_what_is_no_plane_is_told_by_name(camera, planes, said):
    with pytest.raises(wrinkle.Error) as error:
        wrinkle.GBuffer(camera=camera, **planes)
    assert said in str(error.value)


def test_a_missing_plane_is_told(camera, planes, noise):
    with pytest.raises(wrinkle.Error, match="depth"):
        wrinkle.evaluate(noise, wrinkle.GBuffer(camera=camera, normal=planes["normal"]))


def test_a_frame_of_a_file():
    scene = wrinkle.Scene.load(DATA / "scenes" / "constant.toml")
    gbuffer = wrinkle.GBuffer.of(scene)
    assert "normal.x" in gbuffer.names
    length = sum(gbuffer.plane(f"normal.{axis}").astype(float) ** 2 for axis in "xyz")
    assert gbuffer.plane("normal.x").shape == gbuffer.shape
    assert np.median(length) == pytest.approx(1, abs=1e-3)
    with pytest.raises(wrinkle.Error, match="no file missing.exr"):
        wrinkle.GBuffer.read("missing.exr")


def test_nan_is_background(camera, planes, noise):
    depth = planes["depth"].copy()
    depth[3, 4] = np.nan
    normal = wrinkle.evaluate(noise, wrinkle.GBuffer(camera=camera, normal=planes["normal"], depth=depth))["normal"]
    assert np.isfinite(normal).all() and (normal[3, 4] == (0, 0, 1)).all()
