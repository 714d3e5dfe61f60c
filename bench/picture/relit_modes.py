"""The ways in which a scene's picture is relit, by what a user may know: scenes made of one that names all lights and their pictures."""
import json
import pathlib
import re
import tomllib


def _lighting(keys, lights):
    text = "[lighting]\n" + "".join(f"{key} = {json.dumps(value)}\n" for key, value in keys.items())
    for light in lights:
        text += "\n[[light]]\n" + "".join(f"{key} = {json.dumps(value)}\n" for key, value in light.items())
    return text


def _without_pictures(lights):
    return [{key: value for key, value in light.items() if key != "picture"} for light in lights]


def _finer(head, file):
    """The same scene with the data of NAME_data.exr, and NAME.exr's picture."""
    data = file.with_name(file.stem + "_data.exr")
    return head.replace(f'file = "{file}"', f'file = "{data}"\nbeauty = {{ file = "{file}", layer = "ViewLayer.Combined" }}', 1)


class Mode:
    """text: the scene; flip, decibels: the bars, at most of the unbumped picture's FLIP and at least above its dB."""

    def __init__(self, name, text, flip, decibels=None):
        self.name, self.text, self.flip, self.decibels = name, text, flip, decibels


def frame_of(scene):
    """The frame of a scene's file."""
    return (scene.parent / tomllib.loads(scene.read_text())["gbuffer"]["file"]).resolve()


def modes(scene):
    """All modes of a scene's file; those with finer data where its frame has them."""
    scene = pathlib.Path(scene).resolve()
    told = tomllib.loads(scene.read_text())
    head = scene.read_text().split("[lighting]")[0]
    head = re.sub(r'"(\.\.?/[^"]*)"', lambda found: f'"{(scene.parent / found[1]).resolve()}"', head)
    keys, read, ignored = (told["lighting"] | more for more in ({}, {"shadows": "read"}, {"shadows": "ignored"}))
    lights = told["light"]
    lamps = [light for light in lights if light["kind"] != "sky"]
    bare, bare_lamps = _without_pictures(lights), _without_pictures(lamps)
    other_unit = [light | {"intensity": 0.2 * light.get("intensity", 1)} for light in bare_lamps]
    yield Mode("known lights, no sky, shadows ignored", head + _lighting(ignored, bare_lamps), 0.7)
    yield Mode("known lights and sky, shadows ignored", head + _lighting(ignored, bare), 0.7)
    yield Mode("known lights, no sky", head + _lighting(keys, bare_lamps), 0.7)
    yield Mode("known lights in another unit", head + _lighting(keys, other_unit), 0.7)
    yield Mode("known lights and sky", head + _lighting(keys, bare), 0.7)
    yield Mode("known lights, no sky, shadows read", head + _lighting(read, bare_lamps), 0.7)
    yield Mode("known lights and sky, shadows read", head + _lighting(read, bare), 0.7)
    yield Mode("light pictures, no sky", head + _lighting(keys, lamps), 0.62, 3.8)
    yield Mode("light pictures and sky", head + _lighting(keys, lights), 0.62, 3.8)
    yield Mode("fitted lights", head + _lighting(keys, []), 0.76)
    file = frame_of(scene)
    if file.with_name(file.stem + "_data.exr").exists():
        finer = _finer(head, file)
        yield Mode("finer data, shadows read", finer + _lighting(read, bare), 0.7)
        yield Mode("finer data, light pictures", finer + _lighting(keys, lights), 0.62, 3.8)
