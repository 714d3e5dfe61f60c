#!/usr/bin/env python3
"""intel.py BUILD FOLDER [ARGUMENTS of ctest]: every test on Intel's OpenCL runtime for CPUs, which PyPI has.

It is installed into FOLDER (700 MB, a virtual environment), and the ICD loader is shown no other. It needs a newer TBB than
Debian's, and of that name a process has one only: Intel's is found first.
"""

import os
import pathlib
import subprocess
import sys
import venv

build, folder = sys.argv[1], pathlib.Path(sys.argv[2]).absolute()
PACKAGES = ["intel-opencl-rt", "intel-cmplr-lib-rt"]  # the second has libimf.so, which the first needs and does not bring


def install():
    if not (folder / "bin/pip").exists():
        venv.create(folder, with_pip=True)
    subprocess.run([folder / "bin/pip", "install", "-q", *PACKAGES], check=True)


def environment():
    """With Intel's libraries before Debian's, all but its ICD loader, and its CPU device alone (not the emulated FPGA)."""
    libraries, vendors = folder / "libraries", folder / "vendors"
    for place in (libraries, vendors):
        place.mkdir(exist_ok=True)
    for file in (folder / "lib").glob("*.so*"):
        link = libraries / file.name
        if not file.name.startswith("libOpenCL") and not link.exists():
            link.symlink_to(file)
    (vendors / "intel.icd").write_text(f"{folder / 'lib/libintelocl.so'}\n")
    return os.environ | {"OCL_ICD_VENDORS": str(vendors), "LD_LIBRARY_PATH": str(libraries),
                         "WRINKLE_CACHE_DIR": str(folder / "cache")}


install()
variables = environment()
subprocess.run([f"{build}/wrinkle", "devices", "--check"], check=True, env=variables)
sys.exit(subprocess.run(["ctest", "--test-dir", build, "--output-on-failure", *sys.argv[3:]], env=variables).returncode)
