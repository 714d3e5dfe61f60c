#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/gbuffer_roles.h"

/// What the writers call things, as data: the one place to add a writer or a spelling.
namespace wrinkle::io {

/// Spellings of a role's layer, best first: lower case, without "_", "-", blanks and writer prefixes.
struct RoleNames {
    std::string_view role;
    std::vector<std::string_view> layers;
};
std::span<const RoleNames> role_names();

/// "FinalImageMovieRenderQueue_WorldNormal" -> "worldnormal", "__Nworld" -> "nworld".
std::string plain_layer_name(std::string_view base);

/// Component letters of a role with as many planes, in the order of its planes: "xyz", "rgb" ...; lower case.
std::vector<std::vector<std::string_view>> component_sets(std::string_view role, std::size_t planes);

Writer recognise_writer(std::span<const std::string> channels);

}  // namespace wrinkle::io
