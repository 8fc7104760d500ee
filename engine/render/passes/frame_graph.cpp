#include "engine/render/passes/frame_graph.hpp"

#include <cstddef>
#include <span>

namespace septet::render {

ResourceId FrameGraph::add_image(std::string name, const vulkan::DeviceImage& image, Access& access) {
  images_.push_back({&image, VK_NULL_HANDLE, Access::none, Access::none, false});
  accesses_.push_back(&access);
  return graph_.add_resource(std::move(name), access);
}

ResourceId FrameGraph::add_window(VkImage image) {
  images_.push_back({nullptr, image, Access::none, Access::none, false});
  accesses_.push_back(nullptr);
  return graph_.add_resource("window", Access::present);
}

void FrameGraph::record(VkCommandBuffer commands) {
  graph_.execute([&](std::span<const Barrier> barriers) {
    std::vector<vulkan::ImageBarrier> list;
    for (const Barrier& barrier : barriers) {
      list.push_back(images_[barrier.resource]);
      list.back().before = barrier.before;
      list.back().after = barrier.after;
      list.back().discard = barrier.discard;
    }
    record_barriers(commands, list);
  });
  const std::vector<Access> left = graph_.left(graph_.compile());
  for (std::size_t i = 0; i < accesses_.size(); ++i)
    if (accesses_[i]) *accesses_[i] = left[i];
}

}  // namespace septet::render
