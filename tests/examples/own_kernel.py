"""A kernel of your own that uses wrinkle's functions, with nothing of wrinkle but its kernel files: own_kernel.cl, on a
frame that looks straight down, what it reads filled in by hand. Offsets are those of kernels/README.md, the texture lies
as kernels/sources/texture.clh says. Checked against numpy in double. Arguments: the folder of wrinkle's kernel files,
and the kernel. Needs pyopencl and numpy."""
import sys
import numpy as np
import pyopencl as cl

width, height, texels = 64, 48, 4
eye, center, half = np.array([0.25, -0.5, 4]), np.array([0.5, 0, 0]), np.array([0.75, 0.5, 0.5])

# wr_camera. The ray through pixel (x, y) is d0 + x dx + y dy, 1 long along the view; x to the right, y down.
d0, dx, dy = np.array([-2 / 3, 0.5, -1]), np.array([4 / 3 / width, 0, 0]), np.array([0, -1 / height, 0])
camera = np.zeros(76)
camera[0:2], camera[2:5] = (width, height), eye  # eye_low stays 0, as floats hold this eye exactly
camera[8:11], camera[11:14], camera[14:17] = d0, dx, dy
camera[17:20], camera[20:23] = np.cross(dx, d0), np.cross(dx, dy)
camera[23:26], camera[26:29] = np.cross(dy, d0), np.cross(dy, dx)

# wr_projector: a box along the axes that fades over a tenth of its half size, and from 60 to 75.5 degrees.
projector = np.zeros(32)
projector[0:3] = center - eye
projector[3], projector[7], projector[11] = 1 / half  # the diagonal of to_box
projector[12:14] = 0.1 / 2                            # strength: 10 cm of height, image coordinates from -1 to 1
projector[14:16], projector[16:19] = 1, 1 / 0.1       # repeat, falloff
projector[19], projector[20] = half[2] / 0.25, 1      # fade_slope, fade_zero
projector[25], projector[26] = 1, 1                   # tile, opacity

# A texture of slopes dh/ds, dh/dt: rows from the bottom up, each level with a border of one texel, as it wraps.
image = np.sin(np.arange(2 * texels**2) ** 2.0).reshape(texels, texels, 2).astype(np.float32)
texture, heap, level = np.zeros(19, np.uint32), [], image
texture[0:3] = texels, texels, 3  # width, height, levels
for k in range(3):
    texture[3 + k] = sum(map(len, heap))
    heap.append(np.pad(level, ((1, 1), (1, 1), (0, 0)), mode="wrap").ravel())
    level = (level[0::2, 0::2] + level[1::2, 0::2] + level[0::2, 1::2] + level[1::2, 1::2]) / 4 if k < 2 else level
heap.append(np.zeros(4))  # read with the last texel, not used

# The frame: a rough ground, as a G-buffer holds it.
i = np.arange(width * height)
nx, ny, depth = 0.3 * np.sin(0.1 * i), 0.3 * np.cos(0.07 * i), np.float32(4 + 0.2 * np.sin(0.03 * i))
n = np.float32([nx, ny, np.sqrt(1 - nx**2 - ny**2)])

context = cl.create_some_context(interactive=False)
queue = cl.CommandQueue(context)
program = cl.Program(context, open(sys.argv[2]).read())
program.build(["-cl-std=CL1.2", "-D", "WR_LANES=1", "-I", sys.argv[1]])
give = lambda v, t=np.float32: cl.Buffer(context, cl.mem_flags.COPY_HOST_PTR, hostbuf=np.ascontiguousarray(v, t))
bumped = give(np.zeros_like(n))
program.bump(queue, (width * height,), None, give(camera), give(projector), give(np.concatenate(heap)),
             give(texture, np.uint32), give(depth), give(n[0]), give(n[1]), give(n[2]), bumped)
out = np.empty_like(n)
cl.enqueue_copy(queue, out, bumped)


def slope(s, t):
    """(dh/ds, dh/dt) of the image, bilinear and repeated."""
    x, y = s * texels - 0.5, t * texels - 0.5
    i, j, f, g = np.int64(np.floor(x)), np.int64(np.floor(y)), x - np.floor(x), y - np.floor(y)
    at = lambda i, j: np.float64(image[j % texels, i % texels]).T
    return (1 - g) * ((1 - f) * at(i, j) + f * at(i + 1, j)) + g * ((1 - f) * at(i, j + 1) + f * at(i + 1, j + 1))


n, depth = np.float64(n), np.float64(depth)
ray = d0[:, None] + np.outer(dx, i % width + 0.5) + np.outer(dy, i // width + 0.5)
p = eye[:, None] + ray * depth
q = (p - center[:, None]) / half[:, None]
weight = np.clip((1 - abs(q)) / 0.1, 0, 1).prod(axis=0) * np.clip((n[2] - 0.25) / 0.25, 0, 1)
g = np.zeros_like(n)  # dh/dp of the height map and of the decal
g[:2] = 0.03 * slope(p[0], p[1]) + weight * slope((q[0] + 1) / 2, (q[1] + 1) / 2) * 0.1 / (2 * half[:2, None])
m = n - (g - n * (n * g).sum(axis=0))
worst = abs(out - m / np.linalg.norm(m, axis=0)).max()
print("largest error", worst)
sys.exit(0 if worst < 1e-6 else 1)
