#!/usr/bin/env python3
"""What Python adds to a pass: Pass.run() on 4K planes in numpy beside the C++ pass on the same memory, in turn.

    build/venv/bin/python bench/python_pass.py [SECONDS]      # after ./bootstrap python

Prints medians of processor time, and the median of the ratios of neighbours; exit code 1 where Python takes more than 5 % longer than the C++
pass into memory of the same kind: that of an earlier run, or new one, which the system has to find and clear.
"""

import statistics
import sys
import time

import numpy as np

import wrinkle

HEIGHT, WIDTH = 2160, 3840


def ball_on_ground():
    """A frame of depth and normals that differ from pixel to pixel."""
    y, x = np.mgrid[0:HEIGHT, 0:WIDTH].astype(np.float32)
    normal = np.empty((3, HEIGHT, WIDTH), np.float32)
    normal[0], normal[1] = np.sin(x / 97) * 0.2, np.cos(y / 53) * 0.2
    normal[2] = np.sqrt(1 - normal[0] ** 2 - normal[1] ** 2)
    camera = wrinkle.Camera.look_at(eye=(0, 0, 4), target=(0, 0, 0), up=(0, 1, 0), fov_y=0.8, aspect=WIDTH / HEIGHT)
    return wrinkle.GBuffer(camera=camera, depth=4 + np.sin((x + y) / 211) * 0.1, normal=np.moveaxis(normal, 0, -1))


def seconds_of(work):
    """Of all threads: what others do on the machine does not count."""
    began = time.process_time()
    work()
    return time.process_time() - began


def race(name, scene, gbuffer, seconds):
    """Prints a table; gives the largest ratio of Python's to what C++ takes into the same kind of memory."""
    bumps = wrinkle.Pass(scene, gbuffer)
    kept = bumps.run(gbuffer)
    inputs = gbuffer._take(bumps.inputs)
    outputs = bumps._outputs.memories(bumps.outputs, kept, gbuffer.shape, np.float32)

    def into_new_memory():
        bumps._pass.run(inputs, {plane: np.empty(gbuffer.shape, np.float32) for plane in bumps.outputs}, None)

    work = {"C++": lambda: bumps._pass.run(inputs, outputs, None), "C++, new memory": into_new_memory,
            "Pass.run(out=...)": lambda: bumps.run(gbuffer, out=kept), "Pass.run()": lambda: bumps.run(gbuffer),
            "evaluate()": lambda: wrinkle.evaluate(scene, gbuffer)}
    like = {what: "C++" if what in ("C++", "Pass.run(out=...)") else "C++, new memory" for what in work}
    times = {what: [] for what in work}
    until = time.perf_counter() + seconds
    while time.perf_counter() < until or len(times["evaluate()"]) < 6:
        for what, one in work.items():
            times[what].append(seconds_of(one))
    ratios = {what: statistics.median(a / b for a, b in zip(mine[1:], times[like[what]][1:])) for what, mine in times.items()}
    for what, mine in times.items():
        print(f"{name:<10} {what:<18} {statistics.median(mine[1:]) * 1e3:8.1f} ms   x {ratios[what]:.3f} of {like[what]}")
    return max(ratios.values())


seconds = float(sys.argv[1]) if len(sys.argv) > 1 else 20
frame = ball_on_ground()
scenes = {"constant": wrinkle.Scene(layers=[wrinkle.Constant(gradient=[0.25, 0.5, 0])]),
          "noise": wrinkle.Scene(layers=[wrinkle.Noise(frequency=8, octaves=4, scale=0.01)])}
worst = max([race(name, scene, frame, seconds) for name, scene in scenes.items()])
sys.exit(0 if worst <= 1.05 else f"Python adds {worst - 1:.1%}")
