"""Python's values as TOML, the form in which the library reads and checks scenes."""

import json
import os
import re

from ._wrinkle import Error


def text_of(value, where: str) -> str:
    """`value` as TOML; `where` names it in messages."""
    if hasattr(value, "keys_as_dict"):
        value = value.keys_as_dict()
    if hasattr(value, "tolist"):  # numpy's arrays and numbers
        value = value.tolist()
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, (int, float)):
        return repr(value)
    if isinstance(value, os.PathLike):
        value = os.fspath(value)
    if isinstance(value, str):
        return json.dumps(value, ensure_ascii=False).replace("\x7f", "\\u007f")
    if isinstance(value, dict):
        return "{ " + ", ".join(f"{key_of(k)} = {text_of(v, f'{where}.{k}')}" for k, v in value.items()) + " }"
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(text_of(v, f"{where}[{i}]") for i, v in enumerate(value)) + "]"
    raise Error(f"{where}: a scene holds numbers, texts, lists and tables; found {type(value).__name__}")


def key_of(name) -> str:
    name = str(name)
    return name if re.fullmatch("[A-Za-z0-9_-]+", name) else json.dumps(name, ensure_ascii=False)


def table(header: str, values: dict) -> str:
    """A table of a file: its header, and a line a key."""
    lines = [header, *(f"{key_of(k)} = {text_of(v, f'{header} {k}')}" for k, v in values.items())]
    return "\n".join(lines) + "\n"
