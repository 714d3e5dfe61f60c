#!/usr/bin/env python3
"""long.py WRINKLE [KILLS [RACES]]: what the tests labelled "faults" try a few times, a thousand times.

Runs a small scene over and over and ends it by signals at random moments, half of the time with O_TMPFILE (as on a
local disk) and half of the time without (as on NFS); replaces frames by rename while they are read; and lets two
processes that cannot see each other, as those of two machines, write the same pictures. No picture may be
corrupt or lost, no temporary file may outlive the next run, and no run may end in a crash.
"""
import os, random, re, shutil, signal, subprocess, sys, tempfile, threading, time

wrinkle = os.path.abspath(sys.argv[1])
kills, races = (int(sys.argv[k]) if len(sys.argv) > k else n for k, n in ((2, 1000), (3, 200)))
data = os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../data")
place = tempfile.mkdtemp(prefix="wrinkle_faults_")
random.seed(7)

# Without O_TMPFILE files need temporary names, which signals must remove and the next run cleans up.
SHIM = r"""
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <stdarg.h>
#define WRAP(name) int name(const char* path, int flags, ...) { \
    va_list list; va_start(list, flags); const int mode = va_arg(list, int); va_end(list); \
    if ((flags & O_TMPFILE) == O_TMPFILE) { errno = EOPNOTSUPP; return -1; } \
    return ((int (*)(const char*, int, ...))dlsym(RTLD_NEXT, #name))(path, flags, mode); }
WRAP(open) WRAP(open64)
"""
shim = os.path.join(place, "no_tmpfile.so")
subprocess.run(["cc", "-shared", "-fPIC", "-O1", "-x", "c", "-", "-o", shim, "-ldl"], input=SHIM.encode(), check=True)
DATE = rb"\d{4}:\d\d:\d\d \d\d:\d\d:\d\d"
# Where a PNG says what it was made from, which holds when the frame was written, and a checksum of that.
MADE_FROM = re.compile(rb"tEXtwrinkle/provenance\0[^\0]*?.{4}(?=.{4}IDAT)", re.DOTALL)
NAMED = dict(os.environ, LD_PRELOAD=shim)


def fail(why):
    sys.exit(f"{why}; see {place}")


def scene(name, frame, camera="small"):
    with open(os.path.join(place, name), "w") as out:
        out.write(f'[gbuffer]\nfile = "{frame}"\n[camera]\nfile = "{data}/gbuffer/{camera}.camera.json"\n'
                  '[[layer]]\nkind = "constant"\ngradient = [0.3, 0, 0]\n')
    return os.path.join(place, name)


def start(text, out, env=os.environ, before=()):
    return subprocess.Popen([*before, wrinkle, "run", text, "-o", out, "--quiet"], env=env, stdout=subprocess.DEVNULL,
                            stderr=subprocess.PIPE, cwd=place)


def pictures(out):
    """The bytes of every file, but for what headers say of when its frame was written."""
    found = {}
    for name in sorted(os.listdir(out)):
        with open(os.path.join(out, name), "rb") as at: found[name] = MADE_FROM.sub(b"", re.sub(DATE, b"", at.read()))
    return found


def clean(text, out, env=os.environ):
    run = start(text, out, env)
    if run.wait() != 0: fail(f"a run without faults failed: {run.stderr.read().decode()}")


def try_kills():
    text, out = scene("scene.toml", f"{data}/gbuffer/small.exr"), os.path.join(place, "out")
    clean(text, out)
    began = time.time()
    clean(text, out)
    whole, good = time.time() - began, pictures(out)
    for k in range(kills):
        env = NAMED if k % 2 else os.environ
        run = start(text, out, env)
        time.sleep(random.uniform(0, 1.1 * whole))
        how = random.choice((signal.SIGKILL, signal.SIGTERM, signal.SIGINT))
        run.send_signal(how)
        if run.wait() not in (0, -how): fail(f"kill {k}: exit {run.returncode}: {run.stderr.read().decode()}")
        left = pictures(out)
        for name, bytes in good.items():
            if left.pop(name, None) != bytes: fail(f"kill {k} by {how}: {name} is lost or corrupt")
        if left and (env is not NAMED or how != signal.SIGKILL): fail(f"kill {k} by {how} left {list(left)}")
        if left or k % 100 == 99:
            clean(text, out, NAMED)
            if pictures(out) != good: fail(f"after kill {k}: {list(pictures(out))}")
    print(f"{kills} kills: no picture lost or corrupt, nothing left over")


def try_races():
    """A frame that is replaced, while it is read, by one of other size and channels."""
    names, goods = ["small", "cycles_torus"], []
    for name in names:  # each with its own camera and, where that is not refused, with the other's
        for camera in names:
            text, out = scene("one.toml", f"{data}/gbuffer/{name}.exr", camera), os.path.join(place, "one")
            shutil.rmtree(out, ignore_errors=True)
            if start(text, out).wait() == 0: goods.append(pictures(out)["normal.png"])
    for name in names: shutil.copy(f"{data}/gbuffer/{name}.exr", os.path.join(place, f"{name}.exr"))
    frame, done = os.path.join(place, "race.exr"), threading.Event()
    shutil.copy(os.path.join(place, "small.exr"), frame)

    def replace():
        while not done.is_set():
            for name in names:
                shutil.copy(os.path.join(place, f"{name}.exr"), frame + ".new")
                os.rename(frame + ".new", frame)

    thread = threading.Thread(target=replace)
    thread.start()
    out, read = os.path.join(place, "race"), 0
    try:
        for k in range(races):
            text = scene("race.toml", frame, names[k % 2])
            shutil.rmtree(out, ignore_errors=True)
            run = start(text, out)
            said = run.stderr.read().decode()
            if run.wait() not in (0, 1) or said.count("\n") > 3: fail(f"race {k}: exit {run.returncode}: {said}")
            if run.returncode == 0:
                read += 1
                if pictures(out)["normal.png"] not in goods: fail(f"race {k}: a picture of neither frame")
    finally:
        done.set()
        thread.join()
    print(f"{races} races: {read} frames read whole, the others refused by a line")


def try_two_machines():
    text, out = scene("two.toml", f"{data}/gbuffer/small.exr"), os.path.join(place, "two")
    clean(text, out)
    good, apart = pictures(out), ["unshare", "--pid", "--fork"]  # the same process numbers in both, as in containers
    if subprocess.run([*apart, "true"], stderr=subprocess.DEVNULL).returncode != 0: apart = []
    for k in range(max(kills // 50, 1)):
        runs = [start(text, out, NAMED, apart) for _ in range(2)]
        for run in runs:
            if run.wait() != 0: fail(f"two machines, {k}: {run.stderr.read().decode()}")
        if pictures(out) != good: fail(f"two machines, {k}: {list(pictures(out))}")
    print("two machines: both wrote, nothing left over")


try_two_machines()
try_kills()
try_races()
shutil.rmtree(place)
