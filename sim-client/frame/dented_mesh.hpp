#pragma once
/// A vehicle's mesh with its dents: triangles where they reach are divided until they can bend with the sheet metal, then every corner
/// and its normal go where the dents put them (engine/effects/debris/dent.hpp).

#include <optional>
#include <span>

#include "engine/effects/debris/dent.hpp"
#include "engine/math/rigid_transform.hpp"
#include "engine/scene/resolved_scene.hpp"

namespace septet::frame {

/// No edge that a dent bends is left longer, m: a skin and its lining, two centimetres behind it, bend alike then.
inline constexpr double longest_bent_edge_m = 0.06;

/// Nothing where no dent reaches the mesh. Two triangles that share an edge share what it is divided into, whatever mesh they are of.
std::optional<scene::SurfaceMesh> dented_mesh(const scene::SurfaceMesh& mesh, const RigidTransform& vehicle_from_object,
                                              const glm::vec3& scale, std::span<const debris::Dent> dents);

}  // namespace septet::frame
