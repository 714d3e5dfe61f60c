#!/usr/bin/env python3
"""garbage.py WRINKLE: runs scenes under Oclgrind, which checks every access to memory that kernels make.

The frames hold bits at random (NaN, Inf, denormal and huge numbers in every plane), the layers extremes: decals of no
and of endless size, volumes far away, texture coordinates beyond all integers. Needs Debian's oclgrind and python3-pyopencl; takes half a minute.
"""
import os, random, struct, subprocess, sys, tempfile

sys.path.append(os.path.join(os.path.dirname(__file__), "../opencl"))
import simulator

wrinkle = os.path.abspath(sys.argv[1])
data = os.path.abspath(os.path.join(os.path.dirname(__file__), "../../data"))
place = tempfile.mkdtemp(prefix="wrinkle_garbage_")
oclgrind = simulator.oclgrind(place)
simulator.check_that_it_reports(oclgrind)
WIDTH, HEIGHT = 13, 5
PLANES = ["N.X", "N.Y", "N.Z", "P.X", "P.Y", "P.Z", "Z", "id.X", "uv.U", "uv.V"]


def attribute(name, kind, value):
    return name.encode() + b"\0" + kind.encode() + b"\0" + struct.pack("<i", len(value)) + value


def write_exr(path, planes):
    """Uncompressed scanlines of 32-bit floats."""
    channels = b"".join(n.encode() + b"\0" + struct.pack("<iBxxxii", 2, 0, 1, 1) for n in sorted(planes)) + b"\0"
    window = struct.pack("<4i", 0, 0, WIDTH - 1, HEIGHT - 1)
    head = struct.pack("<ii", 20000630, 2) + b"".join(
        (attribute("channels", "chlist", channels), attribute("compression", "compression", b"\0"),
         attribute("dataWindow", "box2i", window), attribute("displayWindow", "box2i", window),
         attribute("lineOrder", "lineOrder", b"\0"), attribute("pixelAspectRatio", "float", struct.pack("<f", 1)),
         attribute("screenWindowCenter", "v2f", struct.pack("<2f", 0, 0)),
         attribute("screenWindowWidth", "float", struct.pack("<f", 1)))) + b"\0"
    row = 4 * WIDTH * len(planes)
    offsets = [len(head) + 8 * HEIGHT + y * (8 + row) for y in range(HEIGHT)]
    with open(path, "wb") as out:
        out.write(head + struct.pack(f"<{HEIGHT}Q", *offsets))
        for y in range(HEIGHT):
            out.write(struct.pack("<ii", y, row))
            for name in sorted(planes): out.write(b"".join(planes[name][y * WIDTH:(y + 1) * WIDTH]))


EXTREMES = [struct.pack("<f", v) for v in
            (0.0, -0.0, 1e-45, -1e-38, 3.4e38, -3.4e38, float("inf"), float("-inf"), float("nan"), 2147483648.0,
             -2147483904.0, 16777216.0, 4294967296.0, 0.5, 1.0, -1.0)]


def garbage(seed, geometry):
    """Bits at random, extremes, and sound numbers. Most positions are sound, or no camera would fit them at all."""
    draw = random.Random(seed)
    planes = {}
    for name in PLANES:
        if name[0] == "P" and geometry == "depth": continue
        sound = 0.6 if name[0] == "P" else draw.choice((0, 0.3, 0.9))
        planes[name] = [struct.pack("<f", draw.uniform(-2, 2)) if draw.random() < sound else
                        draw.choice(EXTREMES) if draw.random() < 0.5 else struct.pack("<I", draw.getrandbits(32))
                        for _ in range(WIDTH * HEIGHT)]
    return planes


UV = f'[[layer]]\nkind = "{{}}"\ntexture = "{data}/textures/{{}}.png"\n'
SCENES = {
    "uv": UV.format("height_map", "cracks_height") + "scale = 1e30\n" +
          UV.format("normal_map", "weave_normal") + 'wrap = "clamp"\nuv = { scale = 1e9 }\n' +
          UV.format("parallax", "cracks_height") + "scale = 5\n" + UV.format("height_map", "cracks_height"),
    "decals": "".join(f'[[layer]]\nkind = "decal"\ntexture = "{data}/textures/seal_height.png"\n'
                      f"center = [{x}, 0, 0]\nhalf_size = [{h}, {h}, {h}]\n" for x, h in ((0, 1e-30), (1e9, 1e30), (0, 1.0))),
    "volumes": f'[[layer]]\nkind = "volume"\nvolume = "{data}/volumes/noise.vdb"\n'
               f'[[layer]]\nkind = "volume"\nvolume = "{data}/volumes/golden.vdb"\nfilter = "smooth"\n'
               "transform = [[1e-7, 0, 0, 1e6], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]\n",
    "noise": "".join(f'[[layer]]\nkind = "noise"\ntype = "{t}"\nfrequency = 1e9\noctaves = 2\n'
                     for t in ("perlin", "simplex", "worley")),
    "table": f'[[layer]]\nkind = "decals"\nfile = "{place}/table.csv"\n'
             f'textures = [{{ file = "{data}/textures/seal_height.png" }}]\n',
}
with open(f"{place}/table.csv", "w") as table:
    table.write("x,y,z,shape,half_x,half_y,half_z\n")
    for k in range(40):
        table.write(f"{(k - 20) * 10.0 ** (k % 9)},0,{k % 3},{('box', 'sphere', 'cone')[k % 3]},"
                    f"{10.0 ** (k % 7 - 3)},1,1\n")

CAMERA = '[camera]\neye = [0, -8, 3]\ntarget = [0, 0, 0]\nfov = 40\nmax_residual = 1e30\n'
bad = 0
for geometry in ("depth", "position"):
    for seed, (name, layers) in enumerate(SCENES.items()):
        write_exr(f"{place}/frame.exr", garbage(seed, geometry))
        with open(f"{place}/scene.toml", "w") as out:
            out.write(f'[gbuffer]\nfile = "frame.exr"\ngeometry = "{geometry}"\n{CAMERA}{layers}')
        run = subprocess.run([*oclgrind, wrinkle, "run", f"{place}/scene.toml", "-o", f"{place}/out",
                              "--lanes", "1", "--device", "Oclgrind"], capture_output=True, text=True,
                             env=dict(os.environ, WRINKLE_CACHE_DIR=f"{place}/cache"))
        said = run.stdout + run.stderr
        found = simulator.reports(said)
        if run.returncode != 0 or found:
            bad += 1
            print(f"{geometry}, {name}: exit {run.returncode}; " + "; ".join(found[:3] or said.splitlines()[-3:]))
        else:
            print(f"{geometry}, {name}: no invalid access")
sys.exit(min(bad, 1))
