#!/usr/bin/env python3
"""run.py BUILD: kernels' tests and small scenes on two OpenCLs that are not PoCL, at one lane as on a GPU.

Oclgrind interprets kernels, checks every access to memory and looks for data races: whatever it reports is a failure.
Rusticl on llvmpipe takes kernels as SPIR-V, has no double, and replaces each fma() by a long function, so that most
kernels take minutes to build: it gets what builds in seconds. Tests, references and bounds are those that PoCL's
results keep, too. Debian: oclgrind, mesa-opencl-icd, python3-pyopencl.
"""

import os
import re
import subprocess
import sys
import tempfile
import time

import simulator

build = sys.argv[1]
failed = []

# Tests that call clang, and no device; clang does not start where Oclgrind is loaded first.
NOT_ON_OCLGRIND = ["*EveryKernelFile*", "*EverySceneSource*"]
SUITES_ON_RUSTICL = ["Area", "BinTests", "GBuffer", "HeightMap", "KernelItems", "Lanes", "Lanes/BinLists", "Lattice", "Layout*",
                     "Mask", "NoiseLookup", "NoiseTable", "ObjectNormal", "Pair", "PixelBlock", "RandomOfCell", "Texture"]
FUNCTIONS_ON_RUSTICL = ["blend_partial_derivative", "blend_whiteout", "combine_udn", "height_slope_plain", "projector_step",
                        "resolve", "shape_ramp", "surface_gradient_from_volume", "tangent_normal_slope", "texture_metres",
                        "texture_step", "triplanar_weights", "volume_trilinear"]


def run(what, command, **variables):
    began = time.monotonic()
    done = subprocess.run(command, capture_output=True, text=True, env=os.environ | variables)
    said = done.stdout + done.stderr
    passed = re.search(r"\[  PASSED  \] (\d+) test", said)
    wrong = simulator.reports(said) + re.findall(r"^\[  FAILED  \] .*\)$", said, re.MULTILINE)
    if wrong or done.returncode or passed is None or passed[1] == "0":
        failed.append(what)
        print("\n".join(wrong[:20] or said.splitlines()[-20:]))
    print(f"{what}: {passed[1] if passed else 'no'} tests passed in {time.monotonic() - began:.0f} s", flush=True)


def run_on(name, kernels, scenes, before=(), **variables):
    variables |= {"WRINKLE_TEST_DEVICE": name, "WRINKLE_TEST_LANES": "1"}
    run(f"{name}, kernels", [*before, f"{build}/tests/test_kernels", f"--gtest_filter={kernels}"], **variables)
    filter = ":".join(f"*AgreesWithTheReference/{scene}" for scene in scenes)
    run(f"{name}, scenes", [*before, f"{build}/tests/test_run", f"--gtest_filter={filter}"], **variables)


with tempfile.TemporaryDirectory(prefix="wrinkle_opencl_") as place:
    cache = {"WRINKLE_CACHE_DIR": f"{place}/cache"}
    oclgrind = simulator.oclgrind(place)
    simulator.check_that_it_reports(oclgrind)
    run_on("oclgrind", f"*:-{':'.join(NOT_ON_OCLGRIND)}", ["constant", "decals", "height_map", "noise"], oclgrind, **cache)
    kernels = [f"{suite}.*" for suite in SUITES_ON_RUSTICL] + [f"*DocumentedError/{f}" for f in FUNCTIONS_ON_RUSTICL]
    run_on("rusticl", ":".join(kernels), ["constant", "decals", "gradient"], RUSTICL_ENABLE="llvmpipe", **cache)
if failed:
    sys.exit(f"failed: {', '.join(failed)}")
