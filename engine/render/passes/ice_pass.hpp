#pragma once
/// Ice, after Seipel and Nivfors (2006): three passes into layers, whatever the number of cracks, then the front faces.
///
/// 1. Front faces: normals and depth. 2. Back faces: normals and depth (figure 5 a, b); in quality mode cracks bend the
/// normals. Two more layers, of the front and back faces beyond those back faces, for a body through which other ice is
/// seen. 3. Cracks and air, clipped between the two (figure 5 d). 4. In the view, after the sky: front faces that
/// combine the light through both faces, the inside and the reflection. Surroundings come from cube maps, one from the
/// middle of each group of neighbouring bodies, drawn anew each frame unless Instant::ice_surroundings_kept.
///
/// Deviations: a rectangle a body (ice_tiles.hpp) instead of textures of 512²; world-space normals of the front face,
/// too; all in linear light.

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "engine/render/passes/frame_targets.hpp"
#include "engine/render/passes/ice_tiles.hpp"
#include "engine/render/passes/pass_context.hpp"

namespace septet::render {

/// Images of the layers and the surroundings; created when ice is first seen, the layers beyond when they are first
/// needed.
enum class IceImage : std::uint8_t {
  front,
  back,
  beyond,
  beyond_back,
  inside,
  depth,
  around,
  around_depth,
  cube,  ///< Cube map of the first surroundings; those of the others follow.
};
inline constexpr std::size_t ice_image_count = std::size_t(IceImage::cube) + most_neighbourhoods;
constexpr IceImage cube_of(std::uint32_t around) { return IceImage(std::uint32_t(IceImage::cube) + around); }

struct IceTargets {
  std::array<vulkan::DeviceImage, ice_image_count> images;
  std::array<Access, ice_image_count> accesses{};

  vulkan::DeviceImage& operator[](IceImage which) { return images[std::size_t(which)]; }
  const vulkan::DeviceImage& operator[](IceImage which) const { return images[std::size_t(which)]; }
};

struct IcePass {
  IceTargets targets;
  std::map<std::uint32_t, VkPipeline> fronts, insides;  ///< Indexed by variant.
  std::array<VkPipeline, 6> layers{};                   ///< Indexed by variant.
  VkPipeline cracks = VK_NULL_HANDLE;
  std::array<VkPipeline, 2> glass{};  ///< Pipelines for frost, and for cracks on glass.
};

/// Vertices of a frame's ice on the device.
struct IceUpload {
  struct Vertices {
    FrameData surface, inside;
    std::uint32_t surface_count = 0, inside_count = 0;
    std::uint32_t first_air = 0;  ///< Index of the first of the trailing vertices that are air alone.
    bool mixed = false;           ///< True if there is air before first_air, too.
  };
  std::vector<Vertices> bodies;  ///< One a body.
};

IceUpload upload_ice(PassContext& context, std::span<const ice::IceBody> bodies);

/// Sizes of the layers (even) and of the surroundings, number of surroundings, and presence of the layers beyond.
struct IceTargetSizes {
  std::uint32_t width = 0, height = 0, surroundings_px = 0, surroundings = 1;
  bool beyond = false;
};
/// Creates the images, or recreates them for other sizes. No frame that uses them may be in flight then.
void prepare_ice_targets(IcePass& pass, PassContext& context, const IceTargetSizes& sizes);
/// True if prepare_ice_targets would change nothing.
bool ice_targets_fit(const IcePass& pass, const IceTargetSizes& sizes);
void destroy_ice_pass(IcePass& pass, const vulkan::Device& device, vulkan::MemoryPool& memory);

/// Draws one of the layers, front, back, beyond, beyond_back or inside; `bindings`: those of any view, since light is
/// the same in all.
void draw_ice_layer(IcePass& pass, PassContext& context, IceImage layer, const IceTiles& tiles,
                    std::span<const ice::IceBody> bodies, const IceUpload& upload, const ViewBindings& bindings);
/// Draws ice into the current view; `view`: its index.
void draw_ice(IcePass& pass, PassContext& context, const IceTiles& tiles, std::uint32_t view,
              std::span<const ice::IceBody> bodies, const IceUpload& upload);

/// Draws frost and cracks on panes over the current view (ice_glass.cpp). `near`: panes within arm's reach of the eye,
/// which are drawn last; else the others.
void draw_glass(IcePass& pass, PassContext& context, std::span<const ice::IceBody> bodies,
                std::span<const FrameData> vertices, const Vec3& eye_m, bool near);
/// Uploads the vertices of each body, for this frame.
std::vector<FrameData> upload_glass(PassContext& context, std::span<const ice::IceBody> bodies);

/// Copies the six pictures side by side into one of the cube maps.
void copy_surroundings(const IcePass& pass, PassContext& context, IceImage cube);

}  // namespace septet::render
