#pragma once

namespace wrinkle {

/// A valid scene with every table and every kind of layer and light.
inline constexpr const char* full_scene = R"(# every table and every kind
[gbuffer]
file = "shot/../frame.exr"
roles = { position = "ViewLayer.Position", uv = "ViewLayer.UV" }
geometry = "position"
depth = "ray"

[camera]
eye = [1, 2, 3]
target = [0, 0, 0.5]
up = [0, 1, 0]
fov = 45
max_residual = 2

[[layer]]
name = "plaster"
kind = "normal_map"
texture = "textures/wall.png"
y = "-"
wrap = "clamp"
uv = { scale = 2, offset = [0.25, -1], rotation = 90 }
scale = -0.5
blend = "subtract"
footprint = false

[[layer]]
kind = "height_map"
texture = "textures/wall.png"
upscale = "plain"
[layer.uv]
source = "planar"
scale = [2, -3]
axis_u = [0, 1, 0]
axis_v = [0, 0, 2]
[layer.mask]
object = 3
cryptomatte = "#1a2b3c4d"
channel = "Dust.R"
invert = true
texture = "textures/wall.png"
uv = { scale = 4 }

[[layer]]
kind = "triplanar"
texture = "textures/wall.png"
content = "normal"
y = "-"
tile = 0.75
sharpness = 8

[[layer]]
kind = "noise"
frequency = 3.5
octaves = 16
lacunarity = 2.25
gain = 0.25
type = "worley"
feature = "f2-f1"
gradient = "central"
shape = { remap = [-1, 2], bias = 0.75 }

[[layer]]
kind = "resolve"

[[layer]]
kind = "decal"
texture = "textures/wall.png"
center = [1, 2, 3]
axis_x = [2, 0, 0]
axis_y = [5, 0, 3]
half_size = [1, 2, 0.5]
falloff = 0
angle_fade = [60, 75]

[[layer]]
kind = "constant"
gradient = [0.1, 0, -0.2]

[[layer]]
kind = "parallax"
texture = "textures/wall.png"
wrap = "clamp"
uv = { scale = 3 }
mode = "march"
steps = 64
refine = 5
level = 0.5
curved = true
scale = 0.25
footprint = false
mask = { object = 2 }

[lighting]
relight = "ratio"
ambient = [0.1, 0.2, 0.3]
albedo = [0.4, 0.5, 0.6]
roughness = 0.25
f0 = 0.05
max_ratio = 8
exposure = -1.5

[[light]]
kind = "sun"
direction = [0, 3, -4]
color = [1, 0.5, 0.25]
intensity = 3

[[light]]
kind = "spot"
position = [1, 2, 3]
direction = [0, 0, -1]
inner_angle = 10
outer_angle = 20

[[light]]
kind = "point"
position = [4, 5, 6]
diffuse = "lamp_diffuse"
specular = "lamp_specular"

[filter]
taps = 8
curvature = true
light = "mean"

[output]
roughness = true
slope_covariance = true
surface_gradient = true
dp_dx = true
dp_dy = true
marked = true
condition = true
passthrough = true
half = true
png = false

[budget]
max_error = 0.05
sample = 1000
seed = 7
)";

}  // namespace wrinkle
