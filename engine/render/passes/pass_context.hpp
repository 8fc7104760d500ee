#pragma once
/// What every pass needs to record itself, and the few calls that they share.

#include <cstdint>
#include <span>
#include <string_view>

#include "engine/instant/frame_input.hpp"
#include "engine/render/passes/draw_list.hpp"
#include "engine/render/renderer.hpp"
#include "engine/render/vulkan/commands.hpp"
#include "engine/render/vulkan/memory.hpp"
#include "engine/render/vulkan/pipeline.hpp"

namespace septet::render {

struct Samplers {
  VkSampler surface = VK_NULL_HANDLE;  ///< Repeats; trilinear, bilinear in the nearest level on a software device.
  VkSampler road = VK_NULL_HANDLE;     ///< Repeats, trilinear and anisotropic: markings stay sharp at grazing angles.
  bool anisotropic = false;            ///< False on a software device, where shaders do it at a tenth of the cost.
  VkSampler table = VK_NULL_HANDLE;    ///< Clamps, bilinear.
  VkSampler shadow = VK_NULL_HANDLE;   ///< Compares: 1 where nothing is nearer to the light.
  VkSampler texel = VK_NULL_HANDLE;    ///< Clamps, one texel: of depths no device has to blend.
};

void create_samplers(Samplers& samplers, const vulkan::Device& device);
void destroy_samplers(Samplers& samplers, const vulkan::Device& device);

struct TargetFormats {
  /// Linear radiance in the units of instant/atmosphere.hpp, before exposure. Half floats reach from starlight to the sun's disc.
  VkFormat radiance = VK_FORMAT_R16G16B16A16_SFLOAT;
  VkFormat picture =
      VK_FORMAT_R8G8B8A8_UNORM;  ///< Holds sRGB codes: the tone curve encodes, at no cost (engine/light/tone_curve.hpp).
  VkFormat depth = VK_FORMAT_D32_SFLOAT;
  VkSampleCountFlagBits samples = VK_SAMPLE_COUNT_4_BIT;
  bool marks =
      false;  ///< The radiance's alpha tells what its pixel has of what does not stand still (passes/temporal_pass.hpp).
};

/// What a graphics card draws beyond the software device, and that one where it is asked to; nothing of it differs in what a driver acts on.
struct Refinements {
  bool soft_shadows = false;
  bool clustered_headlights = false;
};

struct PassContext {
  const vulkan::Device& device;
  vulkan::MemoryPool& memory;
  const vulkan::PipelineLayout& layout;
  const Samplers& samplers;
  const TargetFormats& formats;
  vulkan::FrameSlot& slot;
  RenderStatistics& statistics;
  Refinements refinements;
};

/// What was recorded since the last mark was this pass (a literal): its time is told where frames are timed.
void mark_pass(PassContext& context, std::string_view name);

/// Bytes that were copied into the frame's arena.
struct FrameData {
  VkBuffer buffer = VK_NULL_HANDLE;
  std::uint64_t offset = 0, size = 0;
};

/// Copies into the arena; an empty span still gets a place, so that it can be bound.
FrameData store(PassContext& context, std::span<const std::byte> bytes);
template <class T>
FrameData store(PassContext& context, std::span<const T> values) {
  return store(context, std::as_bytes(values));
}

/// What is bound for a whole view.
struct ViewBindings {
  FrameData uniforms;
  VkImageView sky_table = VK_NULL_HANDLE, shadow_map = VK_NULL_HANDLE, noise = VK_NULL_HANDLE,
              lamp_field = VK_NULL_HANDLE;
  FrameData light_clusters;  ///< None: the uniforms take their place, unread.
  /// None: the noise takes their place, unread.
  VkImageView road_mirror = VK_NULL_HANDLE, road_mirror_spread = VK_NULL_HANDLE, road_mirror_depth = VK_NULL_HANDLE,
              ripples = VK_NULL_HANDLE;
};

void push_view(PassContext& context, const ViewBindings& bindings);
/// What the shaders that follow read as binding_records.
void push_records(PassContext& context, const FrameData& records);
/// What is drawn many times: InstanceRecords for the pipelines that take them.
void bind_instances(PassContext& context, const FrameData& records);
void push_image(PassContext& context, VkImageView view, VkSampler sampler,
                std::uint32_t binding = vulkan::binding_image);
void push_constants(PassContext& context, std::span<const std::byte> bytes);
void set_viewport(PassContext& context, const PixelRectangle& rectangle);

}  // namespace septet::render
