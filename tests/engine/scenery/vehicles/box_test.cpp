/// The box by which a vehicle is hit, against what is drawn of it.

#include <algorithm>
#include <cmath>
#include <cstdint>

#include <doctest/doctest.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "engine/scenery/vehicles/cage.hpp"
#include "engine/scenery/vehicles/car_body.hpp"
#include "engine/scenery/vehicles/cockpit.hpp"
#include "engine/scenery/vehicles/vehicle_mirrors.hpp"
#include "engine/scenery/vehicles/vehicle_parts.hpp"

namespace septet::scenery {
namespace {

/// Extent in plan of all that is drawn near by, without mirrors.
struct Extent {
  Vec3 low_m{1e9}, high_m{-1e9};
};

/// True on a mirror's housing, which stands off the body.
bool is_mirror(const VehicleModel& model, const Vec3& at) {
  const double half_m = 0.5 * model.width_m;
  if (std::abs(at.y) <= half_m || model.kind == ParticipantKind::motorcycle) return false;
  // The same places as those of the glass that their drivers see, but for the buses' ears.
  if (model.kind == ParticipantKind::bus) return at.x > model.front_m() - 0.7 && at.z > 1.5;
  if (has_cockpit(model)) return std::abs(at.y) < half_m + 0.2 && at.z > car_shape(model).belt_front_m + 0.02;
  return std::ranges::any_of(vehicle_mirrors(model), [&](const VehicleMirror& mirror) {
    return glm::length(mirror.middle_m - at) < 0.6 * std::hypot(mirror.width_m, mirror.height_m) + 0.16;
  });
}

Extent drawn_extent(const VehicleModel& model) {
  Extent extent;
  for (const VehiclePart& part : vehicle_parts(model)) {
    const geometry::PolygonMesh surface = shown_surface(part.mesh, part.subdivision_level);
    for (const Placement& place : part.places) {
      if (place.visible_from_m > 0.0f) continue;
      for (const auto& corners : surface.polygons)
        for (std::uint32_t k = 0; k < geometry::corner_count(corners); ++k) {
          const Vec3 at = place.parent_from_object * (Vec3(place.scale) * Vec3(surface.vertices_m[corners[k]]));
          if (is_mirror(model, at)) continue;
          extent.low_m = glm::min(extent.low_m, at);
          extent.high_m = glm::max(extent.high_m, at);
        }
    }
  }
  return extent;
}

}  // namespace

TEST_CASE("what is drawn of a vehicle and the box by which it is hit agree to two centimetres, mirrors excepted") {
  constexpr double most_m = 0.0201;
  for (const VehicleModel& model : vehicle_models()) {
    // A walker's box has room for a stride.
    if (model.kind == ParticipantKind::pedestrian) continue;
    CAPTURE(model.name);
    const Extent drawn = drawn_extent(model);
    CHECK(std::abs(drawn.low_m.x + model.rear_overhang_m) < most_m);
    CHECK(std::abs(drawn.high_m.x - model.front_m()) < most_m);
    CHECK(std::abs(drawn.low_m.y + 0.5 * model.width_m) < most_m);
    CHECK(std::abs(drawn.high_m.y - 0.5 * model.width_m) < most_m);
  }
}

}  // namespace septet::scenery
