"""Planes as engines hold them: taken by dtype and shape, without copies."""

import numpy as np
import pytest

import wrinkle
from conftest import SHAPE


def tilted(kind, components):
    """Normals around +z as `kind` stores them, and what they then are."""
    random = np.random.default_rng(4)
    normal = np.concatenate([random.normal(0, 0.2, (*SHAPE, 2)), np.ones((*SHAPE, 1))], -1)
    normal /= np.linalg.norm(normal, axis=-1, keepdims=True)
    if components == 2:
        most = np.iinfo(kind).max
        stored = np.rint(normal[..., :2] / np.abs(normal).sum(-1, keepdims=True) * most).astype(kind)
        uv = stored / most
        return stored, np.concatenate([uv, 1 - np.abs(uv).sum(-1, keepdims=True)], -1)
    stored = np.zeros((*SHAPE, components), kind)
    if np.dtype(kind).kind == "f":
        stored[..., :3] = normal
        return stored, stored[..., :3].astype(np.float64)
    most = np.iinfo(kind).max
    if np.dtype(kind).kind == "u":
        stored[..., :3] = np.rint((normal + 1) / 2 * most)
        return stored, stored[..., :3] / most * 2 - 1
    stored[..., :3] = np.rint(normal * most)
    return stored, stored[..., :3] / most


@pytest.mark.parametrize("kind, components, read", [
    (np.float16, 3, 6), (np.float16, 4, 8), (np.float32, 4, 16), (np.uint8, 4, 4), (np.int16, 4, 8), (np.int8, 2, 2),
    (np.int16, 2, 4)])
def test_normals_are_taken_as_they_are_stored(camera, planes, noise, kind, components, read):
    stored, normal = tilted(kind, components)
    depth = planes["depth"].astype(np.float16)
    gbuffer = wrinkle.GBuffer(camera=camera, normal=stored, depth=depth)
    assert np.shares_memory(gbuffer.plane("normal.x"), stored) and np.shares_memory(gbuffer.plane("depth"), depth)
    bumps = wrinkle.Pass(noise, gbuffer)
    assert bumps.inputs == ["depth", "normal"] and bumps.bytes_per_pixel == read + 2 + 3 * 4
    wanted = wrinkle.evaluate(noise, wrinkle.GBuffer(camera=camera, normal=normal, depth=planes["depth"]))["normal"]
    assert np.abs(bumps.run(gbuffer)["normal"] - wanted).max() < 1e-6
    with pytest.raises(wrinkle.Error, match="other types"):
        bumps.run(wrinkle.GBuffer(camera=camera, **planes))


def test_objects_of_32_bits_and_masks_of_8(camera, planes):
    large = np.where(planes["object"] == 7, np.uint32(4000000007), np.uint32(7))
    dirt = np.zeros(SHAPE, np.uint8)
    dirt[:24] = 255
    scene = wrinkle.Scene(layers=[wrinkle.Constant(
        gradient=[0.75, 0, 0], mask=wrinkle.Mask(object=4000000007, channel="dirt"))])
    gbuffer = wrinkle.GBuffer(camera=camera, normal=planes["normal"], depth=planes["depth"], object=large,
                              channels={"dirt": dirt})
    normal = wrinkle.evaluate(scene, gbuffer)["normal"]
    assert np.allclose(normal[:24, 32:], (-0.6, 0, 0.8), atol=1e-6)
    assert (normal[24:] == (0, 0, 1)).all() and (normal[:, :32] == (0, 0, 1)).all()


def test_depth_buffers(camera, planes):
    reversed_infinite = np.array(camera.proj)
    reversed_infinite[2] = 0, 0, 0, 0.1
    of_engine = wrinkle.Camera(camera.view, reversed_infinite.tolist())
    depth = np.full(SHAPE, 0.1 / 2, np.float32)
    depth[0] = 0
    buffer = wrinkle.GBuffer(camera=of_engine, normal=planes["normal"], depth=depth, device_depth="zero_to_one")
    dp_dx, _ = wrinkle.screen_derivatives(buffer)
    wanted, _ = wrinkle.screen_derivatives(wrinkle.GBuffer(camera=camera, **planes))
    assert np.allclose(dp_dx[1:], wanted[1:], rtol=1e-6) and not dp_dx[0].any()
    with pytest.raises(wrinkle.Error, match="minus_one_to_one"):
        wrinkle.screen_derivatives(wrinkle.GBuffer(camera=of_engine, normal=planes["normal"], depth=depth,
                                                   device_depth="reversed"))
