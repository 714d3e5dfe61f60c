#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/gbuffer_roles.h"

/// How the programs that write G-buffers spell the names of layers and components. A new program or spelling is added
/// here.
namespace wrinkle::io {

/// How a role's layer may be spelled, best first, in the form that plain_layer_name() gives.
struct RoleNames {
    std::string_view role;
    std::vector<std::string_view> layers;
};
std::span<const RoleNames> role_names();

/// The role that a layer of this plain name plays; empty: none.
std::string_view role_of_layer(std::string_view plain_name);

/// A layer's name in lower case, without "_", "-", blanks and prefixes of writers:
/// "FinalImageMovieRenderQueue_WorldNormal" becomes "worldnormal", "__Nworld" becomes "nworld".
std::string plain_layer_name(std::string_view base);

/// The sets of component names, in lower case, that a role with so many planes may have: x y z, r g b and so on.
std::vector<std::vector<std::string_view>> component_sets(std::string_view role, std::size_t planes);

Writer recognise_writer(std::span<const std::string> channels);

/// V-Ray writes its normals in camera space, under these plain names; others' layers of the names are in world space.
bool is_vray_camera_normal(std::string_view plain_name);

}  // namespace wrinkle::io
