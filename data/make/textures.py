"""Make the textures of the sample scenes: tileable, seeded, the same bytes every time.

    python3 textures.py FOLDER          writes FOLDER/*.png; needs python3-numpy and python3-openimageio

Heights are 16-bit grey, 0 the lowest; normal maps 8-bit RGB, green up unless the name says down.
"""
import sys
import tempfile

import numpy as np
import OpenImageIO as oiio

folder = sys.argv[1]


def save(name, pixels, kind):
    pixels = np.ascontiguousarray(pixels if pixels.ndim == 3 else pixels[..., None], dtype=np.float32)
    spec = oiio.ImageSpec(pixels.shape[1], pixels.shape[0], pixels.shape[2], kind)
    spec.attribute("png:compressionLevel", 9)
    file = oiio.ImageOutput.create("x.png")
    file.open(f"{folder}/{name}.png", spec)
    file.write_image(pixels)
    file.close()


def unit(h):
    return (h - h.min()) / (h.max() - h.min())


def cells(size, count, seed, jitter):
    """Distances to the nearest and second nearest feature point of a jittered, wrapped grid; in cells."""
    rng = np.random.default_rng(seed)
    points = (np.stack(np.meshgrid(np.arange(count), np.arange(count), indexing="xy"), -1).astype(float)
              + 0.5 + jitter * (rng.random((count, count, 2)) - 0.5))
    points[::2, :, 0] += 0.5                                    # a running bond
    y, x = np.meshgrid(np.arange(size) + 0.5, np.arange(size) + 0.5, indexing="ij")
    x, y = x * count / size, y * count / size
    near = np.full((2, size, size), 1e9)
    for px, py in points.reshape(-1, 2):
        dx, dy = x - px, y - py
        d = np.hypot(dx - count * np.round(dx / count), dy - count * np.round(dy / count))
        near[1] = np.minimum(near[1], np.maximum(near[0], d))
        near[0] = np.minimum(near[0], d)
    return near


def rough(size, seed, slope, lowest, highest):
    """Noise of a power spectrum f^-slope between two frequencies, tileable."""
    rng = np.random.default_rng(seed)
    f = np.hypot(*np.meshgrid(np.fft.fftfreq(size, 1 / size), np.fft.fftfreq(size, 1 / size), indexing="ij"))
    amplitude = np.where((f >= lowest) & (f <= highest), np.maximum(f, 1) ** (-slope), 0)
    field = np.fft.ifft2(np.fft.fft2(rng.standard_normal((size, size))) * amplitude).real
    return field / field.std()


def normals(height, depth):
    """Tangent-space normals, green up, of a tileable height; `depth` in texture widths."""
    scale = depth * height.shape[0]
    du = (np.roll(height, -1, 1) - np.roll(height, 1, 1)) / 2 * scale
    dv = (np.roll(height, 1, 0) - np.roll(height, -1, 0)) / 2 * scale          # v runs up, rows run down
    n = np.stack([-du, -dv, np.ones_like(du)], -1)
    return n / np.linalg.norm(n, axis=-1, keepdims=True) / 2 + 0.5


def smoothstep(v, a, b):
    t = np.clip((v - a) / (b - a), 0, 1)
    return t * t * (3 - 2 * t)


# Cobbles: rounded stones between joints.
f1, f2 = cells(512, 8, 7, 0.5)
dome = smoothstep(f2 - f1, 0.03, 0.55) ** 0.6
save("cobbles_height", unit(dome + 0.02 * rough(512, 8, 1.2, 4, 60) * dome), "uint16")

# Rock: ridges over a rough ground.
base = rough(256, 21, 1.9, 2, 64)
save("rock_height", unit(base - 0.8 * np.abs(rough(256, 22, 1.8, 2, 48))), "uint16")

# Weave: threads over and under.
y, x = np.meshgrid((np.arange(256) + 0.5) / 256, (np.arange(256) + 0.5) / 256, indexing="ij")
over = np.where((np.floor(8 * x) + np.floor(8 * y)) % 2 == 0, 1.0, 0.0)
along_x = np.sqrt(np.clip(1 - (2 * ((8 * y) % 1) - 1) ** 2, 0, 1)) * (0.65 + 0.35 * np.cos(2 * np.pi * ((8 * x) % 1 - 0.5)))
along_y = np.sqrt(np.clip(1 - (2 * ((8 * x) % 1) - 1) ** 2, 0, 1)) * (0.65 + 0.35 * np.cos(2 * np.pi * ((8 * y) % 1 - 0.5)))
weave = np.where(over > 0, along_x, along_y) + 0.015 * rough(256, 31, 0.6, 16, 100)
n = normals(unit(weave), 0.02)
save("weave_normal", n, "uint8")
n_down = n.copy()
n_down[..., 1] = 1 - n_down[..., 1]
save("weave_normal_green_down", n_down, "uint8")

# A seal: rings and rays, flat at the border, so that the decal has no edge.
y, x = np.meshgrid((np.arange(256) + 0.5) / 128 - 1, (np.arange(256) + 0.5) / 128 - 1, indexing="ij")
r, a = np.hypot(x, y), np.arctan2(y, x)
ring = smoothstep(r, 0.74, 0.78) * (1 - smoothstep(r, 0.84, 0.88)) + smoothstep(r, 0.22, 0.26) * (1 - smoothstep(r, 0.30, 0.34))
star = 1 - smoothstep(r, 0.30 + 0.34 * np.abs(np.cos(4 * a)) ** 3, 0.36 + 0.34 * np.abs(np.cos(4 * a)) ** 3)
save("seal_height", np.clip(ring + 0.8 * star * smoothstep(r, 0.3, 0.4), 0, 1), "uint16")

