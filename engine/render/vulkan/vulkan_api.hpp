#pragma once
/// Vulkan's functions and types, and how its failures travel inside engine/render.
///
/// Only files of engine/render include this. A failed call throws Failure; Renderer's public functions catch it and
/// return an Error, so that the code between stays a straight list of Vulkan calls. Vulkan 1.3 with dynamic rendering,
/// synchronization2 and push descriptors; no descriptor indexing, which lavapipe lacks.

#include <volk.h>

#include "engine/core/expected.hpp"

namespace septet::render::vulkan {

/// Failure of a call that the device or its driver refused.
struct Failure {
  Error error;
};

/// Throws Failure unless the call succeeded; `call` names it.
void require(VkResult result, const char* call);

/// Name of the enumerator, such as "VK_ERROR_DEVICE_LOST".
const char* name_of(VkResult result);

}  // namespace septet::render::vulkan
