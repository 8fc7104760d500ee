#pragma once
/// Time of each pass of a frame by the device's clock: a timestamp after each pass.
///
/// A frame's times are read when its slot is used again, so nothing waits for them. A software device finishes all work
/// recorded before each timestamp first: the frame takes a little longer, and the times are exact.

#include <string_view>
#include <vector>

#include "engine/render/pass_time.hpp"
#include "engine/render/vulkan/device.hpp"

namespace septet::render::vulkan {

/// Marks of one frame in flight; without a pool there are no timestamps.
struct PassMarks {
  VkQueryPool pool = VK_NULL_HANDLE;
  std::vector<std::string_view> names;
};

/// Creates the pool, unless the device has no timestamps.
void create_pass_marks(PassMarks& marks, const Device& device);
void destroy_pass_marks(PassMarks& marks, const Device& device);

/// Begins a frame after the last one of these marks has finished: returns the times of its passes, in order, those of
/// equal names summed.
std::vector<PassTime> begin_pass_marks(PassMarks& marks, const Device& device, VkCommandBuffer commands);
/// Attributes the commands recorded since the last mark to this pass. Marks after the 128th of a frame are dropped.
void mark_pass(PassMarks& marks, VkCommandBuffer commands, std::string_view name);

}  // namespace septet::render::vulkan
