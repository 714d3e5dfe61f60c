"""wrinkle from Python, step by step as in a notebook: how error falls with the points of a pixel's area that are paid
for, and a frame relit. Pictures go to the folder of the first argument, "out/python" by default."""

# %% Set-up
import pathlib
import sys
import time

import matplotlib
import numpy as np

import wrinkle

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402 (the backend first)

out = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else "out/python")
out.mkdir(parents=True, exist_ok=True)
scenes = pathlib.Path(__file__).parents[2] / "data" / "scenes"

# %% A ground to the horizon, z = 0, seen from 1.6 m up
width, height = 192, 108
camera = wrinkle.Camera.look_at(eye=(0, -6, 1.6), target=(0, 0, 0.6), up=(0, 0, 1), fov_y=0.7, aspect=width / height)


def ground(factor):
    """The frame with factor x factor pixels for each."""
    rows, columns = height * factor, width * factor
    view, proj = np.array(camera.view), np.array(camera.proj)
    x = (np.arange(columns) + 0.5) / columns * 2 - 1
    y = 1 - (np.arange(rows) + 0.5) / rows * 2
    x, y = np.meshgrid(x, y)
    in_view = np.stack([(x + proj[0, 2]) / proj[0, 0], (y + proj[1, 2]) / proj[1, 1], np.full_like(x, -1)], -1)
    falling = (in_view @ view[:3, :3])[..., 2]  # of a ray that goes 1 m deep
    depth = np.where(falling < -1e-3, -1.6 / np.minimum(falling, -1e-3), np.inf)
    normal = np.zeros((3, rows, columns), np.float32)
    normal[2] = 1
    return wrinkle.GBuffer(camera=camera, depth=depth, normal=np.moveaxis(normal, 0, -1))


# %% The truth: the mean slope of 16 x 16 points in every pixel
def bumps(taps, **keys):
    return wrinkle.Scene(layers=[wrinkle.Noise(frequency=2, octaves=5, scale=0.06, **keys)], filter={"taps": taps})


points = wrinkle.evaluate(bumps(1, footprint=False), ground(16))["normal"]
slopes = points[..., :2] / points[..., 2:]
truth = slopes.reshape(height, 16, width, 16, 2).mean((1, 3))
seen = np.isfinite(ground(1).plane("depth")) & np.isfinite(ground(16).plane("depth")).reshape(
    height, 16, width, 16).all((1, 3))

# %% What a point of a pixel's area costs, and what it gains
frame = ground(1)
cost, error = [], []
for taps in (1, 2, 4, 8, 16):
    one = wrinkle.Pass(bumps(taps), frame)
    normal = one.run(frame)["normal"]
    times = []
    for _ in range(20):
        began = time.perf_counter()
        one.run(frame)
        times.append(time.perf_counter() - began)
    cost.append(np.median(times) / (width * height) * 1e9)
    wanted = np.dstack([truth, np.ones((height, width))])
    wanted /= np.linalg.norm(wanted, axis=-1, keepdims=True)
    angle = np.degrees(np.arccos(np.clip((normal * wanted).sum(-1), -1, 1)))
    error.append(np.median(angle[seen]))
    print(f"{taps:2} points: {cost[-1]:6.1f} ns a pixel, {error[-1]:.2f} degrees off (median)")

figure, axes = plt.subplots(figsize=(6, 4))
axes.plot(cost, error, "o-")
for taps, x, y in zip((1, 2, 4, 8, 16), cost, error):
    axes.annotate(f"{taps}", (x, y), textcoords="offset points", xytext=(6, 4))
axes.set(xlabel="ns a pixel", ylabel="degrees off the pixel's mean", title="Points of a pixel's area", ylim=(0, None))
figure.savefig(out / "pareto.png", dpi=120, bbox_inches="tight")
assert error[-1] < error[0] / 2

# %% A frame relit: the picture times lit(new) / lit(old)
scene = wrinkle.Scene.load(scenes / "kernel.toml")
shot = wrinkle.GBuffer.of(scene)
before = np.dstack([shot.plane(f"beauty.{c}") for c in "rgb"])
after = wrinkle.evaluate(scene, shot)["lit"]
figure, axes = plt.subplots(1, 2, figsize=(12, 4))
for axis, picture, title in zip(axes, (before, after), ("rendered", "with bumps")):
    axis.imshow(np.clip(picture, 0, 1) ** (1 / 2.2))
    axis.set(title=title, xticks=[], yticks=[])
figure.savefig(out / "relit.png", dpi=120, bbox_inches="tight")
print(f"{out / 'pareto.png'}\n{out / 'relit.png'}")
