#include "engine/render/vulkan/pipeline.hpp"

#include <array>
#include <tuple>
#include <vector>

#include "engine/instant/ice_body.hpp"
#include "engine/light/instance_record.hpp"
#include "engine/scene/resolved_scene.hpp"

namespace septet::render::vulkan {
namespace {

constexpr VkShaderStageFlags both_stages = VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT;

VkShaderModule create_module(const Device& device, std::span<const std::uint32_t> code) {
  VkShaderModuleCreateInfo info{VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO};
  info.codeSize = code.size_bytes();
  info.pCode = code.data();
  VkShaderModule result = VK_NULL_HANDLE;
  require(vkCreateShaderModule(device.device, &info, nullptr, &result), "vkCreateShaderModule");
  return result;
}

VkPipelineColorBlendAttachmentState blend_state(Blend blend, bool marks) {
  VkPipelineColorBlendAttachmentState state{};
  // Without marks the target stays opaque: alpha serves blending and coverage only.
  state.colorWriteMask = VK_COLOR_COMPONENT_R_BIT | VK_COLOR_COMPONENT_G_BIT | VK_COLOR_COMPONENT_B_BIT;
  if (marks || blend == Blend::data || blend == Blend::layer) state.colorWriteMask |= VK_COLOR_COMPONENT_A_BIT;
  state.blendEnable = blend != Blend::none && blend != Blend::data;
  // Colours come premultiplied.
  state.srcColorBlendFactor = VK_BLEND_FACTOR_ONE;
  state.dstColorBlendFactor = blend == Blend::add ? VK_BLEND_FACTOR_ONE : VK_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA;
  state.colorBlendOp = VK_BLEND_OP_ADD;
  const bool layered = marks || blend == Blend::layer;
  state.srcAlphaBlendFactor = layered ? VK_BLEND_FACTOR_ONE : VK_BLEND_FACTOR_ZERO;
  state.dstAlphaBlendFactor = layered ? VK_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA : VK_BLEND_FACTOR_ONE;
  state.alphaBlendOp = VK_BLEND_OP_ADD;
  return state;
}

}  // namespace

void create_pipeline_layout(PipelineLayout& layout, const Device& device) {
  std::array<VkDescriptorSetLayoutBinding, binding_count> bindings{};
  for (std::uint32_t i = 0; i < binding_count; ++i) {
    bindings[i].binding = i;
    const bool stored = i == binding_records || i == binding_light_clusters || i == binding_smoke_shade;
    bindings[i].descriptorType = i == binding_view ? VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER
                                 : stored          ? VK_DESCRIPTOR_TYPE_STORAGE_BUFFER
                                                   : VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
    bindings[i].descriptorCount = 1;
    bindings[i].stageFlags = both_stages;
  }
  VkDescriptorSetLayoutCreateInfo set{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO};
  set.flags = VK_DESCRIPTOR_SET_LAYOUT_CREATE_PUSH_DESCRIPTOR_BIT_KHR;
  set.bindingCount = binding_count;
  set.pBindings = bindings.data();
  require(vkCreateDescriptorSetLayout(device.device, &set, nullptr, &layout.set), "vkCreateDescriptorSetLayout");
  const VkPushConstantRange constants{both_stages, 0, push_constant_bytes};
  VkPipelineLayoutCreateInfo info{VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO};
  info.setLayoutCount = 1;
  info.pSetLayouts = &layout.set;
  info.pushConstantRangeCount = 1;
  info.pPushConstantRanges = &constants;
  require(vkCreatePipelineLayout(device.device, &info, nullptr, &layout.layout), "vkCreatePipelineLayout");
}

void destroy_pipeline_layout(PipelineLayout& layout, const Device& device) {
  if (layout.layout) vkDestroyPipelineLayout(device.device, layout.layout, nullptr);
  if (layout.set) vkDestroyDescriptorSetLayout(device.device, layout.set, nullptr);
  layout = {};
}

VkPipeline create_pipeline(const Device& device, const PipelineLayout& layout, const PipelineDescription& description) {
  struct Modules {
    VkDevice device;
    std::vector<VkShaderModule> list;
    ~Modules() {
      for (const VkShaderModule shader : list) vkDestroyShaderModule(device, shader, nullptr);
    }
  } modules{device.device, {}};

  std::array<VkSpecializationMapEntry, std::tuple_size_v<decltype(description.constants)>> entries;
  for (std::uint32_t i = 0; i < entries.size(); ++i) entries[i] = {i, i * 4, 4};
  const VkSpecializationInfo constants{entries.size(), entries.data(), sizeof description.constants,
                                       description.constants.data()};
  std::vector<VkPipelineShaderStageCreateInfo> stages;
  const auto add_stage = [&](VkShaderStageFlagBits stage, std::span<const std::uint32_t> code) {
    if (code.empty()) return;
    modules.list.push_back(create_module(device, code));
    VkPipelineShaderStageCreateInfo info{VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO};
    info.stage = stage;
    info.module = modules.list.back();
    info.pName = "main";
    info.pSpecializationInfo = &constants;
    stages.push_back(info);
  };
  add_stage(VK_SHADER_STAGE_VERTEX_BIT, description.vertex_code);
  add_stage(VK_SHADER_STAGE_FRAGMENT_BIT, description.fragment_code);

  using light::InstanceRecord, scene::SurfaceVertex;
  const std::array<VkVertexInputBindingDescription, 2> buffers{
      {{0, sizeof(SurfaceVertex), VK_VERTEX_INPUT_RATE_VERTEX},
       {1, sizeof(InstanceRecord), VK_VERTEX_INPUT_RATE_INSTANCE}}};
  const std::array<VkVertexInputAttributeDescription, 12> attributes{{
      {0, 0, VK_FORMAT_R32G32B32_SFLOAT, offsetof(SurfaceVertex, position_m)},
      {1, 0, VK_FORMAT_R32G32_SFLOAT, offsetof(SurfaceVertex, uv)},
      {3, 1, VK_FORMAT_R32G32B32A32_SFLOAT, offsetof(InstanceRecord, row0)},
      {4, 1, VK_FORMAT_R32G32B32A32_SFLOAT, offsetof(InstanceRecord, row1)},
      {5, 1, VK_FORMAT_R32G32B32A32_SFLOAT, offsetof(InstanceRecord, row2)},
      {8, 1, VK_FORMAT_R32G32_SFLOAT, offsetof(InstanceRecord, shown)},
      // Inputs that shadows omit come last.
      {2, 0, VK_FORMAT_R32G32B32_SFLOAT, offsetof(SurfaceVertex, normal)},
      {6, 1, VK_FORMAT_R32G32B32A32_SFLOAT, offsetof(InstanceRecord, tint)},
      {7, 1, VK_FORMAT_R32G32B32A32_SFLOAT, offsetof(InstanceRecord, light)},
      {9, 0, VK_FORMAT_R8G8B8A8_UNORM, offsetof(SurfaceVertex, color)},
      {10, 0, VK_FORMAT_R8G8B8A8_SNORM, offsetof(SurfaceVertex, tangent)},
      {11, 0, VK_FORMAT_R32G32_SFLOAT, offsetof(SurfaceVertex, second_uv)},
  }};
  VkPipelineVertexInputStateCreateInfo vertices{VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO};
  using ice::IceVertex;
  constexpr VkVertexInputBindingDescription ice_buffer{0, sizeof(IceVertex), VK_VERTEX_INPUT_RATE_VERTEX};
  constexpr std::array<VkVertexInputAttributeDescription, 3> ice_attributes{
      {{0, 0, VK_FORMAT_R32G32B32_SFLOAT, offsetof(IceVertex, position_m)},
       {1, 0, VK_FORMAT_R32G32B32_SFLOAT, offsetof(IceVertex, normal)},
       {2, 0, VK_FORMAT_R32G32B32_SFLOAT, offsetof(IceVertex, rest_m)}}};
  if (description.vertex_input == VertexInput::ice) {
    vertices.vertexBindingDescriptionCount = 1;
    vertices.pVertexBindingDescriptions = &ice_buffer;
    vertices.vertexAttributeDescriptionCount = ice_attributes.size();
    vertices.pVertexAttributeDescriptions = ice_attributes.data();
  } else if (description.vertex_input != VertexInput::none) {
    vertices.vertexBindingDescriptionCount = buffers.size();
    vertices.pVertexBindingDescriptions = buffers.data();
    vertices.vertexAttributeDescriptionCount = description.vertex_input == VertexInput::surface ? attributes.size() : 6;
    vertices.pVertexAttributeDescriptions = attributes.data();
  }
  VkPipelineInputAssemblyStateCreateInfo assembly{VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO};
  assembly.topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST;
  VkPipelineViewportStateCreateInfo viewport{VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO};
  viewport.viewportCount = 1;
  viewport.scissorCount = 1;
  VkPipelineRasterizationStateCreateInfo raster{VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO};
  raster.lineWidth = 1.0f;
  raster.depthClampEnable = description.clamp_depth;
  raster.depthBiasEnable = description.depth_bias != 0.0f || description.depth_bias_slope != 0.0f;
  raster.depthBiasConstantFactor = description.depth_bias;
  raster.depthBiasSlopeFactor = description.depth_bias_slope;
  VkPipelineMultisampleStateCreateInfo multisample{VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO};
  multisample.rasterizationSamples = description.samples;
  multisample.alphaToCoverageEnable = description.alpha_to_coverage;
  VkPipelineDepthStencilStateCreateInfo depth{VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO};
  depth.depthTestEnable = description.depth_format != VK_FORMAT_UNDEFINED;
  depth.depthWriteEnable = description.depth_write;
  depth.depthCompareOp = description.depth_compare;
  const VkPipelineColorBlendAttachmentState attachment = blend_state(description.blend, description.marks);
  VkPipelineColorBlendStateCreateInfo blend{VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO};
  blend.attachmentCount = description.color_format != VK_FORMAT_UNDEFINED ? 1 : 0;
  blend.pAttachments = &attachment;
  const std::array<VkDynamicState, 4> dynamic_states{VK_DYNAMIC_STATE_VIEWPORT, VK_DYNAMIC_STATE_SCISSOR,
                                                     VK_DYNAMIC_STATE_CULL_MODE, VK_DYNAMIC_STATE_FRONT_FACE};
  VkPipelineDynamicStateCreateInfo dynamic{VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO};
  dynamic.dynamicStateCount = dynamic_states.size();
  dynamic.pDynamicStates = dynamic_states.data();
  VkPipelineRenderingCreateInfo rendering{VK_STRUCTURE_TYPE_PIPELINE_RENDERING_CREATE_INFO};
  rendering.colorAttachmentCount = blend.attachmentCount;
  rendering.pColorAttachmentFormats = &description.color_format;
  rendering.depthAttachmentFormat = description.depth_format;

  VkGraphicsPipelineCreateInfo info{VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO, &rendering};
  info.stageCount = static_cast<std::uint32_t>(stages.size());
  info.pStages = stages.data();
  info.pVertexInputState = &vertices;
  info.pInputAssemblyState = &assembly;
  info.pViewportState = &viewport;
  info.pRasterizationState = &raster;
  info.pMultisampleState = &multisample;
  info.pDepthStencilState = &depth;
  info.pColorBlendState = &blend;
  info.pDynamicState = &dynamic;
  info.layout = layout.layout;
  VkPipeline pipeline = VK_NULL_HANDLE;
  require(vkCreateGraphicsPipelines(device.device, VK_NULL_HANDLE, 1, &info, nullptr, &pipeline),
          "vkCreateGraphicsPipelines");
  return pipeline;
}

}  // namespace septet::render::vulkan
