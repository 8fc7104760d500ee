#pragma once
/// Vulkan instance, device and its one queue.

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "engine/render/vulkan/vulkan_api.hpp"

namespace septet::render::vulkan {

/// Messages of the validation layer, which may call from any thread.
struct ValidationLog {
  std::atomic<std::uint32_t> messages{0};
  std::mutex mutex;
  std::string first;
};

struct DeviceOptions {
  bool software_only = false;
  bool validation = false;
  std::vector<const char*> instance_extensions;            ///< Extensions that a window's surface needs.
  std::function<VkSurfaceKHR(VkInstance)> create_surface;  ///< Empty: off-screen.
};

struct Device {
  VkInstance instance = VK_NULL_HANDLE;
  VkDebugUtilsMessengerEXT messenger = VK_NULL_HANDLE;
  std::unique_ptr<ValidationLog> validation_log;
  VkSurfaceKHR surface = VK_NULL_HANDLE;
  VkPhysicalDevice physical = VK_NULL_HANDLE;
  VkPhysicalDeviceProperties properties{};
  VkPhysicalDeviceMemoryProperties memory{};
  VkDevice device = VK_NULL_HANDLE;
  VkQueue queue = VK_NULL_HANDLE;
  std::uint32_t queue_family = 0;
};

/// Fills `device` step by step, so that destroy_device also clears up after a Failure half-way.
void create_device(Device& device, const DeviceOptions& options);
void destroy_device(Device& device);

}  // namespace septet::render::vulkan
