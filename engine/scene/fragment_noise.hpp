#pragma once
/// Noise of a material's noise fragment: the same at the same place on every machine.
///
/// Perlin's gradient noise (Perlin 2002, "Improving Noise", SIGGRAPH) on the lattice of whole numbers, with the twelve
/// gradients of the paper chosen by a hash in place of its table; it is 0 at the lattice's corners. Point noise has one
/// even value in each cell of the lattice. Pure functions; any thread.

#include <glm/vec3.hpp>

#include "engine/scene/material_fragment.hpp"

namespace septet::scene {

/// From 0 to 1 or from −1 to 1, as the kind says. Places beyond ±1e6 are taken at these.
float noise_at(NoiseKind kind, const glm::vec3& place);

}  // namespace septet::scene
