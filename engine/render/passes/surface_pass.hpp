#pragma once
/// Draws meshes with their materials: opaque ones, ones with holes, and ones to see through.

#include <map>

#include "engine/render/passes/device_scene.hpp"
#include "engine/render/passes/pass_context.hpp"

namespace septet::render {

enum class SurfaceKind : std::uint8_t { opaque, cut, blended };

struct SurfacePass {
  std::map<std::uint32_t, VkPipeline> pipelines;  ///< By variant; made when first drawn.
};

void destroy_surface_pass(SurfacePass& pass, const vulkan::Device& device);

/// Draws the parts of one kind, in the list's order (blended: in reverse, so farthest first). `wet`: wettable materials
/// mirror.
void draw_surfaces(SurfacePass& pass, PassContext& context, const DeviceScene& scene, const DrawList& list,
                   SurfaceKind kind, bool wet);

}  // namespace septet::render
