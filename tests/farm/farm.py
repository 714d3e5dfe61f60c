"""farm.py WRINKLE: sequences on real engines, which lose a process in the middle.

Twenty-four frames are evaluated by one process, then by the description that "wrinkle job" writes for Open Job
Description (openjd of the PATH) and for Slurm (tests/farm/slurm.sh; needs root). A process of the farm is killed and its
task put into the queue again: the frames must be the single process's, bit by bit, and none that was done may be done
again. Then says how many frames a minute one worker and two get through. An outline for OpenCue is read by OpenCue's own
library, as nothing here runs its server.
"""

import json
import os
import shutil
import signal
import struct
import subprocess
import sys
import tempfile
import time
import zlib
from pathlib import Path

WRINKLE = str(Path(sys.argv[1]).resolve())
HERE = Path(__file__).resolve().parent
SMALL = HERE.parents[1] / "data/gbuffer/small"
FRAMES = 24


def grey_png(rows):
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    pixels = b"".join(b"\0" + bytes(row) for row in rows)
    header = struct.pack(">IIBBBBB", len(rows[0]), len(rows), 8, 0, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(pixels)) + chunk(b"IEND", b"")


def make_scene(folder):
    """The sample frame under every number, with heights of each frame's own."""
    for frame in range(1, FRAMES + 1):
        shutil.copy(SMALL.with_suffix(".exr"), folder / f"frame.{frame:04}.exr")
        (folder / f"height.{frame:04}.png").write_bytes(
            grey_png([[(x * (frame + 3) + y * 5) % 200 for x in range(64)] for y in range(64)]))
    shutil.copy(SMALL.with_suffix(".camera.json"), folder / "camera.json")
    scene = folder / "scene.toml"
    scene.write_text(
        '[gbuffer]\nfile = "frame.####.exr"\n[camera]\nfile = "camera.json"\n'
        '[[layer]]\nkind = "height_map"\ntexture = "height.####.png"\nscale = 0.02\n'
        '[output]\npictures = ["normal"]\n')
    return scene


def run(*command, **options):
    return subprocess.run([str(c) for c in command], check=True, text=True, stdout=subprocess.PIPE, **options).stdout


def pictures(folder):
    return {path.name: path for path in folder.iterdir() if path.suffix in (".exr", ".png")}


def done(folder):
    return {name: path.stat().st_mtime_ns for name, path in pictures(folder).items()} if folder.is_dir() else {}


def processes():
    """The numbers of the farm's processes of wrinkle."""
    found = []
    for entry in Path("/proc").iterdir():
        try:
            if entry.name.isdigit() and os.readlink(entry / "exe") == WRINKLE:
                found.append(int(entry.name))
        except OSError:
            pass  # it has ended
    return found


def kill_one(folder, at_least):
    """Kills a process once some frames are there; returns which were, and when they were written."""
    end = time.monotonic() + 120
    while time.monotonic() < end:
        before = done(folder)
        running = processes()
        if len(before) >= at_least and running:
            os.kill(running[0], signal.SIGKILL)
            return before
        time.sleep(0.002)
    sys.exit(f"no process to kill in {folder}")


def check(folder, whole, before, engine):
    ours, theirs = pictures(folder), pictures(whole)
    assert ours.keys() == theirs.keys(), (engine, ours.keys() ^ theirs.keys())
    for name, path in theirs.items():
        assert ours[name].read_bytes() == path.read_bytes(), f"{engine}: {name} differs"
    after = done(folder)
    again = [name for name, when in before.items() if after[name] != when]
    # A frame whose last file was not there yet is done as a whole again: it was the killed one's.
    frames = {name.split(".")[1] for name in again}
    assert len(frames) <= 1, f"{engine}: done twice: {sorted(frames)}"
    left = [path.name for path in folder.iterdir() if path.suffix not in (".exr", ".png", ".json", ".sbatch", ".py")]
    assert not left, f"{engine}: left over: {left}"
    print(f"{engine}: {len(before)} of {len(after)} files were there at the kill; all there, the same bytes")


def describe(scene, folder, engine, chunk):
    run(WRINKLE, "job", scene, "--frames", f"1-{FRAMES}", "--chunk", chunk, "--for", engine, "--program", WRINKLE, "-o",
        folder)


