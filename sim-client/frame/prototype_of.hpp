#pragma once
/// Index of a scene's prototype by name; empty while the scene does not have it (yet).

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string_view>

#include "engine/scene/resolved_scene.hpp"

namespace septet::frame {

inline std::optional<std::uint32_t> prototype_of(const scene::ResolvedScene& scene, std::string_view name) {
  const auto found = std::ranges::find(scene.prototypes, name, &scene::Prototype::name);
  if (found == scene.prototypes.end()) return std::nullopt;
  return static_cast<std::uint32_t>(found - scene.prototypes.begin());
}

}  // namespace septet::frame
