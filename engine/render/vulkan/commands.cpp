#include "engine/render/vulkan/commands.hpp"

#include <algorithm>

namespace septet::render::vulkan {
namespace {

struct AccessScope {
  VkPipelineStageFlags2 stages;
  VkAccessFlags2 access;
  VkImageLayout layout;
};

AccessScope scope_of(Access access) {
  switch (access) {
    case Access::color_attachment:
      return {VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT,
              VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT | VK_ACCESS_2_COLOR_ATTACHMENT_READ_BIT,
              VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    case Access::depth_attachment:
      return {VK_PIPELINE_STAGE_2_EARLY_FRAGMENT_TESTS_BIT | VK_PIPELINE_STAGE_2_LATE_FRAGMENT_TESTS_BIT,
              VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT | VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_READ_BIT,
              VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL};
    case Access::sampled:
      return {VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT, VK_ACCESS_2_SHADER_SAMPLED_READ_BIT,
              VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL};
    case Access::transfer_source:
      return {VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, VK_ACCESS_2_TRANSFER_READ_BIT,
              VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL};
    case Access::transfer_destination:
      return {VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT,
              VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL};
    case Access::present:
      // The semaphore of the presentation orders the rest.
      return {VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, VK_ACCESS_2_NONE, VK_IMAGE_LAYOUT_PRESENT_SRC_KHR};
    case Access::none:
      break;
  }
  return {VK_PIPELINE_STAGE_2_NONE, VK_ACCESS_2_NONE, VK_IMAGE_LAYOUT_UNDEFINED};
}

VkCommandPool create_command_pool(const Device& device) {
  VkCommandPoolCreateInfo info{VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO};
  info.queueFamilyIndex = device.queue_family;
  VkCommandPool pool = VK_NULL_HANDLE;
  require(vkCreateCommandPool(device.device, &info, nullptr, &pool), "vkCreateCommandPool");
  return pool;
}

VkCommandBuffer allocate_commands(const Device& device, VkCommandPool pool) {
  VkCommandBufferAllocateInfo info{VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO};
  info.commandPool = pool;
  info.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
  info.commandBufferCount = 1;
  VkCommandBuffer commands = VK_NULL_HANDLE;
  require(vkAllocateCommandBuffers(device.device, &info, &commands), "vkAllocateCommandBuffers");
  return commands;
}

void begin(VkCommandBuffer commands) {
  VkCommandBufferBeginInfo info{VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
  info.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
  require(vkBeginCommandBuffer(commands, &info), "vkBeginCommandBuffer");
}

VkSemaphore create_semaphore(const Device& device, VkSemaphoreType type) {
  VkSemaphoreTypeCreateInfo kind{VK_STRUCTURE_TYPE_SEMAPHORE_TYPE_CREATE_INFO};
  kind.semaphoreType = type;
  VkSemaphoreCreateInfo info{VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO, &kind};
  VkSemaphore semaphore = VK_NULL_HANDLE;
  require(vkCreateSemaphore(device.device, &info, nullptr, &semaphore), "vkCreateSemaphore");
  return semaphore;
}

void wait_for_value(const Device& device, VkSemaphore timeline, std::uint64_t value) {
  VkSemaphoreWaitInfo info{VK_STRUCTURE_TYPE_SEMAPHORE_WAIT_INFO};
  info.semaphoreCount = 1;
  info.pSemaphores = &timeline;
  info.pValues = &value;
  require(vkWaitSemaphores(device.device, &info, UINT64_MAX), "vkWaitSemaphores");
}

}  // namespace

void record_barriers(VkCommandBuffer commands, std::span<const ImageBarrier> barriers) {
  std::vector<VkImageMemoryBarrier2> list;
  for (const ImageBarrier& barrier : barriers) {
    const AccessScope before = scope_of(barrier.before), after = scope_of(barrier.after);
    VkImageMemoryBarrier2 info{VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2};
    info.srcStageMask = before.stages;
    info.srcAccessMask = before.access;
    info.dstStageMask = after.stages;
    info.dstAccessMask = after.access;
    info.oldLayout = barrier.discard ? VK_IMAGE_LAYOUT_UNDEFINED : before.layout;
    info.newLayout = after.layout;
    info.srcQueueFamilyIndex = info.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    info.image = barrier.image ? barrier.image->image : barrier.swapchain_image;
    const VkImageAspectFlags aspect =
        barrier.image ? barrier.image->description.aspect : VkImageAspectFlags{VK_IMAGE_ASPECT_COLOR_BIT};
    info.subresourceRange = {aspect, 0, VK_REMAINING_MIP_LEVELS, 0, VK_REMAINING_ARRAY_LAYERS};
    list.push_back(info);
  }
  VkDependencyInfo dependency{VK_STRUCTURE_TYPE_DEPENDENCY_INFO};
  dependency.imageMemoryBarrierCount = static_cast<std::uint32_t>(list.size());
  dependency.pImageMemoryBarriers = list.data();
  vkCmdPipelineBarrier2(commands, &dependency);
}

void run_once(const Device& device, const std::function<void(VkCommandBuffer)>& record) {
  struct Owned {
    VkDevice device;
    VkCommandPool pool = VK_NULL_HANDLE;
    VkFence fence = VK_NULL_HANDLE;
    ~Owned() {
      if (fence) vkDestroyFence(device, fence, nullptr);
      if (pool) vkDestroyCommandPool(device, pool, nullptr);
    }
  } owned{device.device};
  owned.pool = create_command_pool(device);
  const VkCommandBuffer commands = allocate_commands(device, owned.pool);
  begin(commands);
  record(commands);
  require(vkEndCommandBuffer(commands), "vkEndCommandBuffer");
  const VkFenceCreateInfo fence{VK_STRUCTURE_TYPE_FENCE_CREATE_INFO};
  require(vkCreateFence(device.device, &fence, nullptr, &owned.fence), "vkCreateFence");
  VkCommandBufferSubmitInfo buffer{VK_STRUCTURE_TYPE_COMMAND_BUFFER_SUBMIT_INFO};
  buffer.commandBuffer = commands;
  VkSubmitInfo2 submit{VK_STRUCTURE_TYPE_SUBMIT_INFO_2};
  submit.commandBufferInfoCount = 1;
  submit.pCommandBufferInfos = &buffer;
  require(vkQueueSubmit2(device.queue, 1, &submit, owned.fence), "vkQueueSubmit2");
  require(vkWaitForFences(device.device, 1, &owned.fence, VK_TRUE, UINT64_MAX), "vkWaitForFences");
}

HostArena::Slice allocate(MemoryPool& pool, HostArena& arena, std::uint64_t size) {
  constexpr std::uint64_t chunk_bytes = std::uint64_t{1} << 20;
  constexpr std::uint64_t alignment = 256;  // Largest that Vulkan lets a device require of offsets.
  if (arena.chunk < arena.chunks.size() && arena.used + size > arena.chunks[arena.chunk].size) {
    ++arena.chunk;
    arena.used = 0;
  }
  while (arena.chunk < arena.chunks.size() && size > arena.chunks[arena.chunk].size) ++arena.chunk;
  if (arena.chunk == arena.chunks.size())
    arena.chunks.push_back(create_buffer(pool, std::max(size, chunk_bytes),
                                         VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT | VK_BUFFER_USAGE_STORAGE_BUFFER_BIT |
                                             VK_BUFFER_USAGE_INDEX_BUFFER_BIT | VK_BUFFER_USAGE_VERTEX_BUFFER_BIT |
                                             VK_BUFFER_USAGE_TRANSFER_SRC_BIT,
                                         MemoryUse::written_by_host));
  const Buffer& buffer = arena.chunks[arena.chunk];
  const HostArena::Slice slice{buffer.buffer, arena.used, buffer.mapped + arena.used};
  arena.used = (arena.used + size + alignment - 1) / alignment * alignment;
  return slice;
}

void destroy_arena(HostArena& arena, MemoryPool& pool) {
  for (Buffer& chunk : arena.chunks) destroy_buffer(pool, chunk);
  arena = {};
}

void Upload::finish() {
  if (copies_.empty()) return;
  run_once(device_, [this](VkCommandBuffer commands) {
    for (const auto& copy : copies_) copy(commands);
  });
  copies_.clear();
}

void create_frame_ring(FrameRing& ring, const Device& device, bool timed) {
  ring.timeline = create_semaphore(device, VK_SEMAPHORE_TYPE_TIMELINE);
  for (FrameSlot& slot : ring.slots) {
    slot.pool = create_command_pool(device);
    slot.commands = allocate_commands(device, slot.pool);
    slot.image_acquired = create_semaphore(device, VK_SEMAPHORE_TYPE_BINARY);
    if (timed) create_pass_marks(slot.marks, device);
  }
}

void destroy_frame_ring(FrameRing& ring, const Device& device, MemoryPool& pool) {
  for (FrameSlot& slot : ring.slots) {
    destroy_arena(slot.arena, pool);
    destroy_pass_marks(slot.marks, device);
    if (slot.image_acquired) vkDestroySemaphore(device.device, slot.image_acquired, nullptr);
    if (slot.pool) vkDestroyCommandPool(device.device, slot.pool, nullptr);
  }
  if (ring.timeline) vkDestroySemaphore(device.device, ring.timeline, nullptr);
  ring = {};
}

FrameSlot& begin_frame(FrameRing& ring, const Device& device) {
  FrameSlot& slot = ring.slots[ring.submitted % frames_in_flight];
  wait_for_value(device, ring.timeline, slot.finished_value);
  require(vkResetCommandPool(device.device, slot.pool, 0), "vkResetCommandPool");
  slot.arena.chunk = 0;
  slot.arena.used = 0;
  begin(slot.commands);
  return slot;
}

void submit(FrameRing& ring, FrameSlot& slot, const Device& device, const PresentSync& sync) {
  require(vkEndCommandBuffer(slot.commands), "vkEndCommandBuffer");
  VkCommandBufferSubmitInfo buffer{VK_STRUCTURE_TYPE_COMMAND_BUFFER_SUBMIT_INFO};
  buffer.commandBuffer = slot.commands;
  VkSemaphoreSubmitInfo wait{VK_STRUCTURE_TYPE_SEMAPHORE_SUBMIT_INFO};
  wait.semaphore = sync.wait;
  wait.stageMask = VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT;
  std::array<VkSemaphoreSubmitInfo, 2> signals{};
  signals[0].sType = signals[1].sType = VK_STRUCTURE_TYPE_SEMAPHORE_SUBMIT_INFO;
  signals[0].semaphore = ring.timeline;
  signals[0].value = ring.submitted + 1;
  signals[0].stageMask = signals[1].stageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
  signals[1].semaphore = sync.signal;
  VkSubmitInfo2 info{VK_STRUCTURE_TYPE_SUBMIT_INFO_2};
  info.waitSemaphoreInfoCount = sync.wait ? 1 : 0;
  info.pWaitSemaphoreInfos = &wait;
  info.commandBufferInfoCount = 1;
  info.pCommandBufferInfos = &buffer;
  info.signalSemaphoreInfoCount = sync.signal ? 2 : 1;
  info.pSignalSemaphoreInfos = signals.data();
  require(vkQueueSubmit2(device.queue, 1, &info, VK_NULL_HANDLE), "vkQueueSubmit2");
  slot.finished_value = ++ring.submitted;
}

void wait_for_frames(const FrameRing& ring, const Device& device) {
  if (ring.timeline) wait_for_value(device, ring.timeline, ring.submitted);
}

}  // namespace septet::render::vulkan
