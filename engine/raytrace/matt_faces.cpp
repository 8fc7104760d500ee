/// Choice of a World's matt faces, and the conditions under which it has any.

#include "engine/raytrace/matt_faces.hpp"

#include <algorithm>

#include <glm/geometric.hpp>

#include "engine/raytrace/world.hpp"

namespace septet::raytrace {
namespace {

constexpr float same_way = 1.0f - 1e-6f;  ///< Cosine between normals that count as equal.

bool stands_in_one_color(const Lamp& lamp) { return !lamp.textured && !lamp.spreads && lamp.way_m == glm::vec3(0.0f); }

}  // namespace

Face World::matt_face(const PlacedSurface& placed, std::uint32_t triangle) const {
  const scene::SurfaceMaterial& material = material_of(placed, triangle);
  if (&material == &no_material_ || !index_.plain[static_cast<std::size_t>(&material - scene_.materials.data())])
    return {};
  const Corners at = corners(placed, triangle);
  const glm::vec3 a = at.a->position_m, second = at.b->position_m - a, third = at.c->position_m - a;
  const glm::vec3 across = glm::cross(second, third);
  const float area = glm::length(across);
  if (!(area > 0.0f)) return {};
  for (const scene::SurfaceVertex* corner : {at.a, at.b, at.c})
    if (corner->color != scene::white_vertex ||
        !(glm::dot(corner->normal, across) > same_way * area * glm::length(corner->normal)))
      return {};
  return {placed.origin_m + placed.turned(a),
          placed.turned(second),
          placed.turned(third),
          glm::normalize(placed.is_turned ? placed.normal_turn * across : across),
          material.base_color * (material.takes_paint ? glm::vec3(placed.tint) : glm::vec3(1.0f)),
          shows_back(material) ? Face::both_sides : Face::front_side};
}

void World::add_matt_faces() {
  if (!lamps_alone_shine_ || !nothing_lies_on_it_ || !smoke_.empty() || fog_per_m() > 0.0f ||
      !std::ranges::all_of(lamps_, stands_in_one_color))
    return;
  MattFaces& all = matt_faces_.emplace();
  for (const PlacedSurface& placed : placed_) {
    const bool moves = placed.motion || !placed.later.empty();
    all.first_of_place.push_back(moves || placed.body ? MattFaces::none : static_cast<std::uint32_t>(all.faces.size()));
    if (all.first_of_place.back() == MattFaces::none) continue;
    for (std::uint32_t triangle = 0; triangle < placed.indices.size() / 3; ++triangle)
      all.faces.push_back(matt_face(placed, triangle));
  }
  for (const Lamp& lamp : lamps_) {
    all.first_of_lamp.push_back(static_cast<std::uint32_t>(all.lamps.size()));
    for (const LampTriangle& triangle : lamp.triangles)
      all.lamps.push_back(
          {triangle.corner_m, triangle.second, triangle.third, triangle.normal, lamp.emission, lamp.area_m2});
  }
}

}  // namespace septet::raytrace
