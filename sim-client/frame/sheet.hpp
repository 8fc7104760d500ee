#pragma once
/// Sheet metal of a vehicle, triangle by triangle: what a mesh loses where a part was torn off, and its back. Vehicle
/// frame, metres.

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "engine/scene/resolved_scene.hpp"
#include "engine/scenery/vehicles/mount_region.hpp"

namespace septet::frame {

struct SheetTriangle {
  std::array<scene::SurfaceVertex, 3> corners;  ///< Counter-clockwise seen from the front.
  std::uint32_t material = 0;                   ///< Indexes ResolvedScene::materials.
  bool is_skin = true;                          ///< False: of what the skin carries, or faces inwards.
};
using Sheet = std::vector<SheetTriangle>;

/// A mesh in which a region has been cut, and what it has lost.
struct CutMesh {
  scene::SurfaceMesh left;
  Sheet taken;  ///< Without panes.
};

/// Cuts triangles along the region's boxes; panes and number plates go, or stay, as a whole. Empty for a mesh that has
/// nothing there, or makes no sense.
std::optional<CutMesh> cut_mesh(const scene::SurfaceMesh& mesh, const RigidTransform& vehicle_from_object,
                                const glm::vec3& scale, std::span<const scene::SurfaceMaterial> materials,
                                const scenery::MountRegion& region);

/// The skin `depth_m` behind its front, and walls from its open edges to there, of one material: a recess, seen from
/// outside.
Sheet recess_behind(const Sheet& sheet, float depth_m, std::uint32_t material);

/// The same seen from the other side.
void turn_over(Sheet& sheet);

/// Appends triangles to a mesh, in its frame.
void append(const Sheet& sheet, const RigidTransform& vehicle_from_object, const glm::vec3& scale,
            scene::SurfaceMesh& mesh);

/// A number of a place to the half millimetre: equal for corners that lie together.
std::uint64_t place_key(const glm::vec3& place_m);

}  // namespace septet::frame
