"""Put the two renders of render_gbuffer.py into one G-buffer that is small enough to live in a repository.

    python3 pack_gbuffer.py STEM OUT.exr          reads STEM.data.exr and STEM.beauty.exr; STEM.camera.json is copied beside

Channels keep Blender's names. UV, depth, object index and Cryptomatte stay exact float32. Position is rounded to 2^-14 of
the depth (0.03 pixel), normals to 2^-15, since the last bits of a render do not compress; picture and albedo are half
floats. Alpha and the constant third UV channel go. Header: Cryptomatte's metadata stays; dates, times and paths go. The
last lines check the result: channel by channel, and positions through the camera against their pixel centres.
Needs python3-numpy and python3-openimageio.
"""
import json
import shutil
import sys

import numpy as np
import OpenImageIO as oiio

stem, out = sys.argv[1:]
FLOAT = ["Position.X", "Position.Y", "Position.Z", "Normal.X", "Normal.Y", "Normal.Z", "UV.U", "UV.V", "Depth.Z",
         "IndexOB.X", "CryptoObject00.r", "CryptoObject00.g", "CryptoObject00.b", "CryptoObject00.a"]
HALF = ["Combined.R", "Combined.G", "Combined.B", "DiffCol.R", "DiffCol.G", "DiffCol.B"]


def read(path):
    """The first part's header and every part's channels by name."""
    file = oiio.ImageInput.open(path)
    first, channels, part = file.spec(), {}, 0
    while file.seek_subimage(part, 0):
        pixels = file.read_image(part, 0, 0, file.spec().nchannels, "float")
        channels.update({name: pixels[..., i].copy() for i, name in enumerate(file.spec().channelnames)})
        part += 1
    file.close()
    return first, channels


def layer(name):
    return "ViewLayer." + name


spec_in, data = read(stem + ".data.exr")
_, beauty = read(stem + ".beauty.exr")
data.update({layer(n): beauty[layer(n)] for n in HALF[:3]})
depth = data[layer("Depth.Z")]
step = np.exp2(np.floor(np.log2(np.where(depth < 1e9, depth, 1))) - 14)
for axis in "XYZ":
    data[layer("Position." + axis)] = (np.round(data[layer("Position." + axis)] / step) * step).astype(np.float32)
    data[layer("Normal." + axis)] = (np.round(data[layer("Normal." + axis)] * 2**15) / 2**15).astype(np.float32)
# One part a pass: ZIP looks back 32 KiB only, and rows of twenty channels side by side would not fit. Small frames stay in
# one part, the way Blender writes them.
PARTS = [["Combined"], ["DiffCol"], ["Position"], ["Normal"], ["UV"], ["Depth"], ["IndexOB", "CryptoObject00"]]
if spec_in.width < 500:
    PARTS = [sum(PARTS, [])]


def part_spec(number, channels):
    spec = oiio.ImageSpec(spec_in.width, spec_in.height, len(channels), "float")
    spec.channelnames = [layer(n) for n in channels]
    spec.channelformats = tuple(oiio.TypeDesc("half" if n in HALF else "float") for n in channels)
    spec.attribute("compression", "zip:9")
    spec.attribute("Software", "Blender 3.4, repacked by wrinkle data/make/pack_gbuffer.py")
    spec.attribute("DateTime", "2000:01:01 00:00:00")  # a fixed date: the same input gives the same bytes
    if len(PARTS) > 1:
        spec.attribute("oiio:subimagename", "+".join(PARTS[number]))
    for attribute in spec_in.extra_attribs:
        if attribute.name.startswith("cryptomatte/"):
            spec.attribute(attribute.name, attribute.value)
    return spec


groups = [[n for n in HALF + FLOAT if n.split(".")[0] in part] for part in PARTS]
specs = [part_spec(k, group) for k, group in enumerate(groups)]
file = oiio.ImageOutput.create(out)
for k, group in enumerate(groups):
    opened = file.open(out, tuple(specs)) if k == 0 else file.open(out, specs[k], "AppendSubimage")
    pixels = np.stack([data[layer(n)] for n in group], axis=-1).astype(np.float32)
    if not opened or not file.write_image(pixels):
        sys.exit(file.geterror())
file.close()
camera_file = out[:-len(".exr")] + ".camera.json"
shutil.copyfile(stem + ".camera.json", camera_file)

# --- checks ---
spec_out, back = read(out)
for n in FLOAT:
    if not np.array_equal(back[layer(n)].view(np.uint32), data[layer(n)].view(np.uint32)):
        sys.exit(f"{n}: bits changed")
manifest = [a for a in spec_out.extra_attribs if a.name.endswith("/manifest")]
if not manifest:
    sys.exit("the Cryptomatte manifest is gone")
camera = json.load(open(camera_file))
matrix = np.array(camera["proj"]) @ np.array(camera["view"])
seen = back[layer("Depth.Z")] < 1e9
p = np.stack([back[layer("Position." + c)][seen] for c in "XYZ"] + [np.ones(seen.sum())], axis=-1).astype(np.float64)
clip = p @ matrix.T
x = (clip[:, 0] / clip[:, 3] + 1) / 2 * camera["width"]
y = (1 - clip[:, 1] / clip[:, 3]) / 2 * camera["height"]
j, i = np.nonzero(seen)
residual = np.hypot(x - i - 0.5, y - j - 0.5)
depth_error = np.abs(clip[:, 3] - back[layer("Depth.Z")][seen]) / clip[:, 3]
print(f"{out}: {spec_out.width}x{spec_out.height}, {seen.mean():.1%} covered; reprojection p50 {np.median(residual):.5f} "
      f"p99 {np.quantile(residual, .99):.5f} max {residual.max():.5f} px; depth against position {depth_error.max():.1e}")
index = back[layer("IndexOB.X")]
ids = json.loads(manifest[0].value)
for value in np.unique(index):
    here = index == value
    uv = [back[layer("UV." + c)][here] for c in "UV"]
    id0 = np.unique(back[layer("CryptoObject00.r")][here].view(np.uint32))
    named = [name for name, h in ids.items() if int(h, 16) in id0]
    print(f"  object {value:.0f} {'/'.join(named) or 'background'}: {here.sum()} pixels, u {uv[0].min():.3f}..{uv[0].max():.3f}"
          f" v {uv[1].min():.3f}..{uv[1].max():.3f}")
