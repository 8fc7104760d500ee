/// Features of vehicles from afar: their outlines, drawn here in a few thousand pixels.

#include <algorithm>
#include <bitset>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include <doctest/doctest.h>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "engine/scenery/vehicles/cage.hpp"
#include "engine/scenery/vehicles/vehicle_parts.hpp"

namespace septet::scenery {
namespace {

constexpr int columns = 180, rows = 46;
constexpr float pixel_m = 0.1f, rear_m = -5.0f;
using Outline = std::bitset<std::size_t{columns} * rows>;

void fill(Outline& outline, glm::vec2 a, glm::vec2 b, glm::vec2 c) {
  const auto cross = [](glm::vec2 u, glm::vec2 v) { return u.x * v.y - u.y * v.x; };
  if (cross(b - a, c - a) < 0.0f) std::swap(b, c);
  const auto pixel = [](float at) { return static_cast<int>(std::floor(at)); };
  for (int z = std::max(0, pixel(std::min({a.y, b.y, c.y}))); z <= std::min(rows - 1, pixel(std::max({a.y, b.y, c.y})));
       ++z)
    for (int x = std::max(0, pixel(std::min({a.x, b.x, c.x})));
         x <= std::min(columns - 1, pixel(std::max({a.x, b.x, c.x}))); ++x) {
      const glm::vec2 p(static_cast<float>(x) + 0.5f, static_cast<float>(z) + 0.5f);
      if (cross(b - a, p - a) >= 0.0f && cross(c - b, p - b) >= 0.0f && cross(a - c, p - c) >= 0.0f)
        outline.set(static_cast<std::size_t>(z) * columns + static_cast<std::size_t>(x));
    }
}

/// Outline from the side, as drawn at this distance.
Outline outline_of(const VehicleModel& model, float distance_m) {
  Outline outline;
  for (const VehiclePart& part : vehicle_parts(model)) {
    const auto seen = [&](const Placement& place) {
      return distance_m >= place.visible_from_m && distance_m < place.visible_to_m;
    };
    if (std::none_of(part.places.begin(), part.places.end(), seen)) continue;
    const geometry::PolygonMesh surface = shown_surface(part.mesh, part.subdivision_level);
    for (const Placement& place : part.places) {
      if (!seen(place)) continue;
      const auto flat = [&](std::uint32_t vertex) {
        const glm::vec3 at = glm::vec3(place.parent_from_object.position_m) + place.scale * surface.vertices_m[vertex];
        return glm::vec2((at.x - rear_m) / pixel_m, at.z / pixel_m);
      };
      for (const auto& corners : surface.polygons)
        for (std::uint32_t k = 1; k + 1 < geometry::corner_count(corners); ++k)
          fill(outline, flat(corners[0]), flat(corners[k]), flat(corners[k + 1]));
    }
  }
  return outline;
}

}  // namespace

TEST_CASE("more than twenty vehicles have outlines of their own, near and far") {
  for (const float distance_m : {80.0f, 400.0f}) {
    CAPTURE(distance_m);
    std::vector<Outline> distinct;
    for (const VehicleModel& model : vehicle_models()) {
      const Outline outline = outline_of(model, distance_m);
      REQUIRE(outline.any());
      const auto like = [&](const Outline& other) {
        return (outline ^ other).count() * 12 < (outline | other).count();
      };
      if (std::none_of(distinct.begin(), distinct.end(), like)) distinct.push_back(outline);
    }
    MESSAGE(distinct.size(), " outlines differ by a twelfth and more");
    CHECK(distinct.size() > 20);
  }
}

TEST_CASE("a vehicle keeps its outline from one level of detail to the next") {
  for (const VehicleModel& model : vehicle_models()) {
    if (model.track_m < 1.0) continue;  // Far off, riders and pedestrians are a few pixels.
    CAPTURE(model.name);
    const Outline near = outline_of(model, 10.0f), middle = outline_of(model, 80.0f), far = outline_of(model, 400.0f);
    CHECK((near & middle).count() > 0.9 * static_cast<double>((near | middle).count()));
    CHECK((middle & far).count() > 0.8 * static_cast<double>((middle | far).count()));
  }
}

}  // namespace septet::scenery
