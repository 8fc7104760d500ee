#include "engine/render/vulkan/swapchain.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace septet::render::vulkan {
namespace {

/// Format that takes the picture's codes unchanged, shown as sRGB.
VkSurfaceFormatKHR choose_format(const Device& device) {
  std::uint32_t count = 0;
  require(vkGetPhysicalDeviceSurfaceFormatsKHR(device.physical, device.surface, &count, nullptr),
          "vkGetPhysicalDeviceSurfaceFormatsKHR");
  std::vector<VkSurfaceFormatKHR> formats(count);
  vkGetPhysicalDeviceSurfaceFormatsKHR(device.physical, device.surface, &count, formats.data());
  for (const VkFormat wanted : {VK_FORMAT_B8G8R8A8_UNORM, VK_FORMAT_R8G8B8A8_UNORM})
    for (const VkSurfaceFormatKHR& format : formats)
      if (format.format == wanted && format.colorSpace == VK_COLOR_SPACE_SRGB_NONLINEAR_KHR) return format;
  throw Failure{{"the display takes no sRGB picture", "display", "use another display or driver"}};
}

/// Mode that shows each picture at the next refresh, the newest if the display allows it.
VkPresentModeKHR choose_mode(const Device& device) {
  std::uint32_t count = 0;
  vkGetPhysicalDeviceSurfacePresentModesKHR(device.physical, device.surface, &count, nullptr);
  std::vector<VkPresentModeKHR> modes(count);
  vkGetPhysicalDeviceSurfacePresentModesKHR(device.physical, device.surface, &count, modes.data());
  const bool mailbox = std::find(modes.begin(), modes.end(), VK_PRESENT_MODE_MAILBOX_KHR) != modes.end();
  return mailbox ? VK_PRESENT_MODE_MAILBOX_KHR : VK_PRESENT_MODE_FIFO_KHR;
}

}  // namespace

void renew_swapchain(Swapchain& swapchain, const Device& device, std::uint32_t width, std::uint32_t height) {
  VkSurfaceCapabilitiesKHR capabilities;
  require(vkGetPhysicalDeviceSurfaceCapabilitiesKHR(device.physical, device.surface, &capabilities),
          "vkGetPhysicalDeviceSurfaceCapabilitiesKHR");
  VkExtent2D extent = capabilities.currentExtent;
  if (extent.width == UINT32_MAX)
    extent = {std::clamp(width, capabilities.minImageExtent.width, capabilities.maxImageExtent.width),
              std::clamp(height, capabilities.minImageExtent.height, capabilities.maxImageExtent.height)};
  if (extent.width == 0 || extent.height == 0) return;
  const VkSurfaceFormatKHR format = choose_format(device);
  VkSwapchainCreateInfoKHR info{VK_STRUCTURE_TYPE_SWAPCHAIN_CREATE_INFO_KHR};
  info.surface = device.surface;
  info.minImageCount = std::max(capabilities.minImageCount, 3u);
  if (capabilities.maxImageCount > 0) info.minImageCount = std::min(info.minImageCount, capabilities.maxImageCount);
  info.imageFormat = format.format;
  info.imageColorSpace = format.colorSpace;
  info.imageExtent = extent;
  info.imageArrayLayers = 1;
  info.imageUsage = VK_IMAGE_USAGE_TRANSFER_DST_BIT;
  info.preTransform = capabilities.currentTransform;
  info.compositeAlpha = VK_COMPOSITE_ALPHA_OPAQUE_BIT_KHR;
  info.presentMode = choose_mode(device);
  info.clipped = VK_TRUE;
  info.oldSwapchain = swapchain.swapchain;
  VkSwapchainKHR made = VK_NULL_HANDLE;
  require(vkCreateSwapchainKHR(device.device, &info, nullptr, &made), "vkCreateSwapchainKHR");
  destroy_swapchain(swapchain, device);
  swapchain.swapchain = made;
  swapchain.extent = extent;
  std::uint32_t count = 0;
  vkGetSwapchainImagesKHR(device.device, made, &count, nullptr);
  swapchain.images.resize(count);
  vkGetSwapchainImagesKHR(device.device, made, &count, swapchain.images.data());
  for (std::uint32_t i = 0; i < count; ++i) {
    const VkSemaphoreCreateInfo semaphore{VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO};
    VkSemaphore finished = VK_NULL_HANDLE;
    require(vkCreateSemaphore(device.device, &semaphore, nullptr, &finished), "vkCreateSemaphore");
    swapchain.finished.push_back(finished);
  }
  swapchain.stale = false;
}

