#!/usr/bin/env python3
"""What GPUs would run, without one: compiles the kernels of every scene and every function at one lane for an AMD GPU (gfx906)
and an NVIDIA one (sm_80) with clang and libclc, and prints registers, private memory and waves as a table; of scenes also the registers
that they need at one point a pixel ([filter] taps = 1). With a file that holds such a table, exit code 1 where a number has become worse than there or a row is missing; 77 where libclc is not installed.

    bench/gpu_code.py build/release/wrinkle [bench/README.md]    # Debian: clang-15, libclc-15, libclc-15-dev
"""

import concurrent.futures
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile

root = pathlib.Path(__file__).parents[1]
program = sys.argv[1]
COMMON = ["clang-15", "-x", "cl", "-cl-std=CL1.2", "-O3", "-S", "-nogpulib", "-Wno-everything", "-DWR_LANES=1",
          f"-I{root / 'kernels'}", "-Xclang", "-finclude-default-header"]
BUILTINS = pathlib.Path("/usr/lib/clc")
TARGETS = {
    "AMD": (["-target", "amdgcn-mesa-mesa3d", "-mcpu=gfx906"], "gfx906-amdgcn-mesa-mesa3d.bc"),
    "NVIDIA": (["-target", "nvptx64-nvidia-nvcl", "-Xclang", "-target-cpu", "-Xclang", "sm_80"],
               "nvptx64--nvidiacl.bc"),
}
HEAD = """| scene, kernel | AMD: vector registers | waves a SIMD | private bytes | NVIDIA: private bytes | registers at one point |
|---|---|---|---|---|---|"""
FEW_REGISTERS = 48
WORSE = (lambda a, b: a > b, lambda a, b: a < b, lambda a, b: a > b, lambda a, b: a > b, lambda a, b: a > b)


def assembly(source, target):
    flags, builtins = TARGETS[target]
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder) / "kernel.cl"
        path.write_text(source)
        library = ["-Xclang", "-mlink-bitcode-file", "-Xclang", BUILTINS / builtins]
        done = subprocess.run([*COMMON, *flags, *library, path, "-o", f"{folder}/kernel.s"], capture_output=True, text=True)
        if done.returncode:
            sys.exit(f"{target}: {done.stderr[:2000]}")
        return pathlib.Path(f"{folder}/kernel.s").read_text()


def kernels_of_amd(text):
    """By kernel: vector registers, waves a SIMD, bytes of private memory; those of functions it calls included."""
    rows = {}
    for block in text.split("; -- Begin function ")[1:]:
        if "; Kernel info:" in block:
            rows[block.split(maxsplit=1)[0]] = [int(re.search(rf"^; {what}: (\d+)", block, re.MULTILINE)[1])
                                                for what in ("NumVgprs", "Occupancy", "ScratchSize")]
    return rows


def private_of_nvidia(text, kernel):
    """Bytes of private memory of a kernel, and of what it calls."""
    bodies = {at[1]: text[at.start():text.index("\n}", at.start())]
              for at in re.finditer(r"\.(?:entry|func)\s+(?:\([^)]*\)\s*)?(\w+)\(", text)}

    def private(name):
        depot = re.search(r"__local_depot\d+\[(\d+)\]", bodies[name])
        called = set(re.findall(r"\w+", bodies[name])) & bodies.keys() - {name}
        return (int(depot[1]) if depot else 0) + max(map(private, called), default=0)

    return private(kernel)


def output_of(*arguments):
    return subprocess.run([program, *arguments], check=True, capture_output=True, text=True).stdout


def rows_of_source(name, source, at_one_point):
    amd, nvidia = kernels_of_amd(assembly(source, "AMD")), assembly(source, "NVIDIA")
    one = amd if at_one_point == source else kernels_of_amd(assembly(at_one_point, "AMD"))
    return {f"{name}, {kernel.removeprefix('wr_')}": [*row, private_of_nvidia(nvidia, kernel), one[kernel][0]]
            for kernel, row in amd.items()}


def source_of(scene, *arguments):
    return json.loads(output_of("explain", "--lanes", "1", *arguments, "--json", scene))["source"]


def rows_of(scene):
    """Of a scene's kernels; None: of those that "wrinkle eval" runs, with one row for all that need few registers."""
    if scene is not None:
        return rows_of_source(scene.stem, source_of(scene), source_of(scene, "--set", "filter.taps=1"))
    source = output_of("eval", "--kernels")
    rows = {name.replace("columns_", ""): row for name, row in rows_of_source("functions", source, source).items()}
    few = {name: row for name, row in rows.items() if row[0] <= FEW_REGISTERS and not any(row[2:4])}
    worst = [pick(column) for pick, column in zip((max, min, max, max, max), zip(*few.values()))]
    return {name: row for name, row in rows.items() if name not in few} | {"functions, all_others": worst}


def rows_of_table(path):
    rows = re.findall(r"^\| (\w+, \w+) \| (\d+) \| (\d+) \| (\d+) \| (\d+) \| (\d+) \|$", pathlib.Path(path).read_text(), re.MULTILINE)
    return {name: [int(n) for n in numbers] for name, *numbers in rows}


if not all((BUILTINS / builtins).exists() for _, builtins in TARGETS.values()):
    print("no libclc: on Debian, \"apt-get install libclc-15 libclc-15-dev\"")
    sys.exit(77)
with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as threads:
    made = {name: row for rows in threads.map(rows_of, [*sorted((root / "data/scenes").glob("*.toml")), None])
            for name, row in rows.items()}
print(HEAD)
for name, row in made.items():
    print(f"| {name} | {' | '.join(map(str, row))} |")
if len(sys.argv) > 2:
    known = rows_of_table(sys.argv[2])
    failed = [f"{name}: {row}, was {known.get(name, 'not there')}" for name, row in made.items()
              if name not in known or any(worse(a, b) for worse, a, b in zip(WORSE, row, known[name]))]
    failed += [f"{name}: is gone" for name in known if name not in made]
    if failed:
        sys.exit("worse than, or not in, the table; where that must be, put the new one there:\n" + "\n".join(failed))
