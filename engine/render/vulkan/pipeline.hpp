#pragma once
/// Graphics pipelines: one layout for all of them, dynamic rendering, and what differs as plain data.

#include <array>
#include <cstdint>
#include <span>

#include "engine/render/vulkan/device.hpp"

namespace septet::render::vulkan {

/// Bindings of the one descriptor set, pushed while recording.
enum Binding : std::uint32_t {
  binding_view = 0,     ///< Uniforms of the view.
  binding_records = 1,  ///< Storage: soot for surfaces, then puffs of smoke, then lamps that glow.
  binding_sky = 2,
  binding_shadow = 3,
  binding_noise = 4,
  binding_image = 5,  ///< The material's image, or the overlay's.
  binding_ice_front =
      6,                 ///< Ice (passes/ice_pass.hpp): normals and depth of its nearest front faces, of the back faces
  binding_ice_back = 7,  ///< behind them, what is inside it,
  binding_ice_inside = 8,
  binding_surroundings = 9,         ///< and the cube map of what lies around it.
  binding_ice_beyond = 10,          ///< Of the nearest front faces behind those back faces, and of the back faces
  binding_ice_beyond_back = 11,     ///< behind these.
  binding_lamps = 12,               ///< What standing lamps throw (passes/lamp_field.hpp).
  binding_road_mirror = 13,         ///< What a wet road mirrors (passes/road_mirror_pass.hpp),
  binding_ripples = 14,             ///< and the slopes of the water on it.
  binding_shadow_depths = 15,       ///< The shadow map, not compared.
  binding_light_clusters = 16,      ///< Storage: which headlights light where (passes/light_clusters.hpp).
  binding_history = 17,             ///< The picture before (passes/temporal_pass.hpp),
  binding_depth = 18,               ///< and this one's depth.
  binding_road_mirror_spread = 19,  ///< What a wet road mirrors, spread by its roughness, and its depth.
  binding_road_mirror_depth = 20,
  binding_count = 21,
};

inline constexpr std::uint32_t push_constant_bytes = 128;

struct PipelineLayout {
  VkDescriptorSetLayout set = VK_NULL_HANDLE;
  VkPipelineLayout layout = VK_NULL_HANDLE;
};

void create_pipeline_layout(PipelineLayout& layout, const Device& device);
void destroy_pipeline_layout(PipelineLayout& layout, const Device& device);

/// `data`: no blending, and alpha is stored like the other three. `layer`: as `over`, onto a picture with an alpha of its own.
enum class Blend : std::uint8_t { none, over, add, data, layer };
/// What the vertex shader takes. Buffer 0, scene::SurfaceVertex: position, texture coordinates and normal at locations 0, 1,
/// 2. Buffer 1, once an instance: light::InstanceRecord, at the locations that it says. `shadow` goes without the normal and the
/// last two vectors. `ice`: one buffer of ice::IceVertex, position, normal and place at rest at locations 0, 1, 2.
enum class VertexInput : std::uint8_t { none, shadow, surface, ice };

struct PipelineDescription {
  std::span<const std::uint32_t> vertex_code, fragment_code;  ///< SPIR-V; no fragment code: depth only.
  VertexInput vertex_input = VertexInput::surface;
  VkFormat color_format = VK_FORMAT_UNDEFINED, depth_format = VK_FORMAT_UNDEFINED;
  VkSampleCountFlagBits samples = VK_SAMPLE_COUNT_1_BIT;
  Blend blend = Blend::none;
  bool depth_write = true;
  VkCompareOp depth_compare = VK_COMPARE_OP_GREATER_OR_EQUAL;  ///< Depth is reversed.
  bool alpha_to_coverage = false;
  bool marks = false;  ///< Alpha is stored, too: blended by itself, however the others are.
  float depth_bias = 0.0f, depth_bias_slope = 0.0f;
  bool clamp_depth = false;
  std::array<std::uint32_t, 17> constants{};  ///< Specialization constants 0 to 16 of both stages.
};

/// Viewport, scissor, cull mode and front face are dynamic.
VkPipeline create_pipeline(const Device& device, const PipelineLayout& layout, const PipelineDescription& description);

}  // namespace septet::render::vulkan
