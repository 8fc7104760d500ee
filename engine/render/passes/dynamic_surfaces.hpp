#pragma once
/// Meshes that are new in every frame: their vertices go through the frame's arena, once for all views and cascades.

#include <span>
#include <vector>

#include "engine/instant/instant.hpp"
#include "engine/render/passes/surface_draws.hpp"

namespace septet::render {

struct DynamicSurface {
  PlacedMesh placed;  ///< For culling; its mesh index means nothing.
  std::uint64_t vertices_at = 0;
  VkBuffer vertices = VK_NULL_HANDLE;
  std::uint32_t vertex_count = 0;
  std::uint32_t material = 0;
};

struct DynamicSurfaces {
  std::vector<DynamicSurface> surfaces;
  FrameData indices;  ///< 0, 1, 2, … as far as the longest surface reaches.
};

DynamicSurfaces upload_dynamic(PassContext& context, const DeviceScene& scene, std::span<const LooseMesh> meshes);

/// Adds what is wanted to a view's or cascade's draws, and its records to theirs.
void append_dynamic(const DynamicSurfaces& dynamic, const Vec3& eye_m, const Keep& keep, const GroupOf& group_of,
                    std::vector<SurfaceDraw>& list, std::vector<InstanceRecord>& records);

}  // namespace septet::render
