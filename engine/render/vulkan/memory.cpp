#include "engine/render/vulkan/memory.hpp"

#include <algorithm>

namespace septet::render::vulkan {
namespace {

constexpr std::uint64_t block_bytes = std::uint64_t{32} << 20;

std::uint32_t memory_type(const Device& device, std::uint32_t allowed, VkMemoryPropertyFlags wanted) {
  for (std::uint32_t i = 0; i < device.memory.memoryTypeCount; ++i)
    if ((allowed & (1u << i)) && (device.memory.memoryTypes[i].propertyFlags & wanted) == wanted) return i;
  throw Failure{{"no memory type has what the picture needs", "the Vulkan device", "take another device"}};
}

VkMemoryPropertyFlags properties_of(MemoryUse use) {
  constexpr VkMemoryPropertyFlags host = VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
  return use == MemoryUse::device_only ? VkMemoryPropertyFlags{VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT} : host;
}

std::unique_ptr<MemoryBlock> create_block(const Device& device, std::uint32_t type, std::uint64_t size,
                                          bool for_images) {
  auto block = std::make_unique<MemoryBlock>();
  block->type = type;
  block->for_images = for_images;
  block->allocator = BlockAllocator(size);
  VkMemoryAllocateInfo info{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO};
  info.allocationSize = size;
  info.memoryTypeIndex = type;
  require(vkAllocateMemory(device.device, &info, nullptr, &block->memory), "vkAllocateMemory");
  if (device.memory.memoryTypes[type].propertyFlags & VK_MEMORY_PROPERTY_HOST_COHERENT_BIT) {
    void* mapped = nullptr;
    if (const VkResult result = vkMapMemory(device.device, block->memory, 0, VK_WHOLE_SIZE, 0, &mapped);
        result != VK_SUCCESS) {
      vkFreeMemory(device.device, block->memory, nullptr);
      require(result, "vkMapMemory");
    }
    block->mapped = static_cast<std::byte*>(mapped);
  }
  return block;
}

Allocation allocate(MemoryPool& pool, const VkMemoryRequirements& needs, MemoryUse use, bool for_images) {
  const std::uint32_t type = memory_type(*pool.device, needs.memoryTypeBits, properties_of(use));
  if (needs.size <= block_bytes / 2)
    for (const auto& block : pool.blocks)
      if (block->type == type && block->for_images == for_images)
        if (const auto offset = block->allocator.allocate(needs.size, needs.alignment))
          return {block.get(), *offset, needs.size};
  const std::uint64_t size = needs.size <= block_bytes / 2 ? block_bytes : needs.size;
  pool.blocks.push_back(create_block(*pool.device, type, size, for_images));
  MemoryBlock& block = *pool.blocks.back();
  return {&block, *block.allocator.allocate(needs.size, needs.alignment), needs.size};
}

/// Frees an allocation; an empty block goes back to the device at once.
void release(MemoryPool& pool, Allocation& allocation) {
  if (!allocation.block) return;
  MemoryBlock* block = allocation.block;
  block->allocator.free(allocation.offset, allocation.size);
  allocation = {};
  if (block->allocator.free_bytes() != block->allocator.size()) return;
  vkFreeMemory(pool.device->device, block->memory, nullptr);
  std::erase_if(pool.blocks, [&](const auto& other) { return other.get() == block; });
}

VkImageView create_view(const Device& device, const DeviceImage& image, VkImageViewType type, std::uint32_t first,
                        std::uint32_t count) {
  VkImageViewCreateInfo info{VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO};
  info.image = image.image;
  info.viewType = type;
  info.format = image.description.format;
  info.subresourceRange = {image.description.aspect, 0, image.description.mip_levels, first, count};
  VkImageView view = VK_NULL_HANDLE;
  require(vkCreateImageView(device.device, &info, nullptr, &view), "vkCreateImageView");
  return view;
}

}  // namespace

void destroy_memory(MemoryPool& pool) {
  for (const auto& block : pool.blocks) vkFreeMemory(pool.device->device, block->memory, nullptr);
  pool.blocks.clear();
}

Buffer create_buffer(MemoryPool& pool, std::uint64_t size, VkBufferUsageFlags usage, MemoryUse memory) {
  Buffer result;
  result.size = size;
  VkBufferCreateInfo info{VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO};
  info.size = size;
  info.usage = usage;
  require(vkCreateBuffer(pool.device->device, &info, nullptr, &result.buffer), "vkCreateBuffer");
  VkMemoryRequirements needs;
  vkGetBufferMemoryRequirements(pool.device->device, result.buffer, &needs);
  try {
    result.allocation = allocate(pool, needs, memory, false);
    require(vkBindBufferMemory(pool.device->device, result.buffer, result.allocation.block->memory,
                               result.allocation.offset),
            "vkBindBufferMemory");
  } catch (const Failure&) {
    destroy_buffer(pool, result);
    throw;
  }
  if (result.allocation.block->mapped) result.mapped = result.allocation.block->mapped + result.allocation.offset;
  return result;
}

void destroy_buffer(MemoryPool& pool, Buffer& buffer) {
  if (buffer.buffer) vkDestroyBuffer(pool.device->device, buffer.buffer, nullptr);
  release(pool, buffer.allocation);
  buffer = {};
}

DeviceImage create_image(MemoryPool& pool, const ImageDescription& description) {
  DeviceImage result;
  result.description = description;
  VkImageCreateInfo info{VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO};
  info.imageType = VK_IMAGE_TYPE_2D;
  if (description.cube) info.flags = VK_IMAGE_CREATE_CUBE_COMPATIBLE_BIT;
  info.format = description.format;
  info.extent = {description.width, description.height, 1};
  info.mipLevels = description.mip_levels;
  info.arrayLayers = description.layers;
  info.samples = description.samples;
  info.tiling = VK_IMAGE_TILING_OPTIMAL;
  info.usage = description.usage;
  require(vkCreateImage(pool.device->device, &info, nullptr, &result.image), "vkCreateImage");
  VkMemoryRequirements needs;
  vkGetImageMemoryRequirements(pool.device->device, result.image, &needs);
  try {
    result.allocation = allocate(pool, needs, MemoryUse::device_only, true);
    require(
        vkBindImageMemory(pool.device->device, result.image, result.allocation.block->memory, result.allocation.offset),
        "vkBindImageMemory");
    const VkImageViewType type = description.cube    ? VK_IMAGE_VIEW_TYPE_CUBE
                                 : description.array ? VK_IMAGE_VIEW_TYPE_2D_ARRAY
                                                     : VK_IMAGE_VIEW_TYPE_2D;
    result.view = create_view(*pool.device, result, type, 0, description.layers);
    if (description.layers > 1)
      for (std::uint32_t layer = 0; layer < description.layers; ++layer)
        result.layer_views.push_back(create_view(*pool.device, result, VK_IMAGE_VIEW_TYPE_2D, layer, 1));
  } catch (const Failure&) {
    destroy_image(pool, result);
    throw;
  }
  return result;
}

void destroy_image(MemoryPool& pool, DeviceImage& image) {
  const VkDevice device = pool.device->device;
  for (const VkImageView view : image.layer_views) vkDestroyImageView(device, view, nullptr);
  if (image.view) vkDestroyImageView(device, image.view, nullptr);
  if (image.image) vkDestroyImage(device, image.image, nullptr);
  release(pool, image.allocation);
  image = {};
}

}  // namespace septet::render::vulkan
