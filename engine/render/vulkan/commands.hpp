#pragma once
/// Recording and submitting: barriers, one-off commands, and the slots of frames in flight.

#include <array>
#include <functional>
#include <span>
#include <vector>

#include "engine/render/graph/render_graph.hpp"
#include "engine/render/vulkan/memory.hpp"
#include "engine/render/vulkan/pass_marks.hpp"

namespace septet::render::vulkan {

/// Change of access to a whole image.
struct ImageBarrier {
  const DeviceImage* image = nullptr;
  VkImage swapchain_image = VK_NULL_HANDLE;  ///< Used instead of `image`.
  Access before = Access::none, after = Access::none;
  bool discard = false;
};

void record_barriers(VkCommandBuffer commands, std::span<const ImageBarrier> barriers);

/// Records, submits and waits: for uploads and reading back.
void run_once(const Device& device, const std::function<void(VkCommandBuffer)>& record);

/// Host-written memory that lives for one frame (uniforms, instance records, texts) or one upload.
struct HostArena {
  struct Slice {
    VkBuffer buffer = VK_NULL_HANDLE;
    std::uint64_t offset = 0;
    std::byte* data = nullptr;
  };
  std::vector<Buffer> chunks;
  std::size_t chunk = 0;
  std::uint64_t used = 0;
};

HostArena::Slice allocate(MemoryPool& pool, HostArena& arena, std::uint64_t size);
void destroy_arena(HostArena& arena, MemoryPool& pool);

/// Copies to the device, noted one by one and sent in one submission, since each submission costs a wait.
class Upload {
 public:
  Upload(const Device& device, MemoryPool& memory) : device_(device), memory_(memory) {}
  ~Upload() { destroy_arena(staging_, memory_); }
  Upload(const Upload&) = delete;
  Upload& operator=(const Upload&) = delete;

  const Device& device() const { return device_; }
  MemoryPool& memory() const { return memory_; }
  /// Memory that the host fills before `finish`, for a copy to read.
  HostArena::Slice stage(std::uint64_t size) { return allocate(memory_, staging_, size); }
  void add(std::function<void(VkCommandBuffer)> copy) { copies_.push_back(std::move(copy)); }
  /// Submits the added copies and waits for them. Without it they are never made.
  void finish();

 private:
  const Device& device_;
  MemoryPool& memory_;
  HostArena staging_;
  std::vector<std::function<void(VkCommandBuffer)>> copies_;
};

/// Resources of one frame in flight.
struct FrameSlot {
  VkCommandPool pool = VK_NULL_HANDLE;
  VkCommandBuffer commands = VK_NULL_HANDLE;
  VkSemaphore image_acquired = VK_NULL_HANDLE;
  std::uint64_t finished_value = 0;  ///< Timeline value at which the device is done with the slot.
  HostArena arena;
  PassMarks marks;  ///< Without a pool unless frames are timed.
};

inline constexpr std::size_t frames_in_flight = 2;

struct FrameRing {
  std::array<FrameSlot, frames_in_flight> slots;
  VkSemaphore timeline = VK_NULL_HANDLE;
  std::uint64_t submitted = 0;
};

/// Creates the ring. `timed`: passes are marked.
void create_frame_ring(FrameRing& ring, const Device& device, bool timed);
void destroy_frame_ring(FrameRing& ring, const Device& device, MemoryPool& pool);
/// Waits until the slot of the next frame is free and begins its commands.
FrameSlot& begin_frame(FrameRing& ring, const Device& device);
/// Further semaphores that a submission waits for and signals; null: not used.
struct PresentSync {
  VkSemaphore wait = VK_NULL_HANDLE, signal = VK_NULL_HANDLE;
};
/// Ends the slot's commands and submits them.
void submit(FrameRing& ring, FrameSlot& slot, const Device& device, const PresentSync& sync = {});
/// Waits until every submitted frame is finished.
void wait_for_frames(const FrameRing& ring, const Device& device);

}  // namespace septet::render::vulkan