def on_openjd(scene, folder, whole):
    describe(scene, folder, "openjd", 6)
    start = ["openjd", "run", "--extensions", "TASK_CHUNKING", str(folder / "wrinkle.openjd.json")]
    with open(folder.with_suffix(".log"), "w") as log:
        job = subprocess.Popen(start, stdout=log, stderr=subprocess.STDOUT)
        before = kill_one(folder, 16)
        assert job.wait() != 0, "a killed task passed"
        subprocess.run(start, check=True, stdout=log, stderr=subprocess.STDOUT)
    check(folder, whole, before, "openjd")


def on_slurm(scene, folder, whole, work):
    describe(scene, folder, "slurm", 6)
    os.environ["SLURM_CONF"] = str(work / "slurm/slurm.conf")
    run(HERE / "slurm.sh", "start", work / "slurm")
    try:
        job = run("sbatch", "--parsable", f"--output={work}/slurm-%a.log", folder / "wrinkle.sbatch").strip()
        before = kill_one(folder, 16)
        failed = None
        end = time.monotonic() + 120
        while time.monotonic() < end:
            states = dict(line.split() for line in
                          run("squeue", "-h", "-r", "-t", "all", "-j", job, "-o", "%K %T").splitlines())
            if failed is None:
                failed = next((task for task, state in states.items() if state == "FAILED"), None)
                if failed is not None:
                    run("scontrol", "requeue", f"{job}_{failed}")
                    time.sleep(1)
                    run("scontrol", "update", f"JobId={job}_{failed}", "StartTime=now")  # not in two minutes
                    continue
            elif all(state == "COMPLETED" for state in states.values()):
                break
            time.sleep(0.5)
        else:
            sys.exit(f"slurm: not done: {states}")
    finally:
        run(HERE / "slurm.sh", "stop", work / "slurm")
    check(folder, whole, before, "slurm")


def on_opencue(scene, folder):
    describe(scene, folder, "opencue", 6)
    script = ("import runpy, sys; job = runpy.run_path(sys.argv[1])['job']; layer = job.get_layers()[0];"
              "print(layer.get_frame_range(), layer.get_chunk_size(), *layer.get_arg('command')[-2:])")
    said = run(sys.executable, "-c", script, folder / "wrinkle.outline.py").split()
    assert said == [f"1-{FRAMES}", "6", "'--frames'", "#FRAMESPEC#"], said
    print("opencue: its library reads the outline")


def throughput(scene, work):
    """Frames a minute of one process on all cores, and of two that have half the frames and half the cores each."""
    cores = os.cpu_count() or 2
    def start(name, frames, threads):
        return subprocess.Popen([WRINKLE, "run", str(scene), "--frames", frames, "--threads", str(threads), "--json",
                                 "-o", str(work / name)], stdout=subprocess.PIPE, text=True)
    for workers in (1, 2):
        began = time.monotonic()
        share = FRAMES // workers
        running = [start(f"speed{workers}_{k}", f"{k * share + 1}-{(k + 1) * share}", max(cores // workers, 1))
                   for k in range(workers)]
        reports = [json.loads(one.communicate()[0].splitlines()[-1]) for one in running]
        took = time.monotonic() - began
        files = sum(r["seconds"]["read"] + r["seconds"]["write"] for r in reports)
        work_time = files + sum(r["seconds"]["kernels"] for r in reports)
        print(f"{workers} worker(s): {60 * FRAMES / took:.0f} frames a minute, {100 * files / work_time:.0f} % of the "
              "time in files")


def main():
    with tempfile.TemporaryDirectory() as name:
        work = Path(name)
        os.environ["WRINKLE_CACHE_DIR"] = str(work / "cache")
        scene = make_scene(work)
        run(WRINKLE, "run", scene, "--frames", f"1-{FRAMES}", "--quiet", "-o", work / "whole")
        on_opencue(scene, work / "opencue")
        on_openjd(scene, work / "openjd", work / "whole")
        on_slurm(scene, work / "slurm_out", work / "whole", work)
        throughput(scene, work)


main()
