#pragma once
/// The light that comes along a ray: Kajiya's integral by paths of chance, "The Rendering Equation" (1986).
///
/// At each point of a path one light is drawn and looked at directly (next-event estimation), and the path goes on as the
/// surface scatters; where it meets a light by itself, both estimates share by Veach's power heuristic (multiple importance
/// sampling). Sheets of glass and holes let it straight through. In clear bodies it follows Fresnel and Snell exactly.

#include "engine/raytrace/world.hpp"

namespace septet::raytrace {

struct PathSettings {
  std::uint32_t longest = 8;  ///< Edges of a path, from the eye to a light: 1 sees lights alone, 2 what they light.
  std::uint32_t roulette_from = 4;  ///< From this edge on a path may end early, by how little light it still carries.
};

/// What the eye sees first, for the picture's other layers; what is seen through sheets of glass, not the glass.
struct FirstSeen {
  float distance_m = 0.0f;  ///< 0: the sky.
  glm::vec3 normal{0.0f};   ///< World axes.
  glm::vec3 albedo{0.0f};
  std::uint32_t object = 0;       ///< From 1 (TracedPixel::object); 0: the sky.
  std::uint32_t participant = 0;  ///< Its number; 0: of none.
  bool asks_way = false;          ///< Set before: whether the two places below are wanted.
  glm::vec3 from_m{0.0f},
      to_m{0.0f};  ///< Where the place that is seen is as the shutter opens and closes, times 0 and 1.
};

/// How a path begins, and what comes of it.
struct PathStart {
  Ray ray;
  PathRandom random;
  FirstSeen first;           ///< asks_way is set before.
  glm::vec3 radiance{0.0f};  ///< In the units of engine/instant.
};

/// Eight paths that begin alike, as a pixel's samples do: their first edges and first looks at a light are traced as packets, and all
/// others where World::matt_faces tells it (matt_paths.hpp). `begun`: bits of those that begin; a path may depend on which these are (packet_size), so they are the same
/// whenever it is traced. `wanted`: bits of those of them that are traced to their ends; of the others nothing is told.
void trace_paths(const World& world, const PathSettings& settings, std::uint32_t begun, std::uint32_t wanted,
                 Packet<PathStart>& starts);

}  // namespace septet::raytrace
