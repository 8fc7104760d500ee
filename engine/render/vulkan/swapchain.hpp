#pragma once
/// Images of a window: acquired, filled by a scaled copy of the finished picture, presented.

#include <optional>
#include <vector>

#include "engine/render/vulkan/memory.hpp"

namespace septet::render::vulkan {

struct Swapchain {
  VkSwapchainKHR swapchain = VK_NULL_HANDLE;
  VkExtent2D extent{};
  std::vector<VkImage> images;
  std::vector<VkSemaphore> finished;  ///< One an image: drawn, ready to present.
  bool stale = true;                  ///< True after the window has changed: renew the swapchain.
};

/// Recreates the images for a window of this size; does nothing while the window has no area. No frame may be in
/// flight.
void renew_swapchain(Swapchain& swapchain, const Device& device, std::uint32_t width, std::uint32_t height);
void destroy_swapchain(Swapchain& swapchain, const Device& device);

/// Index of the next image; empty if there is none now (minimised, resized).
std::optional<std::uint32_t> acquire(Swapchain& swapchain, const Device& device, VkSemaphore acquired);
void present(Swapchain& swapchain, const Device& device, std::uint32_t index);

/// Copies the picture, a transfer source, into the window's image, a transfer destination, scaled as far as its shape
/// allows, with black bars beside it.
void record_copy(VkCommandBuffer commands, const DeviceImage& picture, const Swapchain& swapchain, std::uint32_t index);

}  // namespace septet::render::vulkan
