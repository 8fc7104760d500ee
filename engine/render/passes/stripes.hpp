#pragma once
/// Stripes that are thinner than a pixel: what their vertices say so that shaders/surface.vert can draw them wide enough.

#include <cstdint>
#include <span>

#include "engine/scene/resolved_scene.hpp"

namespace septet::render {

/// Of the vertices that triangles of a stripe use (SurfaceMaterial::stripe), the normal becomes the way from the stripe's middle to that edge, and
/// uv.y how much it climbs, per metre along it: to the left of the way from the edge of u = 0 to that of u = 1. Corners across from one another have
/// one v. A vertex belongs to one stripe.
void find_stripe_edges(std::span<scene::SurfaceVertex> vertices, std::span<const std::uint32_t> triangles);

}  // namespace septet::render
