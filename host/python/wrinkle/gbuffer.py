"""Frames: planes in memory, or in files."""

from __future__ import annotations

import os
from typing import Iterable

import numpy as np

from . import _wrinkle
from ._wrinkle import Camera, Error
from .scenes import Scene

_roles = _wrinkle.gbuffer_roles()


# How arrays are stored, by dtype; those of other numbers become floats.
encodings = {np.dtype(kind): name for kind, name in [
    ("f4", "float32"), ("f2", "half"), ("u1", "unorm8"), ("u2", "unorm16"), ("i1", "snorm8"), ("i2", "snorm16"),
    ("u4", "uint32")]}
octahedral_encodings = {np.dtype(np.int8): "octahedral8", np.dtype(np.int16): "octahedral16"}
_vectors = {"normal", "tangent", "bitangent"}  # unsigned integers from 0 to 1 mean -1 to 1


def _array(name: str, value) -> np.ndarray:
    """`value` as an array of numbers: the same memory where it is one already."""
    if not hasattr(value, "__array_interface__") and hasattr(value, "__dlpack__"):
        value = np.from_dlpack(value)
    array = np.asarray(value)
    if array.dtype.kind not in "fiub":
        raise Error(f'plane "{name}": float32 is wanted, or numbers that become it; found {array.dtype}')
    return array.astype(array.dtype.newbyteorder("="), copy=False)


def _is_stored(role: str, array: np.ndarray) -> bool:
    """Whether an array is used as it is stored, and not as floats."""
    if array.dtype not in encodings or role == "cryptomatte" or (role == "object") != (array.dtype == np.uint32):
        return False
    return array.dtype != np.float32 or (array.ndim == 3 and array.shape[2] == 4 and array.flags.c_contiguous)


def _object_numbers(array: np.ndarray) -> np.ndarray:
    """Whole numbers as uint32, which holds them all; floats as they are."""
    if array.dtype.kind not in "iu" or array.dtype == np.uint32:
        return array
    if array.size and (array.min() < 0 or array.max() >= 2**32):
        raise Error(f'plane "object": numbers from 0 to 2^32 - 1 are wanted; found {array.min()} to {array.max()}')
    return array.astype(np.uint32)


