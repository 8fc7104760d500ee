#pragma once
/// Stripes thinner than a pixel: edge data in their vertices by which shaders/surface.vert draws them wide enough.

#include <cstdint>
#include <span>

#include "engine/scene/resolved_scene.hpp"

namespace septet::render {

/// Rewrites the vertices used by the triangles of a stripe (SurfaceMaterial::stripe): the normal becomes the vector
/// from the stripe's middle to that edge, and uv.y its climb per metre along the stripe, to the left of the direction
/// from the edge of u = 0 to that of u = 1. Opposite corners have the same v. A vertex belongs to one stripe.
void find_stripe_edges(std::span<scene::SurfaceVertex> vertices, std::span<const std::uint32_t> triangles);

}  // namespace septet::render
