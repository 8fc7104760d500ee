#pragma once
/// The graph of one frame together with the images that its resources are (graph/render_graph.hpp knows no image).

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "engine/render/graph/render_graph.hpp"
#include "engine/render/passes/pass_context.hpp"

namespace septet::render {

class FrameGraph {
 public:
  /// `access`: how the last frame left the image; once this one is recorded, how it does. Both outlive `record`.
  ResourceId add_image(std::string name, const vulkan::DeviceImage& image, Access& access);
  /// The window's image, whose contents are not kept from frame to frame.
  ResourceId add_window(VkImage image);
  void add_pass(std::string name, PassUses uses, std::function<void()> record) {
    graph_.add_pass(std::move(name), std::move(uses), std::move(record));
  }
  void keep(ResourceId resource, Access access) { graph_.keep(resource, access); }

  /// Passes and the barriers between them.
  void record(VkCommandBuffer commands);

 private:
  RenderGraph graph_;
  std::vector<vulkan::ImageBarrier> images_;  ///< By resource.
  std::vector<Access*> accesses_;             ///< Likewise; none for the window.
};

}  // namespace septet::render
