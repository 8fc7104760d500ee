#include "engine/render/passes/pass_context.hpp"

#include <algorithm>
#include <cstddef>
#include <cstring>

namespace septet::render {
namespace {

VkSampler create_sampler(const vulkan::Device& device, const VkSamplerCreateInfo& info) {
  VkSampler sampler = VK_NULL_HANDLE;
  vulkan::require(vkCreateSampler(device.device, &info, nullptr, &sampler), "vkCreateSampler");
  return sampler;
}

VkSampler create_image_sampler(const vulkan::Device& device, const scene::ImageSampling& sampling,
                               VkSamplerMipmapMode mip_levels) {
  const auto address = [](bool clamps) {
    return clamps ? VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE : VK_SAMPLER_ADDRESS_MODE_REPEAT;
  };
  VkSamplerCreateInfo info{VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO};
  info.magFilter = sampling.sharp ? VK_FILTER_NEAREST : VK_FILTER_LINEAR;
  info.minFilter = VK_FILTER_LINEAR;
  info.mipmapMode = mip_levels;
  info.addressModeU = address(sampling.clamps_u);
  info.addressModeV = address(sampling.clamps_v);
  info.addressModeW = VK_SAMPLER_ADDRESS_MODE_REPEAT;
  info.maxLod = VK_LOD_CLAMP_NONE;
  info.maxAnisotropy = 1.0f;
  return create_sampler(device, info);
}

VkSampler create_sampler(const vulkan::Device& device, VkSamplerAddressMode address, VkSamplerMipmapMode mip_levels,
                         float anisotropy, bool compare, VkFilter filter = VK_FILTER_LINEAR) {
  VkSamplerCreateInfo info{VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO};
  info.magFilter = info.minFilter = filter;
  info.mipmapMode = mip_levels;
  info.addressModeU = info.addressModeV = info.addressModeW = address;
  info.maxLod = VK_LOD_CLAMP_NONE;
  info.anisotropyEnable = anisotropy > 1.0f;
  info.maxAnisotropy = std::min(anisotropy, device.properties.limits.maxSamplerAnisotropy);
  info.compareEnable = compare;
  info.compareOp = VK_COMPARE_OP_GREATER_OR_EQUAL;
  return create_sampler(device, info);
}

VkWriteDescriptorSet write(std::uint32_t binding, VkDescriptorType type) {
  VkWriteDescriptorSet result{VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET};
  result.dstBinding = binding;
  result.descriptorCount = 1;
  result.descriptorType = type;
  return result;
}

void push(PassContext& context, std::span<const VkWriteDescriptorSet> writes) {
  vkCmdPushDescriptorSetKHR(context.slot.commands, VK_PIPELINE_BIND_POINT_GRAPHICS, context.layout.layout, 0,
                            static_cast<std::uint32_t>(writes.size()), writes.data());
}

}  // namespace

void create_samplers(Samplers& samplers, const vulkan::Device& device) {
  samplers.anisotropic = device.properties.deviceType != VK_PHYSICAL_DEVICE_TYPE_CPU;
  constexpr VkSamplerAddressMode repeat = VK_SAMPLER_ADDRESS_MODE_REPEAT, clamp = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
  constexpr VkSamplerMipmapMode nearest = VK_SAMPLER_MIPMAP_MODE_NEAREST, linear = VK_SAMPLER_MIPMAP_MODE_LINEAR;
  for (std::size_t way = 0; way < samplers.images.size(); ++way)
    samplers.images[way] = create_image_sampler(device, {(way & 1) != 0, (way & 2) != 0, (way & 4) != 0},
                                                samplers.anisotropic ? linear : nearest);
  samplers.surface = samplers.images[0];
  samplers.road = create_sampler(device, repeat, samplers.anisotropic ? linear : nearest,
                                 samplers.anisotropic ? 16.0f : 1.0f, false);
  samplers.table = create_sampler(device, clamp, nearest, 1.0f, false);
  samplers.shadow = create_sampler(device, clamp, nearest, 1.0f, true);
  samplers.texel = create_sampler(device, clamp, nearest, 1.0f, false, VK_FILTER_NEAREST);
}

void destroy_samplers(Samplers& samplers, const vulkan::Device& device) {
  for (const VkSampler sampler : samplers.images)
    if (sampler) vkDestroySampler(device.device, sampler, nullptr);
  for (const VkSampler sampler : {samplers.road, samplers.table, samplers.shadow, samplers.texel})
    if (sampler) vkDestroySampler(device.device, sampler, nullptr);
  samplers = {};
}

FrameData store(PassContext& context, std::span<const std::byte> bytes) {
  const std::uint64_t size = std::max<std::uint64_t>(bytes.size(), 256);
  const vulkan::HostArena::Slice slice = allocate(context.memory, context.slot.arena, size);
  if (!bytes.empty()) std::memcpy(slice.data, bytes.data(), bytes.size());
  return {slice.buffer, slice.offset, size};
}

void push_view(PassContext& context, const ViewBindings& bindings) {
  const VkDescriptorBufferInfo uniforms{bindings.uniforms.buffer, bindings.uniforms.offset, bindings.uniforms.size};
  // A null view is replaced by the noise, since every binding must be bound.
  const auto or_noise = [&](VkImageView view) { return view ? view : bindings.noise; };
  const VkDescriptorImageInfo images[13] = {
      {context.samplers.table, bindings.sky_table, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL},
      {context.samplers.shadow, bindings.shadow_map, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL},
      {context.samplers.surface, bindings.noise, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL},
      {context.samplers.surface, bindings.noise, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL},
      {context.samplers.table, bindings.lamp_field, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL},
      {context.samplers.table, or_noise(bindings.road_mirror), VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL},
      {context.samplers.table, or_noise(bindings.road_mirror_spread), VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL},
      {context.samplers.texel, or_noise(bindings.road_mirror_depth), VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL},
      {context.samplers.surface, or_noise(bindings.ripples), VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL},
      {context.samplers.texel, bindings.shadow_map, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL},
      {context.samplers.surface, bindings.noise, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL},
      {context.samplers.surface, bindings.noise, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL},
      {context.samplers.surface, bindings.noise, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL}};
  VkWriteDescriptorSet writes[16] = {
      write(vulkan::binding_view, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER),
      write(vulkan::binding_sky, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER),
      write(vulkan::binding_shadow, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER),
      write(vulkan::binding_noise, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER),
      write(vulkan::binding_image, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER),
      write(vulkan::binding_lamps, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER),
      write(vulkan::binding_road_mirror, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER),
      write(vulkan::binding_road_mirror_spread, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER),
      write(vulkan::binding_road_mirror_depth, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER),
      write(vulkan::binding_ripples, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER),
      write(vulkan::binding_shadow_depths, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER),
      write(vulkan::binding_emission_map, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER),
      write(vulkan::binding_properties_map, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER),
      write(vulkan::binding_normal_map, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER),
      write(vulkan::binding_light_clusters, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER),
      write(vulkan::binding_smoke_shade, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER)};
  writes[0].pBufferInfo = &uniforms;
  for (int i = 0; i < 13; ++i) writes[1 + i].pImageInfo = &images[i];
  const auto or_uniforms = [&](const FrameData& data) {
    const FrameData& bound = data.buffer ? data : bindings.uniforms;
    return VkDescriptorBufferInfo{bound.buffer, bound.offset, bound.size};
  };
  const VkDescriptorBufferInfo clusters = or_uniforms(bindings.light_clusters),
                               smoke_shade = or_uniforms(bindings.smoke_shade);
  writes[14].pBufferInfo = &clusters;
  writes[15].pBufferInfo = &smoke_shade;
  push(context, writes);
}

void bind_instances(PassContext& context, const FrameData& records) {
  vkCmdBindVertexBuffers(context.slot.commands, 1, 1, &records.buffer, &records.offset);
}

void push_records(PassContext& context, const FrameData& records) {
  const VkDescriptorBufferInfo buffer{records.buffer, records.offset, records.size};
  VkWriteDescriptorSet storage = write(vulkan::binding_records, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER);
  storage.pBufferInfo = &buffer;
  push(context, {&storage, 1});
}

void push_image(PassContext& context, VkImageView view, VkSampler sampler, std::uint32_t binding) {
  const VkDescriptorImageInfo info{sampler, view, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL};
  VkWriteDescriptorSet image = write(binding, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER);
  image.pImageInfo = &info;
  push(context, {&image, 1});
}

void push_constants(PassContext& context, std::span<const std::byte> bytes) {
  vkCmdPushConstants(context.slot.commands, context.layout.layout,
                     VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT, 0,
                     static_cast<std::uint32_t>(bytes.size()), bytes.data());
}

void set_viewport(PassContext& context, const PixelRectangle& rectangle) {
  const VkViewport viewport{static_cast<float>(rectangle.x),
                            static_cast<float>(rectangle.y),
                            static_cast<float>(rectangle.width),
                            static_cast<float>(rectangle.height),
                            0.0f,
                            1.0f};
  const VkRect2D scissor{{rectangle.x, rectangle.y}, {rectangle.width, rectangle.height}};
  vkCmdSetViewport(context.slot.commands, 0, 1, &viewport);
  vkCmdSetScissor(context.slot.commands, 0, 1, &scissor);
}

void mark_pass(PassContext& context, std::string_view name) {
  vulkan::mark_pass(context.slot.marks, context.slot.commands, name);
}

}  // namespace septet::render
