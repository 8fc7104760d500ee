#pragma once
/// Surroundings of a lone object of ice: a panorama on the walls of a wide room, or a field under the sky.

#include <glm/vec3.hpp>

#include "engine/scene/resolved_scene.hpp"

namespace septet::ice_viewer {

enum class Surroundings : std::uint8_t {
  room,      ///< Panorama alone: the same from every place, as in the references.
  outdoors,  ///< Sun, sky, a field and coloured columns.
};

/// Panorama's colour in a direction (unit; z is up), linear Rec. 709, each from 0 to 1: a chequered floor, coloured
/// columns and bright windows.
glm::vec3 panorama(const glm::vec3& direction);

/// Radiance of the room's walls, as a share of the panorama's colour.
inline constexpr float room_radiance = 0.5f;

scene::ResolvedScene scene_around(Surroundings surroundings);

}  // namespace septet::ice_viewer
