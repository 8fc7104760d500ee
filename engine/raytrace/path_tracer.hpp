#pragma once
/// Light that comes along a ray: Kajiya's integral by random paths, "The Rendering Equation" (1986).
///
/// Each point of a path draws one light and samples it directly (next-event estimation), and the path goes on as the
/// surface scatters; where it meets a light by itself, both estimates share by Veach's power heuristic (multiple
/// importance sampling). Sheets of glass and holes let it straight through. In clear bodies it follows Fresnel and
/// Snell exactly.

#include "engine/raytrace/world.hpp"

namespace septet::raytrace {

struct PathSettings {
  /// Edges of a path, from the eye to a light: 1 sees lights alone, 2 the surfaces that they light.
  std::uint32_t longest = 8;
  std::uint32_t roulette_from = 4;  ///< First edge on which a path may end early, by how little light it still carries.
};

/// First visible surface, for the picture's other layers; behind sheets of glass, not the glass.
struct FirstSeen {
  float distance_m = 0.0f;  ///< 0: the sky.
  glm::vec3 normal{0.0f};   ///< World axes.
  glm::vec3 albedo{0.0f};
  std::uint32_t object = 0;       ///< Object number from 1 (TracedPixel::object); 0: the sky.
  std::uint32_t participant = 0;  ///< Participant's number; 0: no participant.
  bool asks_way = false;          ///< Input: true if `from_m` and `to_m` are wanted.
  /// Positions of the visible point as the shutter opens and closes, times 0 and 1.
  glm::vec3 from_m{0.0f}, to_m{0.0f};
};

/// Beginning of a path, and its results.
struct PathStart {
  Ray ray;
  PathRandom random;
  FirstSeen first;           ///< Input: asks_way.
  glm::vec3 radiance{0.0f};  ///< Result, in the units of engine/instant.
};

/// Traces eight paths that begin alike, as a pixel's samples do: their first edges and first light samples are traced
/// as packets, and all others where World::matt_faces is set (matt_paths.hpp). `begun`: bits of those that begin; a
/// path may depend on this set (packet_size), so it must be the same whenever the path is traced. `wanted`: bits of
/// those of them that are traced to their ends; the others' results are unspecified.
void trace_paths(const World& world, const PathSettings& settings, std::uint32_t begun, std::uint32_t wanted,
                 Packet<PathStart>& starts);

}  // namespace septet::raytrace
