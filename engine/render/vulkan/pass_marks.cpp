#include "engine/render/vulkan/pass_marks.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace septet::render::vulkan {
namespace {

constexpr std::uint32_t most_marks = 128;

std::vector<PassTime> times_of(const PassMarks& marks, const Device& device) {
  std::vector<PassTime> times;
  std::vector<std::uint64_t> ticks(marks.names.size());
  if (ticks.empty() || vkGetQueryPoolResults(device.device, marks.pool, 0, static_cast<std::uint32_t>(ticks.size()),
                                             ticks.size() * sizeof(std::uint64_t), ticks.data(), sizeof(std::uint64_t),
                                             VK_QUERY_RESULT_64_BIT) != VK_SUCCESS)
    return times;
  const double tick_ms = static_cast<double>(device.properties.limits.timestampPeriod) * 1e-6;
  for (std::size_t i = 1; i < ticks.size(); ++i) {
    auto time = std::ranges::find(times, marks.names[i], &PassTime::name);
    if (time == times.end()) time = times.insert(times.end(), {marks.names[i], 0.0});
    time->time_ms += static_cast<double>(ticks[i] - ticks[i - 1]) * tick_ms;
  }
  return times;
}

}  // namespace

void create_pass_marks(PassMarks& marks, const Device& device) {
  if (!device.properties.limits.timestampComputeAndGraphics) return;
  VkQueryPoolCreateInfo info{VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO};
  info.queryType = VK_QUERY_TYPE_TIMESTAMP;
  info.queryCount = most_marks;
  require(vkCreateQueryPool(device.device, &info, nullptr, &marks.pool), "vkCreateQueryPool");
}

void destroy_pass_marks(PassMarks& marks, const Device& device) {
  if (marks.pool) vkDestroyQueryPool(device.device, marks.pool, nullptr);
  marks = {};
}

std::vector<PassTime> begin_pass_marks(PassMarks& marks, const Device& device, VkCommandBuffer commands) {
  if (!marks.pool) return {};
  std::vector<PassTime> times = times_of(marks, device);
  marks.names.clear();
  vkCmdResetQueryPool(commands, marks.pool, 0, most_marks);
  mark_pass(marks, commands, "begin");
  return times;
}

void mark_pass(PassMarks& marks, VkCommandBuffer commands, std::string_view name) {
  if (!marks.pool || marks.names.size() >= most_marks) return;
  vkCmdWriteTimestamp2(commands, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, marks.pool,
                       static_cast<std::uint32_t>(marks.names.size()));
  marks.names.push_back(name);
}

}  // namespace septet::render::vulkan
