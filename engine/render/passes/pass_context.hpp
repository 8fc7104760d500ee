#pragma once
/// Context that every pass needs to record itself, and the few calls that passes share.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "engine/instant/frame_input.hpp"
#include "engine/render/passes/draw_list.hpp"
#include "engine/render/renderer.hpp"
#include "engine/render/vulkan/commands.hpp"
#include "engine/render/vulkan/memory.hpp"
#include "engine/render/vulkan/pipeline.hpp"
#include "engine/scene/image_sampling.hpp"

namespace septet::render {

struct Samplers {
  VkSampler surface = VK_NULL_HANDLE;  ///< Repeats; trilinear, bilinear in the nearest level on a software device.
  std::array<VkSampler, 8> images{};   ///< The same for each way to read an image; the first is `surface`.
  /// Repeats; trilinear and anisotropic on a graphics card: markings stay sharp at grazing angles.
  VkSampler road = VK_NULL_HANDLE;
  bool anisotropic = false;           ///< False on a software device, where shaders do it at a tenth of the cost.
  VkSampler table = VK_NULL_HANDLE;   ///< Clamps, bilinear.
  VkSampler shadow = VK_NULL_HANDLE;  ///< Compares: 1 where nothing is nearer to the light.
  VkSampler texel = VK_NULL_HANDLE;   ///< Clamps, nearest texel: for depths, which a device need not filter.

  VkSampler of(const scene::ImageSampling& sampling) const {
    return images[std::size_t{sampling.clamps_u} + 2 * std::size_t{sampling.clamps_v} +
                  4 * std::size_t{sampling.sharp}];
  }
};

void create_samplers(Samplers& samplers, const vulkan::Device& device);
void destroy_samplers(Samplers& samplers, const vulkan::Device& device);

struct TargetFormats {
  /// Linear radiance in the units of instant/atmosphere.hpp, before exposure. Half floats reach from starlight to the
  /// sun's disc.
  VkFormat radiance = VK_FORMAT_R16G16B16A16_SFLOAT;
  /// sRGB codes: the tone curve encodes, at no cost (engine/light/tone_curve.hpp).
  VkFormat picture = VK_FORMAT_R8G8B8A8_UNORM;
  VkFormat depth = VK_FORMAT_D32_SFLOAT;
  VkSampleCountFlagBits samples = VK_SAMPLE_COUNT_4_BIT;
  /// True if the radiance's alpha marks moving surfaces (passes/temporal_pass.hpp).
  bool marks = false;
};

/// Effects for graphics cards, which a software device draws only on request; nothing that a driver acts on depends on
/// them.
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

/// Attributes the commands recorded since the last mark to this pass (a literal), for the statistics of timed frames.
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

/// Resources bound for a whole view.
struct ViewBindings {
  FrameData uniforms;
  VkImageView sky_table = VK_NULL_HANDLE, shadow_map = VK_NULL_HANDLE, noise = VK_NULL_HANDLE,
              lamp_field = VK_NULL_HANDLE;
  FrameData light_clusters, smoke_shade;  ///< Empty: the uniforms are bound in their place, unread.
  /// Null: the noise is bound in their place, unread.
  VkImageView road_mirror = VK_NULL_HANDLE, road_mirror_spread = VK_NULL_HANDLE, road_mirror_depth = VK_NULL_HANDLE,
              ripples = VK_NULL_HANDLE;
};

void push_view(PassContext& context, const ViewBindings& bindings);
/// Binds the records that the following shaders read as binding_records.
void push_records(PassContext& context, const FrameData& records);
/// Binds the InstanceRecords for the pipelines that take them.
void bind_instances(PassContext& context, const FrameData& records);
void push_image(PassContext& context, VkImageView view, VkSampler sampler,
                std::uint32_t binding = vulkan::binding_image);
void push_constants(PassContext& context, std::span<const std::byte> bytes);
void set_viewport(PassContext& context, const PixelRectangle& rectangle);

}  // namespace septet::render
