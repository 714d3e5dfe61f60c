"""What a pass writes, as arrays: floats a plane, or as they are to be stored."""

from __future__ import annotations

import numpy as np

from . import _wrinkle
from ._wrinkle import Error
from .gbuffer import encodings, octahedral_encodings

_scalars = {"roughness", "marked"}
_parts = {"lit": "rgb", "slope_covariance": ["xx", "xy", "yy"]}  # of the others: xyz
_directions = {"normal"}  # unsigned integers from 0 to 1 mean -1 to 1


def _planes_of(group: str) -> list[str]:
    return [group] if group in _scalars else [f"{group}.{part}" for part in _parts.get(group, "xyz")]


class Stored:
    """Outputs by name with a dtype, or (dtype, components): 4 components leave a fourth beside three, which is 0; 2 of
    int8 or int16 are octahedral coordinates of the normal."""

    def __init__(self, wanted: dict):
        self.formats: dict[str, _wrinkle.PlaneFormat] = {}
        self._pixels: dict[str, tuple[np.dtype, int]] = {}
        for group, kind in wanted.items():
            planes = _planes_of(group)
            kind, components = kind if isinstance(kind, tuple) else (kind, len(planes))
            self._add(group, planes, np.dtype(kind), components)

    def _add(self, group: str, planes: list[str], kind: np.dtype, components: int):
        of_normal = group == "normal" and components == 2
        if kind not in (octahedral_encodings if of_normal else encodings) or kind == np.uint32 or \
                not (of_normal or components in ({1, 4} if len(planes) == 1 else {len(planes), 4})):
            raise Error(f'output "{group}": float32, float16, uint8, int8, uint16 or int16 is wanted, of {len(planes)} components '
                        f"or 4, or 2 of int8 or int16 for the normal; found {kind}, {components}")
        signed = group in _directions and kind.kind == "u"
        size = kind.itemsize
        for k, plane in enumerate(planes):
            self.formats[plane] = _wrinkle.PlaneFormat(
                (octahedral_encodings if of_normal else encodings)[kind], 0 if of_normal else k * size, components * size,
                2 if signed else 1, -1 if signed else 0, group)
        self._pixels[group] = kind, components

    def arrays(self, names: list[str], shape: tuple[int, int], number: type) -> tuple[dict, dict]:
        """Arrays by output, and by the name that a pass has for each memory the part of them that it writes to."""
        groups: dict[str, list[str]] = {}
        for name in names:
            groups.setdefault(name.partition(".")[0], []).append(name)
        out, memories = {}, {}
        for group, parts in groups.items():
            if group in self._pixels:
                kind, components = self._pixels[group]
                out[group] = memories[group] = np.zeros((*shape, components)[:2 if components == 1 else 3], kind)
                continue
            planes = np.empty((len(parts), *shape), number)
            out[group] = planes[0] if len(parts) == 1 else np.moveaxis(planes, 0, -1)
            memories |= dict(zip(parts, planes))
        return out, memories

    def memories(self, names: list[str], arrays: dict[str, np.ndarray], shape: tuple[int, int], number: type) -> dict:
        """The same of arrays that a run gave before. Raises Error for others."""
        parts: dict[str, int] = {}
        memories = {}
        for name in names:
            group = name.partition(".")[0]
            array, k = arrays.get(group), parts.setdefault(group, 0)
            parts[group] += 1
            stored = group in self._pixels
            whole = stored or array is None or array.ndim != 3 or array.shape[2] <= k
            plane = array if whole else array[..., k]
            kind, components = self._pixels[group] if stored else (np.dtype(number), 1)
            wanted = shape if components == 1 else (*shape, components)
            if plane is None or plane.dtype != kind or plane.shape != wanted or not plane.flags.c_contiguous or \
                    not plane.flags.writeable:
                raise Error(f'out: "{group}" as a run of this pass gives it is wanted, of memory that may be written')
            memories[name] = plane
        return memories
