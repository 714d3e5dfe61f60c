#!/usr/bin/env python3
"""What GPUs would run, without one: compiles the kernel of every scene at one lane for an AMD GPU (gfx906) and an NVIDIA
one (sm_80) with clang and libclc, and prints registers, private memory and waves as a table. Exit code 1 where a kernel
keeps values in private memory, or takes more registers than its limit.

    bench/gpu_code.py build/release/wrinkle [SCENE ...]          # Debian: clang-15, libclc-15, libclc-15-dev
"""

import json
import pathlib
import re
import subprocess
import sys
import tempfile

root = pathlib.Path(__file__).parents[1]
program, scenes = sys.argv[1], sys.argv[2:] or sorted((root / "data/scenes").glob("*.toml"))
COMMON = ["clang-15", "-x", "cl", "-cl-std=CL1.2", "-O3", "-S", "-nogpulib", "-Wno-everything", "-DWR_LANES=1",
          f"-I{root / 'kernels'}", "-Xclang", "-finclude-default-header"]
TARGETS = {
    "AMD": (["-target", "amdgcn-mesa-mesa3d", "-mcpu=gfx906"], "gfx906-amdgcn-mesa-mesa3d.bc"),
    "NVIDIA": (["-target", "nvptx64-nvidia-nvcl", "-Xclang", "-target-cpu", "-Xclang", "sm_80"],
               "nvptx64--nvidiacl.bc"),
}
MOST_REGISTERS = 96
OWN_LIMIT = {"courtyard": 128, "parallax": 146, "decal_table": 256}


def assembly(source, target):
    flags, builtins = TARGETS[target]
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder) / "kernel.cl"
        path.write_text(source)
        library = ["-Xclang", "-mlink-bitcode-file", "-Xclang", f"/usr/lib/clc/{builtins}"]
        done = subprocess.run([*COMMON, *flags, *library, str(path), "-o", f"{folder}/kernel.s"], capture_output=True,
                              text=True)
        if done.returncode:
            sys.exit(f"{target}: {done.stderr[:2000]}")
        return pathlib.Path(f"{folder}/kernel.s").read_text()


def largest(pattern, text):
    return max((int(n) for n in re.findall(pattern, text)), default=0)


failed = []
print("| scene | AMD: vector registers | waves a SIMD | private bytes | NVIDIA: private bytes |\n|---|---|---|---|---|")
for scene in map(pathlib.Path, scenes):
    told = subprocess.run([program, "explain", "--lanes", "1", "--json", scene], check=True, capture_output=True, text=True)
    source = json.loads(told.stdout)["source"]
    amd, nvidia = assembly(source, "AMD"), assembly(source, "NVIDIA")
    registers, private = largest(r"NumVgprs: (\d+)", amd), largest(r"ScratchSize: (\d+)", amd)
    waves = min((int(n) for n in re.findall(r"Occupancy: (\d+)", amd)), default=0)
    depot = largest(r"__local_depot\d+\[(\d+)\]", nvidia)
    print(f"| {scene.stem} | {registers} | {waves} | {private} | {depot} |", flush=True)
    if private or depot or registers > OWN_LIMIT.get(scene.stem, MOST_REGISTERS):
        failed.append(scene.stem)
if failed:
    sys.exit(f"private memory, or more registers than wanted: {', '.join(failed)}")
