"""Planes as engines hold them: taken by dtype and shape, without copies."""

import numpy as np
import pytest

import wrinkle
from conftest import DATA, SHAPE


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


@pytest.mark.parametrize("kind, components, error", [
    (np.float16, 3, 2**-11), (np.uint8, 4, 1 / 255), (np.int16, 3, 1 / 65534), (np.int16, 2, 1e-4), (np.float32, 4, 0)])
def test_normals_are_written_as_they_are_to_be_stored(gbuffer, noise, kind, components, error):
    wanted = wrinkle.evaluate(noise, gbuffer)["normal"]
    bumps = wrinkle.Pass(noise, gbuffer, stored={"normal": (kind, components)})
    assert bumps.outputs == ["normal"]
    stored = bumps.run(gbuffer)["normal"]
    assert stored.dtype == kind and stored.shape == (*SHAPE, components)
    got = stored.astype(np.float64)
    if np.dtype(kind).kind != "f":
        got /= np.iinfo(kind).max
    if np.dtype(kind).kind == "u":
        got = got * 2 - 1
    if components == 2:
        z = 1 - np.abs(got).sum(-1, keepdims=True)
        got = np.concatenate([got, z], -1) / np.linalg.norm(np.concatenate([got, z], -1), axis=-1, keepdims=True)
    assert np.abs(got[..., :3] - wanted).max() <= error * 1.01
    if components == 4:
        assert (stored[..., 3] == 0).all()


def test_outputs_that_cannot_be_stored_so_are_told(gbuffer, noise):
    for stored in ({"normal": np.float64}, {"normal": (np.uint8, 2)}, {"normal": (np.int16, 5)}, {"roughness": (np.uint8, 3)}):
        with pytest.raises(wrinkle.Error, match="output"):
            wrinkle.Pass(noise, gbuffer, stored=stored)
    with pytest.raises(wrinkle.Error, match="lit"):
        wrinkle.Pass(noise, gbuffer, stored={"lit": np.float16})


def test_arrays_are_written_again(gbuffer, noise):
    for stored in ({}, {"normal": (np.int16, 4)}):
        bumps = wrinkle.Pass(noise, gbuffer, stored=stored)
        first = bumps.run(gbuffer)
        kept = first["normal"].copy()
        first["normal"][:] = 7
        again = bumps.run(gbuffer, out=first)
        assert again is first and (again["normal"][..., :3] == kept[..., :3]).all()
        with pytest.raises(wrinkle.Error, match="normal"):
            bumps.run(gbuffer, out={"normal": np.zeros((*SHAPE, 3), np.float64)})
        with pytest.raises(wrinkle.Error, match="normal"):
            bumps.run(gbuffer, out={})


