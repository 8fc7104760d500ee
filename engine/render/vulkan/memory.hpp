#pragma once
/// Buffers and images in blocks of device memory.
///
/// Memory comes in blocks of 32 MiB for each memory type, buffers and images apart (so bufferImageGranularity never
/// matters); a request of more than half a block gets one of its own. Host-coherent blocks stay mapped.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "engine/render/vulkan/block_allocator.hpp"
#include "engine/render/vulkan/device.hpp"

namespace septet::render::vulkan {

struct MemoryBlock {
  VkDeviceMemory memory = VK_NULL_HANDLE;
  std::byte* mapped = nullptr;
  std::uint32_t type = 0;
  bool for_images = false;
  BlockAllocator allocator{0};
};

struct MemoryPool {
  const Device* device = nullptr;
  std::vector<std::unique_ptr<MemoryBlock>> blocks;
};

/// Part of a block.
struct Allocation {
  MemoryBlock* block = nullptr;
  std::uint64_t offset = 0, size = 0;
};

void destroy_memory(MemoryPool& pool);

enum class MemoryUse : std::uint8_t { device_only, written_by_host, read_by_host };

struct Buffer {
  VkBuffer buffer = VK_NULL_HANDLE;
  Allocation allocation;
  std::uint64_t size = 0;
  std::byte* mapped = nullptr;  ///< Null for device_only, unless host and device share that memory.
};

Buffer create_buffer(MemoryPool& pool, std::uint64_t size, VkBufferUsageFlags usage, MemoryUse memory);
void destroy_buffer(MemoryPool& pool, Buffer& buffer);

struct ImageDescription {
  std::uint32_t width = 0, height = 0;
  VkFormat format = VK_FORMAT_UNDEFINED;
  VkImageUsageFlags usage = 0;
  std::uint32_t mip_levels = 1;
  std::uint32_t layers = 1;
  bool array = false;  ///< View of an array, even of one layer.
  bool cube = false;   ///< View of a cube, whose faces are the six layers.
  VkSampleCountFlagBits samples = VK_SAMPLE_COUNT_1_BIT;
  VkImageAspectFlags aspect = VK_IMAGE_ASPECT_COLOR_BIT;
};

struct DeviceImage {
  VkImage image = VK_NULL_HANDLE;
  VkImageView view = VK_NULL_HANDLE;
  std::vector<VkImageView> layer_views;  ///< One a layer, for images of several layers.
  Allocation allocation;
  ImageDescription description;
};

DeviceImage create_image(MemoryPool& pool, const ImageDescription& description);
void destroy_image(MemoryPool& pool, DeviceImage& image);

}  // namespace septet::render::vulkan
