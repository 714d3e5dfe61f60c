"""Kernel functions by themselves, over arrays."""

from __future__ import annotations

import os

import numpy as np

from . import _wrinkle
from .passes import device_of


def functions() -> list[str]:
    """The names that eval() knows; kernels/README.md says what they do, and how exactly."""
    return _wrinkle.function_names()


def eval(name: str, *, precision: str = "standard", fp64: bool = False, device=None, **arguments) -> dict:  # noqa: A001
    """A kernel function for every row of arrays: eval("resolve", n=normals, g=gradients)["normal"].

    Parameters of one number are arrays (rows,), vectors (rows, 3), pairs (rows, 2); settings are numbers, lists of
    numbers or file names. Gives the results by name. `precision`: "fast", "standard" or "exact"; `fp64`: in double.
    Raises Error naming the parameter or setting that is missing, unknown or of another length.
    """
    about = _wrinkle.describe_function(name)
    kind = np.float64 if fp64 else np.float32
    inputs, rows = {}, None
    for parameter, columns, unit, meaning in about["parameters"]:
        if parameter not in arguments:
            continue
        given = np.asarray(arguments.pop(parameter), kind)
        array = given[..., None] if len(columns) == 1 else given
        if array.ndim != 2 or array.shape[1] != len(columns):
            wanted = "(rows,)" if len(columns) == 1 else f"(rows, {len(columns)})"
            raise _wrinkle.Error(f'{name}: "{parameter}" ({meaning}, {unit}) has the shape {wanted}; found {given.shape}')
        rows = len(array) if rows is None else rows
        inputs.update({column: np.ascontiguousarray(array[:, k]) for k, column in enumerate(columns)})
    settings = {key: os.fspath(value) if isinstance(value, (str, os.PathLike)) else np.atleast_1d(value).tolist()
                for key, value in arguments.items()}
    known = {setting for setting, _ in about["settings"]}
    for key in settings.keys() - known:
        there = [p[0] for p in about["parameters"]] + sorted(known)
        raise _wrinkle.Error(f'{name} has no parameter or setting "{key}"; there are {", ".join(there)}')
    results = {r: np.empty((len(columns), rows or 0), kind) for r, columns, _, _ in about["results"]}
    outputs = {column: results[r][k] for r, columns, _, _ in about["results"] for k, column in enumerate(columns)}
    _wrinkle.evaluate_function(device_of(device), name, inputs, outputs, precision, settings)
    return {r: array[0] if len(array) == 1 else array.T for r, array in results.items()}
