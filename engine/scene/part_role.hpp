#pragma once
/// The names of part roles in the tag `draw.role`.

#include <string_view>

#include "engine/scene/resolved_scene.hpp"

namespace septet::scene {

std::string_view name_of(PartRole role);
/// `fixed` for an unknown name.
PartRole part_role(std::string_view name);

}  // namespace septet::scene
