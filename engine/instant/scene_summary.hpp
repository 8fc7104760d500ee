#pragma once
/// Summary of a scene for the description of instants, computed once a revision: the prototypes of participants, a few
/// figures of each mesh, and the roofs that hide the sky.

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "engine/instant/placed_mesh.hpp"
#include "engine/instant/standing_lamps.hpp"

namespace septet::instant {

inline constexpr std::uint32_t no_material = std::numeric_limits<std::uint32_t>::max();

struct MeshSummary {
  MeshBounds bounds;
  glm::vec3 emission{0.0f};                    ///< Emission of its brightest material.
  std::uint32_t first_material = no_material;  ///< Material of its first part with triangles.
  bool has_light = false;  ///< True if it may be a lamp, a roof or a roofed wall: lights depend on it.
};

/// Body of a prototype that hides the sky from the ground: the bounds of its fixed parts, in the vehicle's frame.
/// Empty: min_m.x > max_m.x.
using BodyBounds = MeshBounds;

/// Box in which the sky is hidden, such as a stretch of tunnel: the bounds of an instance with such a material.
struct Roof {
  RigidTransform object_from_world;
  glm::vec3 min_m{0.0f}, max_m{0.0f};
  float share_of_sky = 0.0f;
};

struct SceneSummary {
  std::vector<scene::Prototype> prototypes;
  std::vector<MeshSummary> meshes;  ///< One a mesh.
  std::vector<BodyBounds> bodies;   ///< One a prototype.
  std::vector<Roof> roofs;
  std::vector<StandingLamp> lamps;
};

/// Summarises a scene. Instances and materials that point outside the scene are left out.
SceneSummary summarise(const scene::ResolvedScene& scene);

/// Brings a summary up to these changes of its scene; returns true if its lamps and roofs are new. They are found anew
/// where something that shines or roofs changed, at the cost of the whole scene; all else costs what changed.
bool renew(SceneSummary& summary, const scene::ResolvedScene& scene,
           std::span<const scene::ChangeList<scene::SceneChange>::Change> changes);

/// Share of the sky at a place of the world: less than 1 under a roof.
float share_of_sky(const SceneSummary& scene, const Vec3& position_m);
/// Mean share of the sky along a way: a vehicle that drives under a roof darkens gradually.
float share_of_sky(const SceneSummary& scene, const Vec3& from_m, const Vec3& to_m);
/// Share of the sky of a vehicle, over its length and the depth to which daylight reaches into a tunnel's mouth.
float share_of_sky(const SceneSummary& scene, const RigidTransform& world_from_vehicle);

}  // namespace septet::instant
