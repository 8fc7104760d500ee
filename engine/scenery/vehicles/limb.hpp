#pragma once
/// Round bars and blobs between points: people, motorcycles, pipes.

#include "engine/geometry/mesh_builder.hpp"

namespace septet::scenery {

/// A bar with tapering, rounded ends from a (radius ra) to b (radius rb), with the builder's
/// material.
void add_limb(geometry::MeshBuilder& builder, const glm::vec3& a, const glm::vec3& b, float ra, float rb,
              std::uint32_t sides);

/// An ellipsoid; `splits` as for geometry::icosphere.
void add_blob(geometry::MeshBuilder& builder, const glm::vec3& centre, const glm::vec3& radii, std::uint32_t splits);

}  // namespace septet::scenery
