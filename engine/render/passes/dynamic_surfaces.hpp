#pragma once
/// Meshes that are new in every frame: their vertices go through the frame's arena, once for all views and cascades.

#include <cstdint>
#include <map>
#include <vector>

#include "engine/instant/instant.hpp"
#include "engine/render/passes/surface_draws.hpp"

namespace septet::render {

struct DynamicSurface {
  PlacedMesh placed;  ///< Placement for culling; its mesh index has no meaning.
  std::uint64_t vertices_at = 0;
  VkBuffer vertices = VK_NULL_HANDLE;
  std::uint32_t vertex_count = 0;
  std::uint32_t material = 0;
};

/// Mesh that stands in for a part's mesh (PlacedMesh::reshaped).
struct ReshapedSurface {
  FrameData vertices, indices;
  std::vector<scene::MeshPart> parts;
};

struct DynamicSurfaces {
  std::vector<DynamicSurface> surfaces;
  FrameData indices;  ///< 0, 1, 2, … as far as the longest surface reaches.
  std::map<const scene::SurfaceMesh*, ReshapedSurface> reshaped;
};

/// Uploads the instant's loose meshes, and those that stand in for its participants' parts.
DynamicSurfaces upload_dynamic(PassContext& context, const DeviceScene& scene, const Instant& instant);

/// Adds the surfaces that `keep` accepts to a view's or cascade's draws, and their records to `records`.
void append_dynamic(const DynamicSurfaces& dynamic, const Vec3& eye_m, const Keep& keep, const GroupOf& group_of,
                    std::vector<SurfaceDraw>& list, std::vector<InstanceRecord>& records);

}  // namespace septet::render
