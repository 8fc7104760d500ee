#pragma once
/// What the device takes for each pass of a frame, by its own clock: a timestamp after each pass.
///
/// A frame's times are read when its slot is used again, so nothing waits for them. A software device draws what was recorded before each
/// timestamp first: the frame takes a little longer, and the times are exact.

#include <string_view>
#include <vector>

#include "engine/render/pass_time.hpp"
#include "engine/render/vulkan/device.hpp"

namespace septet::render::vulkan {

/// Those of one frame in flight; without a pool there are none.
struct PassMarks {
  VkQueryPool pool = VK_NULL_HANDLE;
  std::vector<std::string_view> names;
};

/// On a device without timestamps there are none.
void create_pass_marks(PassMarks& marks, const Device& device);
void destroy_pass_marks(PassMarks& marks, const Device& device);

/// Begins a frame, the last one of these marks being finished: returns what its passes took, in order, equal names summed.
std::vector<PassTime> begin_pass_marks(PassMarks& marks, const Device& device, VkCommandBuffer commands);
/// What was recorded since the last mark was this pass. More than 128 of a frame are dropped.
void mark_pass(PassMarks& marks, VkCommandBuffer commands, std::string_view name);

}  // namespace septet::render::vulkan
