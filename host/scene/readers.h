#pragma once

#include "scene/figure.h"
#include "scene/layer_kind.h"
#include "scene/table.h"
#include "wrinkle/scene.h"

/// One function a table of the scene file.
namespace wrinkle::scene {

/// The file as TOML. Throws Error when it cannot be read, is not TOML or holds nothing.
toml::table parse_scene_file(const std::filesystem::path& file);

/// What wrinkle::load_figure gives, for these kinds of layers.
Figure load_figure(LayerKinds kinds, const std::filesystem::path& file);

/// A scene of text in memory, which `name` calls it in messages; relative paths are relative to `folder`. A scene
/// without [gbuffer] is for those who give passes planes of their own.
Scene parse_scene(LayerKinds kinds, std::string_view text, const std::string& name,
                  const std::filesystem::path& folder);

/// The tables of a scene; the caller finishes `root`, which may hold more.
void read_scene(Table& root, LayerKinds kinds, Scene& out);
void require_gbuffer(Table& root);

void read_gbuffer(Table& table, GBufferSource& out);
void read_camera(Table& table, CameraSource& out);
void read_filter(Table& table, Filter& out);
void read_output(Table& table, Output& out);
void read_budget(Table& table, ErrorBudget& out);

/// `number` counts the layers from 1.
void read_layer(Table& table, LayerKinds kinds, std::size_t number, Layer& out);

void read_lighting(Table& table, Lighting& out);
void read_light(Table& table, Light& out);

/// The tables inside layers.
void read_uv(Table& table, UvMapping& out);
void read_mask(Table& table, Mask& out);
/// Where lighting leaves the picture alone: a mask without a texture.
void read_leave(Table& table, Mask& out);

}  // namespace wrinkle::scene
