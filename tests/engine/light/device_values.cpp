#include "tests/engine/light/device_values.hpp"

#include <array>
#include <cstdint>
#include <cstring>

#include "engine/core/check.hpp"
#include "engine/render/vulkan/commands.hpp"
#include "engine/render/vulkan/device.hpp"
#include "engine/render/vulkan/memory.hpp"

namespace septet::light {
namespace {

namespace vulkan = render::vulkan;
using vulkan::require;

constexpr std::uint32_t code[] = {
#include "tests/engine/light/every_function.comp.inc"
};
constexpr std::size_t points_per_group = 50;

/// Objects created from it are destroyed with it.
struct Computation {
  vulkan::Device device;
  vulkan::MemoryPool memory;
  vulkan::Buffer points, values;
  VkDescriptorSetLayout set = VK_NULL_HANDLE;
  VkPipelineLayout layout = VK_NULL_HANDLE;
  VkShaderModule shader = VK_NULL_HANDLE;
  VkPipeline pipeline = VK_NULL_HANDLE;

  Computation() = default;
  Computation(const Computation&) = delete;
  Computation& operator=(const Computation&) = delete;
  ~Computation() {
    if (device.device) {
      if (pipeline) vkDestroyPipeline(device.device, pipeline, nullptr);
      if (shader) vkDestroyShaderModule(device.device, shader, nullptr);
      if (layout) vkDestroyPipelineLayout(device.device, layout, nullptr);
      if (set) vkDestroyDescriptorSetLayout(device.device, set, nullptr);
      for (vulkan::Buffer* buffer : {&points, &values})
        if (buffer->buffer) destroy_buffer(memory, *buffer);
      destroy_memory(memory);
    }
    destroy_device(device);
  }
};

void create_pipeline(Computation& c) {
  std::array<VkDescriptorSetLayoutBinding, 2> bindings{};
  for (std::uint32_t i = 0; i < bindings.size(); ++i)
    bindings[i] = {i, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 1, VK_SHADER_STAGE_COMPUTE_BIT, nullptr};
  VkDescriptorSetLayoutCreateInfo set{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO};
  set.flags = VK_DESCRIPTOR_SET_LAYOUT_CREATE_PUSH_DESCRIPTOR_BIT_KHR;
  set.bindingCount = bindings.size();
  set.pBindings = bindings.data();
  require(vkCreateDescriptorSetLayout(c.device.device, &set, nullptr, &c.set), "vkCreateDescriptorSetLayout");
  VkPipelineLayoutCreateInfo layout{VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO};
  layout.setLayoutCount = 1;
  layout.pSetLayouts = &c.set;
  require(vkCreatePipelineLayout(c.device.device, &layout, nullptr, &c.layout), "vkCreatePipelineLayout");
  VkShaderModuleCreateInfo shader{VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO};
  shader.codeSize = sizeof code;
  shader.pCode = code;
  require(vkCreateShaderModule(c.device.device, &shader, nullptr, &c.shader), "vkCreateShaderModule");
  VkComputePipelineCreateInfo pipeline{VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO};
  pipeline.stage.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
  pipeline.stage.stage = VK_SHADER_STAGE_COMPUTE_BIT;
  pipeline.stage.module = c.shader;
  pipeline.stage.pName = "main";
  pipeline.layout = c.layout;
  require(vkCreateComputePipelines(c.device.device, VK_NULL_HANDLE, 1, &pipeline, nullptr, &c.pipeline),
          "vkCreateComputePipelines");
}

void record(const Computation& c, VkCommandBuffer commands, std::uint32_t groups, std::uint32_t functions) {
  vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, c.pipeline);
  const std::array<VkDescriptorBufferInfo, 2> buffers{
      {{c.points.buffer, 0, VK_WHOLE_SIZE}, {c.values.buffer, 0, VK_WHOLE_SIZE}}};
  std::array<VkWriteDescriptorSet, 2> writes{};
  for (std::uint32_t i = 0; i < writes.size(); ++i) {
    writes[i].sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET;
    writes[i].dstBinding = i;
    writes[i].descriptorCount = 1;
    writes[i].descriptorType = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
    writes[i].pBufferInfo = &buffers[i];
  }
  vkCmdPushDescriptorSetKHR(commands, VK_PIPELINE_BIND_POINT_COMPUTE, c.layout, 0, writes.size(), writes.data());
  vkCmdDispatch(commands, groups, functions, 1);
}

}  // namespace

std::vector<glm::vec4> values_on_device(std::span<const glm::vec4> points, std::size_t functions) {
  const std::size_t count = points.size() / 2;
  SEPTET_CHECK(count % points_per_group == 0, "{} points", count);
  Computation c;
  vulkan::DeviceOptions software;
  software.software_only = true;
  create_device(c.device, software);
  c.memory.device = &c.device;
  std::vector<glm::vec4> values(count * functions);
  const std::uint64_t bytes = values.size() * sizeof(glm::vec4);
  c.points = create_buffer(c.memory, points.size_bytes(), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT,
                           vulkan::MemoryUse::written_by_host);
  c.values = create_buffer(c.memory, bytes, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, vulkan::MemoryUse::read_by_host);
  std::memcpy(c.points.mapped, points.data(), points.size_bytes());
  create_pipeline(c);
  run_once(c.device, [&](VkCommandBuffer commands) {
    record(c, commands, static_cast<std::uint32_t>(count / points_per_group), static_cast<std::uint32_t>(functions));
  });
  std::memcpy(values.data(), c.values.mapped, bytes);
  return values;
}

}  // namespace septet::light
