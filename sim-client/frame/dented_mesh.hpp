#pragma once
/// A vehicle's mesh with its dents: triangles in their reach are divided until they can bend with the sheet metal, then
/// every corner and normal is displaced by the dents (engine/effects/debris/dent.hpp).

#include <optional>
#include <span>

#include "engine/effects/debris/dent.hpp"
#include "engine/math/rigid_transform.hpp"
#include "engine/scene/resolved_scene.hpp"

namespace septet::frame {

/// Longest edge that a dent may bend, m: a skin and its lining, two centimetres behind it, then bend alike.
inline constexpr double longest_bent_edge_m = 0.06;

/// Empty if no dent reaches the mesh. Two triangles that share an edge share its subdivision, across meshes too.
std::optional<scene::SurfaceMesh> dented_mesh(const scene::SurfaceMesh& mesh, const RigidTransform& vehicle_from_object,
                                              const glm::vec3& scale, std::span<const debris::Dent> dents);

}  // namespace septet::frame
