// volk first: GLFW then knows Vulkan's types and leaves its functions alone.
#include "engine/render/window_surface.hpp"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include "engine/render/window.hpp"

namespace septet::render {

void add_window(vulkan::DeviceOptions& options, const Window& window) {
  std::uint32_t count = 0;
  const char** names = glfwGetRequiredInstanceExtensions(&count);
  if (!names) throw vulkan::Failure{{"the window system and Vulkan do not meet", "display", "use --virtual"}};
  options.instance_extensions.assign(names, names + count);
  auto* glfw = static_cast<GLFWwindow*>(window.handle());
  options.create_surface = [glfw](VkInstance instance) {
    VkSurfaceKHR surface = VK_NULL_HANDLE;
    vulkan::require(glfwCreateWindowSurface(instance, glfw, nullptr, &surface), "glfwCreateWindowSurface");
    return surface;
  };
}

}  // namespace septet::render
