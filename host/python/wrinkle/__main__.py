"""The command line: `python -m wrinkle run scene.toml`."""

import os
import sys

from .program import program


def main():
    path = program()
    os.execv(path, [path, *sys.argv[1:]])


if __name__ == "__main__":
    main()
