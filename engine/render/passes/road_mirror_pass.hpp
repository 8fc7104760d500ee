#pragma once
/// Mirror image in a wet road: vehicles and objects beside the road, drawn upside down below it into a picture of half
/// the size, and the rings of rain on its water.
///
/// Each vehicle is mirrored in the road that it stands on, static objects in the plane of the road near the eye
/// (Instant::road), only as far as the road is about flat. The road's shader reads the picture at its own pixels,
/// shifted by the tilt of its water (shaders/wet_road.glsl): sharp in puddles, and on the film between them spread
/// upwards and downwards by the roughness of the stones below it. Only a frame's first view has a mirror image: mirrors
/// over it are small. Screens of a rig draw the same geometry, so that it meets at their edges.

#include "engine/instant/instant.hpp"
#include "engine/render/passes/lamp_field.hpp"
#include "engine/render/passes/smoke_shade.hpp"
#include "engine/render/passes/surface_pass.hpp"
#include "engine/render/passes/view_uniforms.hpp"

namespace septet::render {

struct RoadMirrorPass {
  SurfacePass surfaces;                   ///< Pipelines for one sample a pixel.
  VkPipeline spreading = VK_NULL_HANDLE;  ///< Created at first use.
  vulkan::DeviceImage image, depth, spread, ripples;
  Access image_access = Access::none, depth_access = Access::none, spread_access = Access::none,
         ripples_access = Access::none;
};

/// Draws and uniforms of a frame's mirror image.
struct PreparedRoadMirror {
  SurfaceDraws draws;
  FrameData uniforms, light_clusters, smoke_shade;
  bool lit_by_headlights = false, lit_by_lamps = false;
};

/// True if a frame has a mirror image in the road.
bool road_mirrors(const Instant& instant);
/// True if the images exist for a target of this size.
bool road_mirror_fits(const RoadMirrorPass& pass, std::uint32_t width, std::uint32_t height);
/// Creates the images anew. No frame that uses them may be in flight.
void prepare_road_mirror_targets(RoadMirrorPass& pass, vulkan::MemoryPool& memory, const TargetFormats& formats,
                                 std::uint32_t width, std::uint32_t height);
void destroy_road_mirror(RoadMirrorPass& pass, const vulkan::Device& device, vulkan::MemoryPool& memory);

/// Prepares the mirror image of the first view.
PreparedRoadMirror prepare_road_mirror(PassContext& context, const DeviceScene& scene, const Instant& instant,
                                       const ShadowCascades& shadows, const PreparedSmokeShade& shade,
                                       const DynamicSurfaces& dynamic, const LampField& lamps, std::uint32_t width,
                                       std::uint32_t height);
void draw_road_mirror(RoadMirrorPass& pass, PassContext& context, const DeviceScene& scene,
                      const PreparedRoadMirror& prepared, const FrameView& view, const ViewBindings& bindings,
                      const FrameData& soot, const SurfaceLight& light);
/// Spreads the finished mirror image as the film of water shows it.
void spread_road_mirror(RoadMirrorPass& pass, PassContext& context, const FrameView& view);
void upload_ripples(const RoadMirrorPass& pass, PassContext& context, const Instant& instant);

}  // namespace septet::render
