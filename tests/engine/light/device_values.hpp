#pragma once
/// Runs every_function.comp on the software device.

#include <cstddef>
#include <span>
#include <vector>

#include <glm/vec4.hpp>

namespace septet::light {

/// Two vectors a point; their number is a multiple of 50. Returns the values of each function at all points, one
/// function after the other. Throws vulkan's Failure where there is no device.
std::vector<glm::vec4> values_on_device(std::span<const glm::vec4> points, std::size_t functions);

}  // namespace septet::light
