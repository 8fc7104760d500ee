#pragma once
/// Graph of one frame together with the images of its resources (graph/render_graph.hpp knows no image).

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "engine/render/graph/render_graph.hpp"
#include "engine/render/passes/pass_context.hpp"

namespace septet::render {

class FrameGraph {
 public:
  /// Adds an image. `access`: its last access in the frame before; recording sets it to the last access of this frame.
  /// Image and `access` outlive `record`.
  ResourceId add_image(std::string name, const vulkan::DeviceImage& image, Access& access);
  /// Adds the window's image, whose contents are not kept from frame to frame.
  ResourceId add_window(VkImage image);
  void add_pass(std::string name, PassUses uses, std::function<void()> record) {
    graph_.add_pass(std::move(name), std::move(uses), std::move(record));
  }
  void keep(ResourceId resource, Access access) { graph_.keep(resource, access); }

  /// Records passes and the barriers between them.
  void record(VkCommandBuffer commands);

 private:
  RenderGraph graph_;
  std::vector<vulkan::ImageBarrier> images_;  ///< Indexed by resource.
  std::vector<Access*> accesses_;             ///< Indexed by resource; null for the window.
};

}  // namespace septet::render
