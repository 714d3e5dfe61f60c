#!/usr/bin/env python3
"""How far relit pictures are from a re-render, frame by frame, mode by mode and object by object, and which bars they meet.

    bench/picture/relit.py [--wrinkle build/release/wrinkle] [--pictures FOLDER] [SCENE.toml ...]

Without a scene: relit.toml and yard.toml beside this. Their frames are render.py's; the layers bump its objects 1, 2 ... in turn, and are
what these are called. Rows: the unbumped picture, a re-render with another seed, and what wrinkle makes of it in each mode of
relit_modes.py. Columns: FLIP and dB of the frame and of each object, FLIP of the ground in the sun's shadow, and the share of the pixels
just behind the terminator of the sun that are more than 1.1 times as bright as in the re-render. --pictures keeps what was written. Needs what picture_error.py needs.
"""
import argparse
import pathlib
import subprocess
import sys
import tempfile
import tomllib

import numpy as np

from picture_error import decibels, flip, linear, planes
from relit_modes import frame_of, modes

HERE = pathlib.Path(__file__).parent
BEHIND = 0.08  # of the pixels behind the terminator may be too bright
WORSE = 0.0005  # of FLIP: what three digits do not show


class Truth:
    """A frame, and what of it is looked at."""

    def __init__(self, scene):
        self.told = tomllib.loads(scene.read_text())
        frame = planes(frame_of(scene))
        self.bumped, self.unbumped = linear(frame, "Bumped."), linear(frame, "ViewLayer.Combined.")
        self.again = linear(frame, "BumpedAgain.")
        index = frame["ViewLayer.Object Index.X"].round().astype(int)
        layers = [layer["name"] for layer in self.told["layer"]]
        names = layers + [f"object {k + 1}" for k in range(len(layers), index.max())]
        self.objects = {name: index == k + 1 for k, name in enumerate(names)}
        normal = np.stack([frame[f"ViewLayer.Normal.{c}"] for c in "XYZ"], axis=2)
        sun = next(light for light in self.told["light"] if light["kind"] == "sun")
        facing = normal @ -np.array(sun["direction"]) / np.linalg.norm(sun["direction"])
        metal = linear(frame, "ViewLayer.Diffuse Color.").max(axis=2) <= 0.001
        self.behind = (facing < 0) & (facing > -0.3) & (index > 0) & ~metal
        self.shadow = self._shadow(linear(frame, "ViewLayer." + sun["picture"] + ".").sum(axis=2), facing)

    def _shadow(self, sunlight, facing):
        """The ground where the sun shows less than a tenth of what it does on most of it."""
        ground = self.objects.get("ground", np.zeros(facing.shape, bool)) & (facing > 0)
        return ground & (sunlight < 0.1 * np.median(sunlight[ground])) if ground.any() else ground

    def figures(self, picture):
        """FLIP and dB of each place, FLIP in the shadow, and the share behind the terminator that is too bright."""
        error = flip(picture, self.bumped)
        places = {"frame": np.ones(error.shape, bool)} | self.objects
        brighter = picture.sum(axis=2) > 1.1 * self.bumped.sum(axis=2)
        return ({name: (error[where].mean(), decibels(picture, self.bumped, where)) for name, where in places.items()},
                error[self.shadow].mean() if self.shadow.any() else 0.0, brighter[self.behind].mean() if self.behind.any() else 0.0)


def verdict(mode, now, unbumped):
    """What a mode misses of the bars, in words."""
    (places, shadow, behind), (before, shadow_before, _) = now, unbumped
    missed = []
    share, gain = places["frame"][0] / before["frame"][0], places["frame"][1] - before["frame"][1]
    if share > mode.flip:
        missed.append(f"FLIP {share:.2f} of the unbumped, not {mode.flip}")
    if mode.decibels and gain < mode.decibels:
        missed.append(f"{gain:.2f} dB above, not {mode.decibels}")
    missed += [f"{name} worse" for name in places if places[name][0] > before[name][0] + WORSE]
    if shadow > shadow_before + WORSE:
        missed.append("ground in shadow worse")
    if behind > BEHIND:
        missed.append(f"{behind:.0%} too bright behind the terminator")
    return f"{share:.2f} of unbumped, {gain:+.1f} dB: " + ("all bars met" if not missed else "MISSED: " + "; ".join(missed))


def line(name, figures):
    places, shadow, behind = figures
    return f"{name:38}" + "".join(f"{f:8.3f}{d:6.1f}" for f, d in places.values()) + f"{shadow:8.3f}{behind:8.1%}"


def relit(wrinkle, text, folder):
    """The picture that wrinkle makes of a scene."""
    folder.mkdir(parents=True)
    (folder / "scene.toml").write_text(text)
    ran = subprocess.run([wrinkle, "run", folder / "scene.toml", "-o", folder], capture_output=True, text=True, check=False)
    if ran.returncode:
        sys.exit(ran.stdout + ran.stderr)
    return linear(planes(folder / "lit.exr"))


def measure(scene, wrinkle, folder):
    truth = Truth(scene)
    print(f"{scene.stem:38}" + "".join(f"{name:>14}" for name in ["frame", *truth.objects]) + "  shadow  behind")
    unbumped = truth.figures(truth.unbumped)
    print(line("unbumped", unbumped))
    print(line("another seed", truth.figures(truth.again)))
    verdicts = []
    for mode in modes(scene):
        now = truth.figures(relit(wrinkle, mode.text, folder / mode.name.replace(",", "").replace(" ", "_")))
        print(line(mode.name, now), flush=True)
        verdicts.append(f"  {mode.name:38}{verdict(mode, now, unbumped)}")
    print(*verdicts, sep="\n", end="\n\n")


arguments = argparse.ArgumentParser()
arguments.add_argument("--wrinkle", type=pathlib.Path, default=HERE.parents[1] / "build/release/wrinkle")
arguments.add_argument("--pictures", type=pathlib.Path)
arguments.add_argument("scenes", nargs="*", type=pathlib.Path)
asked = arguments.parse_args()
with tempfile.TemporaryDirectory() as scratch:
    for file in asked.scenes or [HERE / "relit.toml", HERE / "yard.toml"]:
        measure(file, asked.wrinkle, (asked.pictures or pathlib.Path(scratch)) / file.stem)
