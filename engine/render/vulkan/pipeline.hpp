#pragma once
/// Graphics pipelines: one layout for all of them, dynamic rendering, and their differences as plain data.

#include <array>
#include <cstdint>
#include <span>

#include "engine/render/vulkan/device.hpp"

namespace septet::render::vulkan {

/// Bindings of the one descriptor set, pushed while recording.
enum Binding : std::uint32_t {
  binding_view = 0,  ///< Uniforms of the view.
  /// Storage: soot for surfaces, or the records of contacts, wet lamps, smoke, glows, streaks or mirror glass.
  binding_records = 1,
  binding_sky = 2,
  binding_shadow = 3,
  binding_noise = 4,
  binding_image = 5,  ///< Image of the draw: a material's, the overlay's, or the source of a whole-target pass.
  /// Ice (passes/ice_pass.hpp): normals and depth of its nearest front faces, of the back faces behind them, its
  /// inside, and the cube map of its surroundings.
  binding_ice_front = 6,
  binding_ice_back = 7,
  binding_ice_inside = 8,
  binding_surroundings = 9,
  /// Normals and depth of the nearest front faces behind those back faces, and of the back faces behind these.
  binding_ice_beyond = 10,
  binding_ice_beyond_back = 11,
  binding_lamps = 12,           ///< Light of standing lamps (passes/lamp_field.hpp).
  binding_road_mirror = 13,     ///< Mirror image in a wet road (passes/road_mirror_pass.hpp).
  binding_ripples = 14,         ///< Slopes of the water on the road.
  binding_shadow_depths = 15,   ///< Shadow map, not compared.
  binding_light_clusters = 16,  ///< Storage: lists of headlights by place (passes/light_clusters.hpp).
  binding_history = 17,         ///< Frame before (passes/temporal_pass.hpp).
  binding_depth = 18,           ///< Depth of this frame.
  /// Mirror image in a wet road, spread by its roughness, and its depth.
  binding_road_mirror_spread = 19,
  binding_road_mirror_depth = 20,
  /// Images of the draw's material beside binding_image, in the order of scene::SurfaceMap.
  binding_emission_map = 21,
  binding_properties_map = 22,
  binding_normal_map = 23,
  binding_smoke_shade = 24,  ///< Storage: moments of smoke along the light (passes/smoke_shade.hpp).
  binding_count = 25,
};

inline constexpr std::uint32_t push_constant_bytes = 128;

struct PipelineLayout {
  VkDescriptorSetLayout set = VK_NULL_HANDLE;
  VkPipelineLayout layout = VK_NULL_HANDLE;
};

void create_pipeline_layout(PipelineLayout& layout, const Device& device);
void destroy_pipeline_layout(PipelineLayout& layout, const Device& device);

/// Blending of colours. `data`: none, and alpha is stored like the other three. `layer`: as `over`, onto a picture with
/// an alpha of its own.
enum class Blend : std::uint8_t { none, over, add, data, layer };
/// Vertex-shader inputs. Buffer 0, scene::SurfaceVertex: position, texture coordinates and normal at locations 0, 1, 2.
/// Buffer 1, once an instance: light::InstanceRecord, at the locations given there. `shadow` omits the normal and the
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
  bool marks = false;  ///< Alpha is stored, too: blended by itself, whatever the blending of the colours.
  float depth_bias = 0.0f, depth_bias_slope = 0.0f;
  bool clamp_depth = false;
  std::array<std::uint32_t, 22> constants{};  ///< Specialization constants 0 to 21 of both stages.
};

/// Creates a pipeline. Viewport, scissor, cull mode and front face are dynamic.
VkPipeline create_pipeline(const Device& device, const PipelineLayout& layout, const PipelineDescription& description);

}  // namespace septet::render::vulkan