def _ids_and_coverages(array: np.ndarray) -> list[str]:
    """The planes of a Cryptomatte, whose ids are the bits of floats."""
    if array.dtype not in (np.float32, np.float64):
        raise Error(f'plane "cryptomatte": float32 is wanted, whose bits the ids are (array.view(numpy.float32) of '
                    f'integers); found {array.dtype}')
    if array.ndim != 3 or array.shape[2] == 0 or array.shape[2] % 2 != 0:
        raise Error('plane "cryptomatte": the shape (height, width, 2 n) is wanted, ids and coverages in turn; found '
                    f'{array.shape}')
    return [f"crypto.{part}{k // 2}" for k, part in enumerate(["id", "coverage"] * (array.shape[2] // 2))]


class GBuffer:
    """The passes of a frame, as arrays of (height, width) or (height, width, components), from the top row down.

    camera       a Camera, or any object with `view` and `proj`
    ray_depth    depth is the distance along the ray, not the distance along the view
    channels     further planes by name, for masks and height channels: {"Mask": array}
    planes       by role: position, normal (world space), depth, uv (v up), object, albedo, roughness, beauty, duv_dx, ...
                 (wrinkle.GBuffer.roles); cryptomatte: ids and coverages in turn, (height, width, 2 n)

    beauty_scale pixels along each side of a pixel of the picture: `beauty` then repeats each of its pixels so often, and
                 light is added up over them before the picture is multiplied by ratios of it
    device_depth depth is that of a depth buffer, z / w of the camera's projection, reversed or infinite as that is:
                 "zero_to_one", or "minus_one_to_one" of OpenGL, whose buffers hold (z / w + 1) / 2

    Planes are used as they are stored, without copies where they are contiguous: float32 whose components are planes of
    their own (numpy's moveaxis of a (components, height, width) array), and arrays (height, width) or (height, width,
    components) of float16; of uint8 and uint16, 0 to 1 (of normals and tangents -1 to 1); of int8 and int16, -1 to 1; of
    uint32 for `object`. Three components may have a fourth beside them, which is not read (RGBA). Two
    of int8 or int16 for `normal` are octahedral coordinates. Other numbers become float32: float64, int64, float32 of
    (height, width, 3); objects of other integers become uint32. Anything with __array_interface__ or __dlpack__ will do.
    Pixels of the background have a normal of zero, or a depth that is not finite. Normals of uint8, uint16 and octahedral
    ones are never zero: their background is told by the depth.
    """

    roles = {role: len(planes) for role, planes in _roles.items()}

    def __init__(self, *, camera: Camera, ray_depth: bool = False, device_depth: str = "",
                 beauty_scale: int = 1, channels: dict | None = None, **planes):
        if not isinstance(camera, Camera):
            camera = Camera(np.asarray(camera.view).tolist(), np.asarray(camera.proj).tolist())
        self.camera, self.ray_depth, self.device_depth = camera, ray_depth, device_depth or ""
        self.beauty_scale = beauty_scale
        self._formats: dict[str, _wrinkle.PlaneFormat] = {}
        self._memory: dict[str, np.ndarray] = {}  # by name: those of planes with a format
        self._planes: dict[str, np.ndarray] = {}
        self._shape: tuple[int, int] | None = None
        self._opened = None
        for role, value in planes.items():
            self._add_role(role, value)
        for name, value in (channels or {}).items():
            array = _array(name, value)
            if _is_stored("channel", array) and array.ndim == 2:
                self._store("channel", [f"channel:{name}"], array)
            else:
                self._add(f"channel:{name}", name, array)
        if self._shape is None:
            raise Error("a G-buffer without planes: give at least normal, and depth or position")

    @classmethod
    def read(cls, file: str | os.PathLike, *, camera: dict | None = None, number: int = 0, **gbuffer) -> GBuffer:
        """Opens an EXR frame. Its passes are found by their channels' names, its camera as the scene format says; pass
        `camera` and more keys of [gbuffer] (roles, view, depth, ...) to say so. Planes are read when they are needed."""
        return cls.of(Scene(gbuffer={"file": os.fspath(file), **gbuffer}, camera=camera), number)

    @classmethod
    def of(cls, scene: Scene, number: int = 0) -> GBuffer:
        """The frame that a scene reads from files; `number` stands for #### in its name."""
        if not scene._scene.has_frame:
            raise Error("this scene names no frame; give a GBuffer, or gbuffer={\"file\": \"frame.exr\"}")
        out = cls.__new__(cls)
        out._opened = _wrinkle.OpenedFrame(scene._scene, number)
        out._planes, out._formats, out._memory, out.device_depth = {}, {}, {}, ""
        frame = out._opened.frame
        out.beauty_scale = frame.beauty_scale
        out._shape, out.camera = (frame.height, frame.width), frame.camera
        return out

    @property
    def shape(self) -> tuple[int, int]:
        """(height, width)"""
        return self._shape

    @property
    def names(self) -> list[str]:
        """The planes that there are: "normal.x", "depth", "channel:Mask"."""
        return sorted(self._opened.frame.planes if self._opened else self._planes)

    def plane(self, name: str) -> np.ndarray:
        """A plane by its name, (height, width), as it is stored: float32 unless it was given otherwise. A frame's file is
        read for it."""
        return self._take([name])[name]

    def _take(self, names: Iterable[str]) -> dict[str, np.ndarray]:
        names = list(names)
        if self._opened:
            out = {name: np.empty(self._shape, np.float32) for name in names}
            self._opened.read(names, list(out.values()))
            return out
        for name in names:
            if name not in self._planes:
                raise Error(f'plane "{name}" is needed; there are {", ".join(self.names)}')
        return {name: self._planes[name] for name in names}

    def _bytes(self, memories: Iterable[str]) -> dict[str, np.ndarray]:
        """Memories of planes, as a pass with formats names them."""
        out = {}
        for name in memories:
            array = self._memory[name] if name in self._memory else self._take([name])[name]
            out[name] = array.reshape(-1).view(np.uint8)
        return out

    def _frame(self, scene: Scene | None = None):
        """What a pass may count on, with the ids of the objects that the scene names."""
        if self._opened:
            return self._opened.frame_for(scene._scene) if scene else self._opened.frame
        height, width = self._shape
        return _wrinkle.Frame(width, height, self.camera, set(self._planes), self.ray_depth,
                              list(scene._scene.objects) if scene else [], self._formats, self.device_depth, self.beauty_scale)

    def _add_role(self, role: str, value):
        if role not in _roles and role != "cryptomatte":
            raise Error(f'"{role}" is no role of a plane; there are {", ".join([*_roles, "cryptomatte"])}; other planes '
                        f'go into channels={{"{role}": array}}')
        array = _array(role, value)
        if role == "cryptomatte":
            names = _ids_and_coverages(array)
        else:
            names = _roles[role]
        if role == "object":
            array = _object_numbers(array)
        if len(names) == 1 and array.ndim == 2:
            array = array[..., None]
        if _is_stored(role, array) and array.ndim == 3:
            components = array.shape[2]
            if components == len(names) or (len(names) == 3 and components == 4) or \
                    (role == "normal" and components == 2 and array.dtype in octahedral_encodings):
                self._store(role, names, array)
                return
        if array.ndim != 3 or array.shape[2] != len(names) and (len(names), array.shape[2]) != (3, 4):
            wanted = "(height, width)" if len(names) == 1 else f"(height, width, {len(names)})"
            raise Error(f'plane "{role}": the shape {wanted} is wanted; found {np.shape(value)}')
        for k, name in enumerate(names):
            self._add(name, role, array[..., k])

    def _store(self, role: str, names: list[str], array: np.ndarray):
        """Keeps planes as they are stored, in pixels together."""
        array = np.ascontiguousarray(array)
        size, components = array.dtype.itemsize, array.shape[2] if array.ndim == 3 else 1
        octahedral = len(names) == 3 and components == 2
        encoding = (octahedral_encodings if octahedral else encodings)[array.dtype]
        to_signed = role in _vectors and array.dtype.kind == "u"
        memory = names[0] if components == 1 else role
        for k, name in enumerate(names):
            plane = array if array.ndim == 2 else array[..., min(k, components - 1)]
            self._check(role, plane)
            self._planes[name] = plane
            self._formats[name] = _wrinkle.PlaneFormat(encoding, 0 if octahedral else k * size, components * size,
                                                       2 if to_signed else 1, -1 if to_signed else 0, memory)
        self._memory[memory] = array

    def _add(self, name: str, role: str, plane: np.ndarray):
        self._check(role, plane)
        self._planes[name] = np.ascontiguousarray(plane, np.float32)

    def _check(self, role: str, plane: np.ndarray):
        if plane.ndim != 2 or 0 in plane.shape:
            raise Error(f'plane "{role}": the shape (height, width) is wanted; found {plane.shape}')
        if self._shape is None:
            self._shape = plane.shape
        if plane.shape != self._shape:
            raise Error(f'plane "{role}": {plane.shape[1]} x {plane.shape[0]} pixels, where the planes before it have '
                        f'{self._shape[1]} x {self._shape[0]}')
