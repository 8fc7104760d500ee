#pragma once
/// Emission of materials as lamps for other surfaces: where an image colours it, its mean over the image.

#include <vector>

#include <glm/vec3.hpp>

#include "engine/scene/resolved_scene.hpp"

namespace septet::instant {

/// By material of the scene. Costs nothing for materials without an image of their emission.
std::vector<glm::vec3> mean_emissions(const scene::ResolvedScene& scene);

}  // namespace septet::instant
