#pragma once
/// Standing parts of a session in the way of lines of sight: road, land, structures, houses, trees.
///
/// Built once for all instants and eyes. Of levels of detail the finest one stands at any distance. Const once made; any
/// number of threads.

#include <cstdint>
#include <memory>
#include <vector>

#include "engine/instant/scene_summary.hpp"
#include "engine/raytrace/world.hpp"
#include "engine/sight/line_of_sight.hpp"

namespace septet::sight {

/// A session's scene, divided. Lamps shine in neither part: nothing is lit here.
struct SceneParts {
  explicit SceneParts(scene::ResolvedScene scene);

  scene::ResolvedScene moving;  ///< Without instances: prototypes of participants.
  scene::ResolvedScene standing;
  instant::SceneSummary summary;  ///< Of the whole scene.
  std::vector<std::uint8_t> cloud_noise;
};

class StandingWorld {
 public:
  /// Error: Embree does not start on this machine. `parts` outlives the world. `origin_m`: near the eyes, whose
  /// distance from it costs digits (a millimetre at 10 km).
  static Expected<std::unique_ptr<const StandingWorld>> create(const SceneParts& parts, const Vec3& origin_m);
  ~StandingWorld();
  StandingWorld(const StandingWorld&) = delete;
  StandingWorld& operator=(const StandingWorld&) = delete;

  /// Share of light that passes along a line for `length_m`; 0: something opaque stands there.
  double transmittance(const Line& line, double length_m) const;

 private:
  struct Parts;
  explicit StandingWorld(std::unique_ptr<Parts> parts);
  std::unique_ptr<Parts> parts_;
};

/// Share of light below which a line counts as blocked.
inline constexpr double opaque_below = 1e-3;

/// Beginning of the way beyond a hit at this distance.
inline float beyond_m(float distance_m) { return distance_m * (1.0f + 2e-6f) + 1e-4f; }

/// Surfaces on one line at most, as many as the ray tracer passes on one edge.
inline constexpr int most_surfaces = 64;

/// A line as a world of the ray tracer takes it.
raytrace::Ray ray_in(const raytrace::World& world, const Line& line);

/// What is left of a share of light behind all surfaces on a ray; 0 where it falls below `opaque_below`.
double left_behind_surfaces(const raytrace::World& world, raytrace::Ray ray, double share);

}  // namespace septet::sight
