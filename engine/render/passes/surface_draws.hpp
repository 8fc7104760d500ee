#pragma once
/// Draws of one view or cascade, ready to record: instanced meshes, then gathered static geometry.

#include <functional>
#include <span>
#include <vector>

#include "engine/render/passes/device_scene.hpp"
#include "engine/render/passes/pass_context.hpp"

namespace septet::render {

struct DynamicSurfaces;

struct SurfaceDraw {
  VkBuffer vertices = VK_NULL_HANDLE, indices = VK_NULL_HANDLE;
  std::uint64_t indices_at = 0, vertices_at = 0;
  std::uint32_t first_index = 0, index_count = 0;
  std::uint32_t first_instance = 0, instance_count = 0;
  std::uint32_t material = 0;
  bool fading = false, still = false;  ///< See Batch.
};

struct SurfaceDraws {
  std::vector<SurfaceDraw> list;  ///< Nearest first; wide ground comes after the objects on it.
  FrameData records;
  std::uint32_t instances = 0;
};

/// Visibility test: true for a mesh to draw, given the centre of its bounding sphere relative to the eye.
using Keep = std::function<bool(const PlacedMesh&, const glm::vec3& centre_m)>;
/// Grouping of materials: index of the material drawn in this one's place, so that both are drawn at once; no_group:
/// not drawn.
using GroupOf = std::function<std::uint32_t(std::uint32_t material)>;

/// Levels of detail of static meshes and of participants.
struct DetailOf {
  Detail still, participants;
};

/// Prepares the draws of a view. `keep` tests whole meshes, `volume` the clumps of static geometry.
SurfaceDraws prepare_draws(PassContext& context, const DeviceScene& scene, std::span<const PlacedMesh> participants,
                           const DynamicSurfaces& dynamic, const Vec3& eye_m, const Keep& keep, const GroupOf& group_of,
                           const DetailOf& detail = {}, const ViewVolume* volume = nullptr);

/// Records one draw and counts it; binds its buffers unless `bound`, the last draw, had the same.
void record_draw(PassContext& context, const SurfaceDraw& draw, SurfaceDraw& bound);

}  // namespace septet::render
