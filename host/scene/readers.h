#pragma once

#include "scene/table.h"
#include "wrinkle/scene.h"

/// One function a table of the scene file.
namespace wrinkle::scene {

void read_gbuffer(Table& table, GBufferSource& out);
void read_camera(Table& table, CameraSource& out);
void read_output(Table& table, Output& out);

/// `number` counts the layers from 1.
void read_layer(Table& table, std::size_t number, Layer& out);

void read_lighting(Table& table, Lighting& out);
void read_light(Table& table, Light& out);

/// The tables inside layers.
void read_uv(Table& table, UvMapping& out);
void read_mask(Table& table, Mask& out);

}  // namespace wrinkle::scene
