#pragma once
/// Ice, after Seipel and Nivfors (2006): three passes into layers, whatever the number of cracks, then the front faces.
///
/// 1. Front faces: normals and depth. 2. Back faces: normals and depth (figure 5 a, b); in quality mode cracks bend the normals.
/// 3. Cracks and air, clipped between the two (figure 5 d). 4. In the view, after the sky: front faces that put together what
/// is seen through both faces, what is inside and what is mirrored. What lies around comes from a cube map that is drawn
/// anew each frame from the ice's middle. Deviations: a rectangle a body (ice_tiles.hpp) instead of textures of 512²;
/// world-space normals of the front face, too; all in linear light.

#include <map>

#include "engine/render/passes/frame_targets.hpp"
#include "engine/render/passes/ice_tiles.hpp"
#include "engine/render/passes/pass_context.hpp"

namespace septet::render {

/// Images of the layers and the surroundings; made when ice is first seen.
struct IceTargets {
  vulkan::DeviceImage front, back, depth, inside;
  vulkan::DeviceImage around, around_depth, cube;
  Access front_access = Access::none, back_access = Access::none, depth_access = Access::none,
         inside_access = Access::none, around_access = Access::none, around_depth_access = Access::none,
         cube_access = Access::none;
};

struct IcePass {
  IceTargets targets;
  std::map<std::uint32_t, VkPipeline> fronts, insides;  ///< By variant.
  VkPipeline layer = VK_NULL_HANDLE, cracks = VK_NULL_HANDLE;
};

/// What of a frame's ice is on the device.
struct IceUpload {
  struct Vertices {
    FrameData surface, inside;
    std::uint32_t surface_count = 0, inside_count = 0;
    std::uint32_t first_air = 0;  ///< From where on there is nothing but air.
    bool mixed = false;           ///< Air before that, too.
  };
  std::vector<Vertices> bodies;  ///< One a body.
};

IceUpload upload_ice(PassContext& context, std::span<const ice::IceBody> bodies);

/// Makes the images, or makes them anew, for a target and surroundings of these sizes. No frame that uses them is in flight
/// where they change.
void prepare_ice_targets(IcePass& pass, PassContext& context, std::uint32_t width, std::uint32_t height,
                         std::uint32_t surroundings_px);
/// Whether that would change anything.
bool ice_targets_fit(const IcePass& pass, std::uint32_t width, std::uint32_t height, std::uint32_t surroundings_px);
void destroy_ice_pass(IcePass& pass, const vulkan::Device& device, vulkan::MemoryPool& memory);

enum class IceLayer : std::uint8_t { front, back, inside };
/// One of the three passes; `bindings` are those of any view: light is the same in all.
void draw_ice_layer(IcePass& pass, PassContext& context, IceLayer layer, const IceTiles& tiles,
                    std::span<const ice::IceBody> bodies, const IceUpload& upload, const ViewBindings& bindings);
/// Into the view that is being drawn, which has this index.
void draw_ice(IcePass& pass, PassContext& context, const IceTiles& tiles, std::uint32_t view,
              std::span<const ice::IceBody> bodies, const IceUpload& upload);

/// From the six pictures side by side to the cube map.
void copy_surroundings(const IcePass& pass, PassContext& context);

}  // namespace septet::render
