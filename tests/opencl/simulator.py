"""Runs programs on Oclgrind, which interprets kernels and checks every access to memory that they make."""

import pathlib
import re
import shutil
import subprocess

# Each begins a line of what Oclgrind says.
REPORT = re.compile(r"^(?:Invalid |Unaligned |Uninitialized |Work-group divergence|(?:Read-write|Write-write) data race|"
                    r"OCLGRIND).*", re.MULTILINE)
OUTSIDE_AND_RACE = """
import numpy, pyopencl as cl
device = next(d for p in cl.get_platforms() if p.name == "Oclgrind" for d in p.get_devices())
context = cl.Context([device])
queue = cl.CommandQueue(context)
a = cl.Buffer(context, cl.mem_flags.READ_WRITE, 32)
text = "kernel void f(global int *a) { a[0] = (int)get_global_id(0) + a[get_global_id(0) + 1]; }"
cl.Program(context, text).build().f(queue, (8,), (8,), a)
queue.finish()
"""


def oclgrind(folder):
    """The words before a command that run it on Oclgrind; what has to be compiled for that goes to `folder`."""
    program = shutil.which("oclgrind")
    if program is None:
        raise SystemExit("no oclgrind: on Debian, \"apt-get install oclgrind\"")
    library = pathlib.Path(program).parents[1] / "lib/oclgrind/liboclgrind-rt.so"
    llvm = re.search(r"libLLVM\S+", subprocess.run(["ldd", library], check=True, capture_output=True, text=True).stdout)
    options = pathlib.Path(folder) / "oclgrind_options.so"
    source = pathlib.Path(__file__).with_name("oclgrind_options.c")
    subprocess.run(["cc", "-shared", "-fPIC", source, "-o", options, f"-l:{llvm[0]}"], check=True)
    return ["env", f"LD_PRELOAD={options}", program, "--data-races"]


def reports(text):
    """What Oclgrind found wrong, without repetitions."""
    return list(dict.fromkeys(REPORT.findall(text)))


def check_that_it_reports(command):
    """Ends the program where a kernel that reads outside its buffer, and races, is not told of."""
    done = subprocess.run([*command, "/usr/bin/python3", "-c", OUTSIDE_AND_RACE], capture_output=True, text=True)
    said = " ".join(reports(done.stdout + done.stderr))
    if "Invalid read" not in said or "data race" not in said:
        raise SystemExit(f"Oclgrind finds nothing in a kernel that is wrong:\n{done.stdout}{done.stderr}")