void destroy_swapchain(Swapchain& swapchain, const Device& device) {
  for (const VkSemaphore finished : swapchain.finished) vkDestroySemaphore(device.device, finished, nullptr);
  if (swapchain.swapchain) vkDestroySwapchainKHR(device.device, swapchain.swapchain, nullptr);
  swapchain = {};
}

std::optional<std::uint32_t> acquire(Swapchain& swapchain, const Device& device, VkSemaphore acquired) {
  if (!swapchain.swapchain) return std::nullopt;
  std::uint32_t index = 0;
  const VkResult result =
      vkAcquireNextImageKHR(device.device, swapchain.swapchain, UINT64_MAX, acquired, VK_NULL_HANDLE, &index);
  if (result == VK_ERROR_OUT_OF_DATE_KHR) {
    swapchain.stale = true;
    return std::nullopt;
  }
  if (result == VK_SUBOPTIMAL_KHR)
    swapchain.stale = true;
  else
    require(result, "vkAcquireNextImageKHR");
  return index;
}

void present(Swapchain& swapchain, const Device& device, std::uint32_t index) {
  VkPresentInfoKHR info{VK_STRUCTURE_TYPE_PRESENT_INFO_KHR};
  info.waitSemaphoreCount = 1;
  info.pWaitSemaphores = &swapchain.finished[index];
  info.swapchainCount = 1;
  info.pSwapchains = &swapchain.swapchain;
  info.pImageIndices = &index;
  const VkResult result = vkQueuePresentKHR(device.queue, &info);
  if (result == VK_ERROR_OUT_OF_DATE_KHR || result == VK_SUBOPTIMAL_KHR)
    swapchain.stale = true;
  else
    require(result, "vkQueuePresentKHR");
}

void record_copy(VkCommandBuffer commands, const DeviceImage& picture, const Swapchain& swapchain,
                 std::uint32_t index) {
  const VkExtent2D whole = swapchain.extent;
  const double scale =
      std::min(double(whole.width) / picture.description.width, double(whole.height) / picture.description.height);
  const auto fitted = [scale](std::uint32_t size_px, std::uint32_t room_px) {
    return std::min(room_px, static_cast<std::uint32_t>(std::lround(scale * size_px)));
  };
  const std::uint32_t width = fitted(picture.description.width, whole.width),
                      height = fitted(picture.description.height, whole.height);
  if (width < whole.width || height < whole.height) {
    const VkClearColorValue black{{0.0f, 0.0f, 0.0f, 1.0f}};
    const VkImageSubresourceRange all{VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
    vkCmdClearColorImage(commands, swapchain.images[index], VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, &black, 1, &all);
    VkMemoryBarrier2 cleared{VK_STRUCTURE_TYPE_MEMORY_BARRIER_2};
    cleared.srcStageMask = cleared.dstStageMask = VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT;
    cleared.srcAccessMask = cleared.dstAccessMask = VK_ACCESS_2_TRANSFER_WRITE_BIT;
    VkDependencyInfo before{VK_STRUCTURE_TYPE_DEPENDENCY_INFO};
    before.memoryBarrierCount = 1;
    before.pMemoryBarriers = &cleared;
    vkCmdPipelineBarrier2(commands, &before);
  }
  const auto left = static_cast<std::int32_t>((whole.width - width) / 2),
             top = static_cast<std::int32_t>((whole.height - height) / 2);
  VkImageBlit2 region{VK_STRUCTURE_TYPE_IMAGE_BLIT_2};
  region.srcSubresource = region.dstSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
  region.srcOffsets[1] = {static_cast<std::int32_t>(picture.description.width),
                          static_cast<std::int32_t>(picture.description.height), 1};
  region.dstOffsets[0] = {left, top, 0};
  region.dstOffsets[1] = {left + static_cast<std::int32_t>(width), top + static_cast<std::int32_t>(height), 1};
  VkBlitImageInfo2 info{VK_STRUCTURE_TYPE_BLIT_IMAGE_INFO_2};
  info.srcImage = picture.image;
  info.srcImageLayout = VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL;
  info.dstImage = swapchain.images[index];
  info.dstImageLayout = VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL;
  info.regionCount = 1;
  info.pRegions = &region;
  info.filter = VK_FILTER_LINEAR;
  vkCmdBlitImage2(commands, &info);
}

}  // namespace septet::render::vulkan