# Cracks: the borders of irregular cells, sunk, fading out towards the border.
g1, g2 = cells(256, 5, 41, 0.95)
wobble = 0.05 * rough(256, 42, 1.6, 3, 40)
save("cracks_height", 1 - (1 - smoothstep(g2 - g1 + wobble, 0.02, 0.16)) * (1 - smoothstep(r, 0.55, 0.95)), "uint16")

# The torus of render_gbuffer.py as a bake gives it: object-space normals of a rope, 16 strands that turn around it.
v, u = np.meshgrid(1 - (np.arange(128) + 0.5) / 128, (np.arange(256) + 0.5) / 256, indexing="ij")
a, b = 2 * np.pi * (u + 0.5), 2 * np.pi * (v + 0.5)
major, minor, depth = 0.9, 0.36, 0.06
strand = np.pi * (16 * u + 3 * v)
dh = depth * np.pi * np.sin(strand) * np.cos(strand) / np.sqrt(np.sin(strand) ** 2 + 0.05)     # h = depth |sin(strand)|
ring, along_a = major + minor * np.cos(b), np.stack([-np.sin(a), np.cos(a), 0 * a], -1)
along_b = np.stack([-np.cos(a) * np.sin(b), -np.sin(a) * np.sin(b), np.cos(b)], -1)
n = np.stack([np.cos(a) * np.cos(b), np.sin(a) * np.cos(b), np.sin(b)], -1)
n -= (16 * dh / (2 * np.pi * ring))[..., None] * along_a + (3 * dh / (2 * np.pi * minor))[..., None] * along_b
save("rope_object_normal", n / np.linalg.norm(n, axis=-1, keepdims=True) / 2 + 0.5, "uint8")

# Rock again, as slopes: per texel, times 4, in [0,1]; red along u, green up.
rock = rough(128, 23, 1.9, 2, 24)
rock = 2 * unit(rock - 0.8 * np.abs(rough(128, 24, 1.8, 2, 16)))
du, dv = (np.roll(rock, -1, 1) - np.roll(rock, 1, 1)) / 2, (np.roll(rock, 1, 0) - np.roll(rock, -1, 0)) / 2
save("rock_slopes", np.stack([np.clip(4 * d, -1, 1) / 2 + 0.5 for d in (du, dv)] + [0 * du], -1), "uint8")

# Ripples in sand as maketx --bumpslopes writes them, without its mips and its date.
y, x = np.meshgrid((np.arange(64) + 0.5) / 64, (np.arange(64) + 0.5) / 64, indexing="ij")
bend = 0.05 * np.sin(2 * np.pi * x) + 0.03 * np.sin(2 * np.pi * (2 * x + y))
crest = 0.5 + 0.5 * np.sin(2 * np.pi * (6 * (y + bend)))
options = oiio.ImageSpec()
options.attribute("wrapmodes", "periodic,periodic")
options.attribute("maketx:bumpformat", "height")
with tempfile.TemporaryDirectory() as place:
    file = oiio.ImageOutput.create("x.exr")
    file.open(f"{place}/height.exr", oiio.ImageSpec(64, 64, 1, "float"))
    file.write_image(np.ascontiguousarray(np.maximum(crest, 0)[..., None] ** 1.5, dtype=np.float32))
    file.close()
    oiio.ImageBufAlgo.make_texture(oiio.MakeTxBumpWithSlopes, f"{place}/height.exr", f"{place}/ripples.exr", options)
    made = oiio.ImageBuf(f"{place}/ripples.exr")
    spec = oiio.ImageSpec(64, 64, 6, "half")
    spec.channelnames = made.spec().channelnames
    spec.attribute("compression", "zip")
    spec.attribute("uvslopes_scale", 0.0)
    spec.attribute("DateTime", "2026:01:01 00:00:00")
    file = oiio.ImageOutput.create("x.exr")
    file.open(f"{folder}/ripples_bumpslopes.exr", spec)
    file.write_image(made.get_pixels(oiio.FLOAT))
    file.close()
# Swells: three waves a side at most, 21 texels the shortest, so that no way of sampling them shows.
save("swell_height", unit(rough(64, 51, 0.7, 1, 3)), "uint16")

# Half balls: as heights of few texels, to be magnified, and as normals, whose slopes reach the steepest there are.
def ball(size, radius):
    x, y = np.meshgrid((np.arange(size) + 0.5) / size * 2 - 1, 1 - (np.arange(size) + 0.5) / size * 2, indexing="xy")
    return x / radius, y / radius, np.sqrt(np.clip(1 - (x * x + y * y) / radius**2, 0, 1))


save("ball_height", ball(32, 0.8)[2], "uint16")
bx, by, bz = ball(128, 0.9)
inside = bx * bx + by * by < 1
save("ball_normal", np.stack([np.where(inside, bx, 0), np.where(inside, by, 0), np.where(inside, bz, 1)], -1) / 2 + 0.5,
     "uint8")
