#pragma once
/// The draws of one view or cascade, ready to record: instanced meshes, then gathered static geometry.

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
  bool fading = false, still = false;  ///< As of Batch.
};

struct SurfaceDraws {
  std::vector<SurfaceDraw> list;  ///< Nearest first; wide ground comes after what stands on it.
  FrameData records;
  std::uint32_t instances = 0;
};

/// Which meshes are wanted, by where their bounding sphere's middle lies from the eye.
using Keep = std::function<bool(const PlacedMesh&, const glm::vec3& centre_m)>;
/// Which material stands for this one, so that both may be drawn at once; no_group: it is not drawn.
using GroupOf = std::function<std::uint32_t(std::uint32_t material)>;

/// Of what stands still and of participants.
struct DetailOf {
  Detail still, participants;
};

/// `keep` tells what may be seen as a whole, `volume` what of wide things.
SurfaceDraws prepare_draws(PassContext& context, const DeviceScene& scene, std::span<const PlacedMesh> participants,
                           const DynamicSurfaces& dynamic, const Vec3& eye_m, const Keep& keep, const GroupOf& group_of,
                           const DetailOf& detail = {}, const ViewVolume* volume = nullptr);

/// Records one draw and counts it; binds its buffers unless `bound`, the last draw's, were the same.
void record_draw(PassContext& context, const SurfaceDraw& draw, SurfaceDraw& bound);

}  // namespace septet::render