def test_light_is_added_up_over_the_pixels_of_the_picture(camera, planes):
    """Of 2 x 2 pixels that show one of the picture, all get the same ratio."""
    random = np.random.default_rng(1)
    small = random.uniform(0.2, 1, (SHAPE[0] // 2, SHAPE[1] // 2, 3)).astype(np.float32)
    beauty = small.repeat(2, 0).repeat(2, 1)
    scene = wrinkle.Scene(layers=[wrinkle.Noise(frequency=40, octaves=1, scale=0.01)],
                          lighting={"relight": "ratio"}, lights=[wrinkle.Light(kind="sun", direction=[0.5, 0, -1])])
    lit = [wrinkle.evaluate(scene, wrinkle.GBuffer(camera=camera, beauty=beauty, beauty_scale=scale, **planes))["lit"]
           for scale in (1, 2)]
    blocks = [image.reshape(SHAPE[0] // 2, 2, SHAPE[1] // 2, 2, 3) for image in lit]
    assert np.ptp(blocks[0], axis=(1, 3)).max() > 0.01
    assert np.ptp(blocks[1], axis=(1, 3)).max() < 1e-5


def test_integers_of_either_byte_order(camera, planes):
    stored, _ = tilted(np.uint16, 3)
    swapped = wrinkle.GBuffer(camera=camera, normal=stored.astype(">u2"), depth=planes["depth"])
    assert (swapped.plane("normal.x") == stored[..., 0]).all()
    numbers = np.where(planes["object"] == 7, 4000000007, 7)
    for kind in (">u4", np.int64, np.uint64):
        taken = wrinkle.GBuffer(camera=camera, normal=planes["normal"], object=numbers.astype(kind)).plane("object")
        assert taken.dtype == np.uint32 and (taken == numbers).all()
    with pytest.raises(wrinkle.Error, match="found -1 to 7"):
        wrinkle.GBuffer(camera=camera, object=np.where(numbers == 7, 7, -1))


def test_channels_are_no_directions_whatever_their_name(camera, planes):
    dirt = np.full(SHAPE, 128, np.uint8)
    given = {name: wrinkle.evaluate(
        wrinkle.Scene(layers=[wrinkle.Constant(gradient=[0.75, 0, 0], mask=wrinkle.Mask(channel=name))]),
        wrinkle.GBuffer(camera=camera, normal=planes["normal"], depth=planes["depth"], channels={name: dirt}))["normal"]
        for name in ("dirt", "normal", "object", "cryptomatte")}
    for name in given:
        assert (given[name] == given["dirt"]).all()


def test_a_fourth_component_is_not_read_whatever_the_memory_is_like(camera, planes):
    stored, normal = tilted(np.float32, 4)
    for array in (np.repeat(stored, 2, axis=1)[:, ::2], np.asfortranarray(stored), stored.astype(np.float64)):
        gbuffer = wrinkle.GBuffer(camera=camera, normal=array, depth=planes["depth"])
        assert np.allclose(gbuffer.plane("normal.z"), normal[..., 2], atol=1e-7)


def test_sums_of_decals_need_no_normals_of_any_format(camera, planes):
    stored, _ = tilted(np.float16, 3)
    decal = wrinkle.Scene(layers=[wrinkle.Decal(texture=DATA / "textures" / "cracks_height.png", center=[0, 0, 0],
                                                half_size=[1, 1, 0.5], scale=0.1)])
    with_normals = wrinkle.GBuffer(camera=camera, normal=stored, depth=planes["depth"])
    assert (wrinkle.accumulate_decals(decal, with_normals) ==
            wrinkle.accumulate_decals(decal, wrinkle.GBuffer(camera=camera, depth=planes["depth"]))).all()


@pytest.mark.parametrize("array, said", [
    (1.0, r"\(height, width, 2 n\)"), (np.zeros((*SHAPE, 0)), "2 n"), (np.zeros((*SHAPE, 1), np.float32), "2 n"),
    (np.zeros((*SHAPE, 2), np.uint32), "float32 is wanted"), (np.zeros((*SHAPE, 2), np.float16), "float32 is wanted")])
def test_cryptomattes_that_cannot_be(camera, array, said):
    with pytest.raises(wrinkle.Error, match=said):
        wrinkle.GBuffer(camera=camera, cryptomatte=array)


def test_ids_of_names(camera, planes):
    identity = wrinkle.cryptomatte_id("cube")
    ids = np.zeros((*SHAPE, 2), np.float32)
    ids[:24, :, 0], ids[:24, :, 1] = np.uint32(identity).view(np.float32), 1
    scene = wrinkle.Scene(layers=[wrinkle.Constant(gradient=[0.75, 0, 0], mask=wrinkle.Mask(cryptomatte="cube"))])
    normal = wrinkle.evaluate(scene, wrinkle.GBuffer(camera=camera, normal=planes["normal"], depth=planes["depth"],
                                                     cryptomatte=ids))["normal"]
    assert np.allclose(normal[:24], (-0.6, 0, 0.8), atol=1e-6) and (normal[24:] == (0, 0, 1)).all()
