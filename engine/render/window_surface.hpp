#pragma once
/// Joins a window to Vulkan; a file apart from window.cpp, so that windows know no Vulkan.

#include "engine/render/vulkan/device.hpp"

namespace septet::render {

class Window;

/// Device options for presenting into the window.
void add_window(vulkan::DeviceOptions& options, const Window& window);

}  // namespace septet::render
