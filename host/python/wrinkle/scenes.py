"""Scenes: from TOML files, or of layers made in Python. Keys are those of data/scenes/README.md, and the library
checks them as it checks a file: a wrong key is told with the nearest known one."""

from __future__ import annotations

import json
import os
import pathlib
import subprocess
from typing import Callable, Iterable

from . import _wrinkle, toml
from .program import program


class Keys:
    """Named values; those that are None are left out, so that the library's defaults hold."""

    def __init__(self, **keys):
        self._keys = {name: value for name, value in keys.items() if value is not None}

    def keys_as_dict(self) -> dict:
        return dict(self._keys)

    def replace(self, **keys):
        """A copy with other values for some keys."""
        other = object.__new__(type(self))
        other._keys = {k: v for k, v in {**self._keys, **keys}.items() if v is not None}
        return other

    def __getattr__(self, name):
        try:
            return self.__dict__["_keys"][name]
        except KeyError:
            raise AttributeError(f"{type(self).__name__} has no {name}") from None

    def __eq__(self, other):
        return type(self) is type(other) and self._keys == other._keys

    def __repr__(self):
        return f"wrinkle.{type(self).__name__}({', '.join(f'{k}={v!r}' for k, v in self._keys.items() if k != 'kind')})"


class Uv(Keys):
    """Texture coordinates of a layer: source ("aov" or "planar"), scale, offset, rotation (degrees), axis_u, axis_v."""


class Mask(Keys):
    """Where a layer is: object, cryptomatte, channel, texture, uv, invert. All that are given multiply."""


class Texture(Keys):
    """An image file: file, and layer or channels of one that has several."""


class Light(Keys):
    """A light: kind ("sun", "point", "spot", "sphere", "disc", "rectangle", "sky"), color, intensity, direction (the way it travels), position, ..."""

    def __init__(self, kind: str, **keys):
        super().__init__(kind=kind, **keys)


class Layer(Keys):
    """A bump layer of any kind: Layer("noise", frequency=8) is Noise(frequency=8)."""

    def __init__(self, kind: str, **keys):
        super().__init__(kind=kind, **keys)


def _class_of(kind: str) -> type[Layer]:
    def __init__(self, **keys):
        Layer.__init__(self, kind, **keys)

    name = "".join(word.capitalize() for word in kind.split("_"))
    text = f'A layer of kind "{kind}": name, scale, blend, footprint, mask, and the keys that data/scenes/README.md lists.'
    return type(name, (Layer,), {"__init__": __init__, "__doc__": text, "__module__": "wrinkle"})


layer_classes = {cls.__name__: cls for cls in map(_class_of, _wrinkle.layer_kinds())}


class Scene:
    """Which layers to add, how to light, what to write.

    layers    bump layers, in their order
    lights    wrinkle.Light, for lighting={"relight": "lit"} or "ratio"
    lighting, filter, output, gbuffer, camera, budget    tables of the scene format, as dicts; gbuffer and camera only
              for scenes that read frames from files
    folder    what relative paths are relative to; the current folder by default

    Raises Error listing every mistake.
    """

    def __init__(self, layers: Iterable[Layer] = (), *, lights: Iterable[Light] = (), lighting: dict | None = None,
                 filter: dict | None = None, output: dict | None = None, gbuffer: dict | None = None,
                 camera: dict | None = None, budget: dict | None = None, folder: str | os.PathLike = "."):
        tables = {"gbuffer": gbuffer, "camera": camera, "lighting": lighting, "filter": filter, "output": output,
                  "budget": budget}
        parts = [toml.table(f"[{name}]", values) for name, values in tables.items() if values is not None]
        parts += [toml.table("[[light]]", light.keys_as_dict()) for light in lights]
        parts += [toml.table("[[layer]]", layer.keys_as_dict()) for layer in layers]
        self.toml: str = "\n".join(parts)
        self.folder = pathlib.Path(folder)
        self._scene = _wrinkle.Scene.parse(self.toml, "a scene in Python", self.folder)

    @classmethod
    def load(cls, file: str | os.PathLike) -> Scene:
        """Reads and checks a scene file; relative paths in it are relative to its folder."""
        out = cls.__new__(cls)
        out._scene = _wrinkle.Scene.load(pathlib.Path(file))
        out.folder = pathlib.Path(file).parent
        out.toml = pathlib.Path(file).read_text(encoding="utf-8")
        return out

    @property
    def layers(self) -> list[str]:
        """The names of its layers."""
        return self._scene.layers

    def __repr__(self):
        return f"<wrinkle.Scene of {len(self.layers)} layers>"


def run(scene: Scene, out: str | os.PathLike = "out", *, frames: Iterable[int] = (), device: str = "",
        progress: Callable[[float], object] | None = None) -> _wrinkle.RenderReport:
    """What `wrinkle run` does: reads the scene's frames, evaluates them in bands, writes pictures into `out`.

    progress   called with the share of the work that is done; what it raises ends the run, and so does Ctrl-C
    """
    return _wrinkle.run(scene._scene, pathlib.Path(out), list(frames), device, progress)


def explain(scene: Scene) -> dict:
    """What `wrinkle explain` tells of a scene that reads its frame from files: stages, planes, expected cost."""
    done = subprocess.run([program(), "explain", "-", "--json", "--no-source"], input=scene.toml, cwd=scene.folder,
                          capture_output=True, text=True, check=False)
    if done.returncode:
        raise _wrinkle.Error(done.stderr.strip())
    return json.loads(done.stdout)
