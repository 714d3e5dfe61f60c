"""The three passes over planes in memory."""

from __future__ import annotations

import functools
from typing import Callable

import numpy as np

from . import _wrinkle
from .gbuffer import GBuffer
from .outputs import Stored
from .scenes import Scene


@functools.lru_cache(maxsize=None)
def _opened(wanted: str) -> _wrinkle.Device:
    """A context a device, for all calls that name it."""
    return _wrinkle.Device.open(wanted)


def device_of(device: _wrinkle.Device | str | None) -> _wrinkle.Device:
    return device if isinstance(device, _wrinkle.Device) else _opened(device or "")


class Pass:
    """A pass, built once for frames of one size and the same planes: compiled, its textures on the device.

        bumps = wrinkle.Pass(scene, gbuffer)
        for frame in frames:
            normal = bumps.run(frame)["normal"]

    For one thread at a time; several threads may have a pass each.

    device   of wrinkle.Device, or what `wrinkle --device` takes; a GPU, else a CPU, by default
    lanes    pixels a work-item: 1, 4, 8 or 16; 0: what the device is best at
    fp64     evaluate in double; results are float64
    stored   results that are not float32, by name, as engines hold them: {"normal": (np.int16, 2), "lit": (np.float16, 4)}.
             A dtype, whose components lie in pixels together, or (dtype, components): 4 leaves a fourth beside three, which
             is 0; 2 of int8 or int16 are octahedral coordinates. uint8 and uint16 hold 0 to 1, of the normal -1 to 1; int8 and
             int16 hold -1 to 1; what they cannot hold becomes the nearest that they can
    """

    def __init__(self, scene: Scene, gbuffer: GBuffer, *, device=None, lanes: int = 0, fp64: bool = False,
                 stored: dict | None = None):
        frame, outputs = gbuffer._frame(scene), Stored(stored or {})
        built = _wrinkle.evaluate(device_of(device), scene._scene, frame, lanes, fp64, outputs.formats)
        self._start(built, gbuffer, fp64, outputs)

    def _start(self, built, gbuffer: GBuffer, fp64: bool, outputs: Stored):
        self._pass, self._shape, self._type = built, gbuffer.shape, np.float64 if fp64 else np.float32
        self._outputs = outputs
        self._formats, self._device_depth = dict(gbuffer._formats), gbuffer.device_depth
        return self

    @property
    def inputs(self) -> list[str]:
        """Planes that it reads; of planes that lie in pixels together, the memory that holds them, by the role's name."""
        return self._pass.inputs

    @property
    def outputs(self) -> list[str]:
        """Planes that it writes."""
        return self._pass.outputs

    @property
    def bytes_per_pixel(self) -> float:
        """Of all planes that it reads and writes."""
        return self._pass.bytes_per_pixel

    def set(self, scene: Scene):
        """Takes the numbers of another scene of the same structure: strengths, frequencies, colours, lights. Nothing is
        compiled. Raises Error naming what differs otherwise."""
        self._pass.set_scene(scene._scene)

    def run(self, gbuffer: GBuffer, progress: Callable[[float], object] | None = None, *,
            out: dict[str, np.ndarray] | None = None) -> dict[str, np.ndarray]:
        """Evaluates a frame. Gives arrays by name: (height, width), or (height, width, components), whose components are
        planes of their own in memory, unless they are `stored` otherwise.

        progress   called with the share that is done; what it raises ends the work, and so does Ctrl-C
        out        what a run of this pass gave before, to be written again: a system takes a while to find new memory
        """
        if gbuffer.shape != self._shape:
            raise _wrinkle.Error(f"this pass is for {self._shape[1]} x {self._shape[0]} pixels; the frame has "
                                 f"{gbuffer.shape[1]} x {gbuffer.shape[0]}")
        if gbuffer._formats != self._formats or gbuffer.device_depth != self._device_depth:
            raise _wrinkle.Error("this pass is for planes of other types, or of another layout, than the frame has")
        self._pass.set_camera(gbuffer.camera)
        if out is None:
            out, memories = self._outputs.arrays(self.outputs, self._shape, self._type)
        else:
            memories = self._outputs.memories(self.outputs, out, self._shape, self._type)
        if self._formats or self._outputs.formats:
            whole = {name: plane.reshape(-1).view(np.uint8) for name, plane in memories.items()}
            self._pass.run_bytes(gbuffer._bytes(self.inputs), whole, progress)
        else:
            self._pass.run(gbuffer._take(self.inputs), memories, progress)
        return out

    def enqueue(self, inputs: dict[str, int], outputs: dict[str, int], wait=()) -> int:
        """Enqueues the whole frame on OpenCL buffers made elsewhere, given by pointer (PyOpenCL: buffer.int_ptr), each of
        padded(width * height) pixels: the next multiple of 64. Pixels are floats, of planes stored otherwise what the
        arrays of the G-buffer hold. `wait`: pointers of events. Gives the pointer of an event,
        which is the caller's: pyopencl.Event.from_int_ptr(pointer, retain=False)."""
        return self._pass.enqueue(inputs, outputs, list(wait))


def evaluate(scene: Scene, gbuffer: GBuffer | None = None, *, device=None, lanes: int = 0, fp64: bool = False,
             stored: dict | None = None, progress: Callable[[float], object] | None = None) -> dict[str, np.ndarray]:
    """Every layer of the scene over a frame: {"normal": (height, width, 3), ...}, and what the scene's output and lighting
    ask for: surface_gradient, dp_dx, dp_dy, roughness, slope_covariance, marked, lit. Without `gbuffer` the frame that the
    scene names is read. More: Pass."""
    gbuffer = gbuffer or GBuffer.of(scene)
    return Pass(scene, gbuffer, device=device, lanes=lanes, fp64=fp64, stored=stored).run(gbuffer, progress)


def accumulate_decals(scene: Scene, gbuffer: GBuffer, *, device=None, lanes: int = 0, fp64: bool = False) -> np.ndarray:
    """The volume gradients of a scene's decals, (height, width, 3), without any normal: project them onto the one you
    have: g = v - n (n . v), then normalize(n - g)."""
    built = _wrinkle.accumulate_decals(device_of(device), scene._scene, gbuffer._frame(scene), lanes, fp64, {})
    return Pass.__new__(Pass)._start(built, gbuffer, fp64, Stored({})).run(gbuffer)["volume_gradient"]


def screen_derivatives(gbuffer: GBuffer, *, device=None, lanes: int = 0, fp64: bool = False):
    """dp/dx and dp/dy of the surface, metres per pixel right and down, (height, width, 3) each, without neighbours."""
    built = _wrinkle.screen_derivatives(device_of(device), gbuffer._frame(), lanes, fp64, {})
    out = Pass.__new__(Pass)._start(built, gbuffer, fp64, Stored({})).run(gbuffer)
    return out["dp_dx"], out["dp_dy"]
