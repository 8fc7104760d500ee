#pragma once
/// Mesh at its place: index, pose, paint, and visibility.

#include <cstdint>

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "engine/math/rigid_transform.hpp"
#include "engine/scene/resolved_scene.hpp"

namespace septet::instant {

/// Placement: a vertex stands in the world at origin_m + world_from_object · position_m.
struct PlacedMesh {
  std::uint32_t mesh = 0;             ///< Indexes ResolvedScene::meshes.
  Vec3 origin_m{0.0};                 ///< World.
  glm::mat3 world_from_object{1.0f};  ///< Rotation and scale.
  glm::vec3 centre_m{0.0f};           ///< Centre of the bounding sphere, from the origin along the world's axes.
  float radius_m = 0.0f;
  float visible_from_m = 0.0f,
        visible_to_m = 1e9f;  ///< Drawn while the eye's distance from the origin is in [from, to); see level_fade.hpp.
  bool casts_shadow = true;
  bool seen = true;            ///< False: casts a shadow only.
  glm::vec4 tint{1.0f};        ///< Paint, for materials that take it; w: lit share of the materials' emission.
  float share_of_sky = 1.0f;   ///< Share of the sky that reaches it; times that of its materials.
  bool snowed_on = true;       ///< True if snow lies on its upward faces; transparent ones stay free.
  bool lights_around = false;  ///< True for a beacon's lens: it is shown dimmed, the light that it casts is not.
  /// Height of the origin over the road that its vehicle stands on, whose water mirrors it; unknown for static meshes.
  float over_road_m = unknown_road;
  static constexpr float unknown_road = -1e4f;
  std::uint32_t number = 0;  ///< Number of its participant: selects the picture of a material of several.
  /// Mesh drawn instead; the instant keeps it (Instant::reshaped). Null: the mesh itself.
  const scene::SurfaceMesh* reshaped = nullptr;
};

/// Bounds of a mesh in its object's frame.
struct MeshBounds {
  glm::vec3 min_m{0.0f}, max_m{0.0f};
};

/// Placement of the mesh; `scale` stretches it along the object's axes.
PlacedMesh place(std::uint32_t mesh, const MeshBounds& bounds, const RigidTransform& world_from_object,
                 const glm::vec3& scale);

/// Placement likewise, with the instance's scale (times `stretch`), visibility and shadow.
PlacedMesh place(const scene::Instance& instance, const MeshBounds& bounds, const RigidTransform& world_from_object,
                 const glm::vec3& stretch = glm::vec3(1.0f));

}  // namespace septet::instant
