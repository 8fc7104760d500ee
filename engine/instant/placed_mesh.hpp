#pragma once
/// A mesh in its place: which one, where, in what paint, and who sees it.

#include <cstdint>

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "engine/math/rigid_transform.hpp"
#include "engine/scene/resolved_scene.hpp"

namespace septet::instant {

/// A vertex stands in the world at origin_m + world_from_object · position_m.
struct PlacedMesh {
  std::uint32_t mesh = 0;             ///< Indexes ResolvedScene::meshes.
  Vec3 origin_m{0.0};                 ///< World.
  glm::mat3 world_from_object{1.0f};  ///< Rotation and scale.
  glm::vec3 centre_m{0.0f};           ///< Of the bounding sphere, from the origin along the world's axes.
  float radius_m = 0.0f;
  float visible_from_m = 0.0f,
        visible_to_m = 1e9f;  ///< Seen while the eye's distance from the origin is in [from, to); see level_fade.hpp.
  bool casts_shadow = true;
  bool seen = true;            ///< False: casts a shadow only.
  glm::vec4 tint{1.0f};        ///< Paint, for materials that take it; w: how much of the materials' emission shines.
  float share_of_sky = 1.0f;   ///< That reaches it; times that of its materials.
  bool snowed_on = true;       ///< Snow lies on what looks up, but not on what one sees through.
  bool lights_around = false;  ///< A beacon's lens: it is shown dimmed, what it lights is not.
  /// Height of the origin over the road that its vehicle stands on, whose water mirrors it; of what stands still that is not known.
  float over_road_m = unknown_road;
  static constexpr float unknown_road = -1e4f;
  std::uint32_t number = 0;  ///< Of its participant: which picture a material of several shows.
  /// What is drawn in the mesh's stead; the instant keeps it (Instant::reshaped). Null: the mesh.
  const scene::SurfaceMesh* reshaped = nullptr;
};

/// Bounds of a mesh in its object's frame.
struct MeshBounds {
  glm::vec3 min_m{0.0f}, max_m{0.0f};
};

/// The mesh in its place; `scale` stretches it along the object's axes.
PlacedMesh place(std::uint32_t mesh, const MeshBounds& bounds, const RigidTransform& world_from_object,
                 const glm::vec3& scale);

/// The same with the instance's scale, and seen and throwing shadows as the instance says.
PlacedMesh place(const scene::Instance& instance, const MeshBounds& bounds, const RigidTransform& world_from_object);

}  // namespace septet::instant
