#pragma once
/// Joins a window to Vulkan; apart from window.cpp so that windows know no Vulkan.

#include "engine/render/vulkan/device.hpp"

namespace septet::render {

class Window;

/// What the device needs to present into the window.
void add_window(vulkan::DeviceOptions& options, const Window& window);

}  // namespace septet::render
