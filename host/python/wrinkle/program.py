"""Where the command-line program is."""

import os
import pathlib
import shutil

from ._wrinkle import Error


def program() -> str:
    """The program of this package: as installed, or of the build that it stands in. Raises Error when there is none."""
    here = pathlib.Path(__file__).parent
    module_folder = pathlib.Path(_module_file()).parent
    for path in (here / "bin" / "wrinkle", module_folder / "bin" / "wrinkle", module_folder.parent.parent / "wrinkle"):
        if path.is_file() and os.access(path, os.X_OK):
            return str(path)
    found = shutil.which("wrinkle")
    if found:
        return found
    raise Error(f"the program wrinkle is neither in {here / 'bin'} nor on PATH; install the package again")


def _module_file() -> str:
    from . import _wrinkle

    return _wrinkle.__file__
