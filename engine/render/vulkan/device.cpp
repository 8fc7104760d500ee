#include "engine/render/vulkan/device.hpp"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <optional>

namespace septet::render::vulkan {
namespace {

constexpr const char* validation_layer = "VK_LAYER_KHRONOS_validation";

VKAPI_ATTR VkBool32 VKAPI_CALL on_validation_message(VkDebugUtilsMessageSeverityFlagBitsEXT,
                                                     VkDebugUtilsMessageTypeFlagsEXT,
                                                     const VkDebugUtilsMessengerCallbackDataEXT* data, void* user) {
  auto& log = *static_cast<ValidationLog*>(user);
  if (log.messages.fetch_add(1) == 0) {
    const std::lock_guard lock(log.mutex);
    log.first = data->pMessage;
  }
  return VK_FALSE;
}

VkDebugUtilsMessengerCreateInfoEXT messenger_info(ValidationLog& log) {
  VkDebugUtilsMessengerCreateInfoEXT info{VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT};
  info.messageSeverity =
      VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
  info.messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_TYPE_PERFORMANCE_BIT_EXT;
  info.pfnUserCallback = on_validation_message;
  info.pUserData = &log;
  return info;
}

bool has_validation_layer() {
  std::uint32_t count = 0;
  vkEnumerateInstanceLayerProperties(&count, nullptr);
  std::vector<VkLayerProperties> layers(count);
  vkEnumerateInstanceLayerProperties(&count, layers.data());
  return std::any_of(layers.begin(), layers.end(), [](const VkLayerProperties& layer) {
    return std::strcmp(layer.layerName, validation_layer) == 0;
  });
}

void create_instance(Device& device, const DeviceOptions& options) {
  if (volkInitialize() != VK_SUCCESS)
    throw Failure{{"the Vulkan loader was not found", "libvulkan.so.1", "install libvulkan1 and mesa-vulkan-drivers"}};
  std::vector<const char*> extensions = options.instance_extensions;
  VkApplicationInfo application{VK_STRUCTURE_TYPE_APPLICATION_INFO};
  application.pApplicationName = "Septet";
  application.apiVersion = VK_API_VERSION_1_3;
  VkInstanceCreateInfo info{VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO};
  info.pApplicationInfo = &application;
  VkDebugUtilsMessengerCreateInfoEXT messenger{};
  if (options.validation) {
    if (!has_validation_layer())
      throw Failure{{"the validation layer is not installed", validation_layer, "install vulkan-validationlayers"}};
    device.validation_log = std::make_unique<ValidationLog>();
    messenger = messenger_info(*device.validation_log);
    info.pNext = &messenger;
    info.enabledLayerCount = 1;
    info.ppEnabledLayerNames = &validation_layer;
    extensions.push_back(VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
  }
  info.enabledExtensionCount = static_cast<std::uint32_t>(extensions.size());
  info.ppEnabledExtensionNames = extensions.data();
  require(vkCreateInstance(&info, nullptr, &device.instance), "vkCreateInstance");
  // Device functions go through the loader, so that several renderers may live in one process.
  volkLoadInstance(device.instance);
  if (options.validation) {
    messenger.pNext = nullptr;
    require(vkCreateDebugUtilsMessengerEXT(device.instance, &messenger, nullptr, &device.messenger),
            "vkCreateDebugUtilsMessengerEXT");
  }
}

bool has_extension(VkPhysicalDevice physical, const char* name) {
  std::uint32_t count = 0;
  vkEnumerateDeviceExtensionProperties(physical, nullptr, &count, nullptr);
  std::vector<VkExtensionProperties> extensions(count);
  vkEnumerateDeviceExtensionProperties(physical, nullptr, &count, extensions.data());
  return std::any_of(extensions.begin(), extensions.end(),
                     [&](const VkExtensionProperties& e) { return std::strcmp(e.extensionName, name) == 0; });
}

std::optional<std::uint32_t> graphics_queue(VkPhysicalDevice physical, VkSurfaceKHR surface) {
  std::uint32_t count = 0;
  vkGetPhysicalDeviceQueueFamilyProperties(physical, &count, nullptr);
  std::vector<VkQueueFamilyProperties> families(count);
  vkGetPhysicalDeviceQueueFamilyProperties(physical, &count, families.data());
  for (std::uint32_t i = 0; i < count; ++i) {
    if (!(families[i].queueFlags & VK_QUEUE_GRAPHICS_BIT)) continue;
    VkBool32 presents = VK_TRUE;
    if (surface) vkGetPhysicalDeviceSurfaceSupportKHR(physical, i, surface, &presents);
    if (presents) return i;
  }
  return std::nullopt;
}

/// Rank of a device: higher is better; 0 is unusable.
int rank(VkPhysicalDevice physical, const VkPhysicalDeviceProperties& properties, const Device& device,
         const DeviceOptions& options) {
  if (properties.apiVersion < VK_API_VERSION_1_3) return 0;
  if (!has_extension(physical, VK_KHR_PUSH_DESCRIPTOR_EXTENSION_NAME)) return 0;
  if (device.surface && !has_extension(physical, VK_KHR_SWAPCHAIN_EXTENSION_NAME)) return 0;
  if (!graphics_queue(physical, device.surface)) return 0;
  if (options.software_only && properties.deviceType != VK_PHYSICAL_DEVICE_TYPE_CPU) return 0;
  switch (properties.deviceType) {
    case VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU:
      return 4;
    case VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU:
      return 3;
    case VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU:
      return 2;
    default:
      return 1;
  }
}

void choose_physical_device(Device& device, const DeviceOptions& options) {
  std::uint32_t count = 0;
  vkEnumeratePhysicalDevices(device.instance, &count, nullptr);
  std::vector<VkPhysicalDevice> candidates(count);
  vkEnumeratePhysicalDevices(device.instance, &count, candidates.data());
  int best = 0;
  for (const VkPhysicalDevice candidate : candidates) {
    VkPhysicalDeviceProperties properties;
    vkGetPhysicalDeviceProperties(candidate, &properties);
    const int candidate_rank = rank(candidate, properties, device, options);
    if (candidate_rank <= best) continue;
    best = candidate_rank;
    device.physical = candidate;
    device.properties = properties;
  }
  if (best == 0)
    throw Failure{{"no device has Vulkan 1.3 with push descriptors and what the picture needs", "Vulkan devices",
                   "install mesa-vulkan-drivers (lavapipe), or a newer driver of the graphics card"}};
  vkGetPhysicalDeviceMemoryProperties(device.physical, &device.memory);
  device.queue_family = *graphics_queue(device.physical, device.surface);
}

void create_logical_device(Device& device) {
  VkPhysicalDeviceVulkan13Features features13{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES};
  features13.dynamicRendering = VK_TRUE;
  features13.synchronization2 = VK_TRUE;
  VkPhysicalDeviceVulkan12Features features12{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES, &features13};
  features12.timelineSemaphore = VK_TRUE;
  VkPhysicalDeviceFeatures2 features{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2, &features12};
  features.features.samplerAnisotropy = VK_TRUE;
  features.features.depthClamp = VK_TRUE;

  std::vector<const char*> extensions{VK_KHR_PUSH_DESCRIPTOR_EXTENSION_NAME};
  if (device.surface) extensions.push_back(VK_KHR_SWAPCHAIN_EXTENSION_NAME);
  const float priority = 1.0f;
  VkDeviceQueueCreateInfo queue{VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO};
  queue.queueFamilyIndex = device.queue_family;
  queue.queueCount = 1;
  queue.pQueuePriorities = &priority;
  VkDeviceCreateInfo info{VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO, &features};
  info.queueCreateInfoCount = 1;
  info.pQueueCreateInfos = &queue;
  info.enabledExtensionCount = static_cast<std::uint32_t>(extensions.size());
  info.ppEnabledExtensionNames = extensions.data();
  require(vkCreateDevice(device.physical, &info, nullptr, &device.device), "vkCreateDevice");
  vkGetDeviceQueue(device.device, device.queue_family, 0, &device.queue);
}

}  // namespace

void create_device(Device& device, const DeviceOptions& options) {
  create_instance(device, options);
  if (options.create_surface) device.surface = options.create_surface(device.instance);
  choose_physical_device(device, options);
  create_logical_device(device);
}

void destroy_device(Device& device) {
  if (device.device) vkDestroyDevice(device.device, nullptr);
  if (device.surface) vkDestroySurfaceKHR(device.instance, device.surface, nullptr);
  if (device.messenger) vkDestroyDebugUtilsMessengerEXT(device.instance, device.messenger, nullptr);
  if (device.instance) vkDestroyInstance(device.instance, nullptr);
  device = Device{};
}

}  // namespace septet::render::vulkan
