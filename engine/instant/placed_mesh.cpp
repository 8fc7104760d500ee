#include "engine/instant/placed_mesh.hpp"

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

namespace septet::instant {

PlacedMesh place(std::uint32_t mesh, const MeshBounds& bounds, const RigidTransform& world_from_object,
                 const glm::vec3& scale) {
  PlacedMesh placed;
  placed.mesh = mesh;
  placed.origin_m = world_from_object.position_m;
  const glm::mat3 rotation(glm::mat3_cast(world_from_object.orientation));
  placed.world_from_object = glm::mat3(rotation[0] * scale.x, rotation[1] * scale.y, rotation[2] * scale.z);
  const glm::vec3 middle = 0.5f * (bounds.min_m + bounds.max_m), half = 0.5f * (bounds.max_m - bounds.min_m);
  placed.centre_m = placed.world_from_object * middle;
  placed.radius_m = glm::length(half * scale);
  return placed;
}

PlacedMesh place(const scene::Instance& instance, const MeshBounds& bounds, const RigidTransform& world_from_object,
                 const glm::vec3& stretch) {
  PlacedMesh placed = place(instance.mesh, bounds, world_from_object, instance.scale * stretch);
  placed.visible_from_m = instance.visible_from_m;
  placed.visible_to_m = instance.visible_to_m;
  placed.casts_shadow = instance.casts_shadow;
  return placed;
}

}  // namespace septet::instant
