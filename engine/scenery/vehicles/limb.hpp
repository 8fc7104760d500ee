#pragma once
/// Round bars and blobs between points, and boxes: people, motorcycles, pipes, lorries.

#include "engine/geometry/mesh_builder.hpp"
#include "engine/scenery/vehicles/finish.hpp"

namespace septet::scenery {

/// Adds a bar with tapering, rounded ends from a (radius ra) to b (radius rb), with the builder's material.
void add_limb(geometry::MeshBuilder& builder, const glm::vec3& a, const glm::vec3& b, float ra, float rb,
              std::uint32_t sides);

/// Adds an ellipsoid; `splits` as for geometry::icosphere.
void add_blob(geometry::MeshBuilder& builder, const glm::vec3& centre, const glm::vec3& radii, std::uint32_t splits);

/// An arc about y; angles from straight ahead upwards.
struct Arc {
  float radius_m, tube_m, from_rad, to_rad;
};
/// Adds bars along an arc around a wheel's hub.
void add_mudguard(geometry::MeshBuilder& builder, const glm::vec3& hub, const Arc& arc, std::uint32_t sides);

/// Adds a box of one finish (geometry::box).
void add_box(geometry::MeshBuilder& builder, Finish finish, const glm::vec3& low, const glm::vec3& high,
             float bevel_m = 0.0f);

}  // namespace septet::scenery
