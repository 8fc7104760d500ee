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

/// Extent of what is drawn near by.
struct Extent {
  Vec3 low_m{1e9}, high_m{-1e9};
  void add(const Vec3& at) { low_m = glm::min(low_m, at), high_m = glm::max(high_m, at); }
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

/// True for a taxi's sign and a police car's bar of blue lamps. They are no part of the box, whose top is the roof: by
/// its height the front of a car that hits somebody is reckoned, which is that of cars without them. Higher vehicles
/// carry their lamps within their box.
bool stands_on_roof(const VehicleModel& model, const VehiclePart& part) {
  return model.kind == ParticipantKind::car && (part.name == "taxi sign near" || part.name == "beacon near");
}

struct DrawnExtent {
  Extent body, on_roof;  ///< Without mirrors, and without what stands on a car's roof; the latter alone.
};

DrawnExtent drawn_extent(const VehicleModel& model) {
  DrawnExtent extent;
  for (const VehiclePart& part : vehicle_parts(model)) {
    Extent& of_part = stands_on_roof(model, part) ? extent.on_roof : extent.body;
    const geometry::PolygonMesh surface = shown_surface(part.mesh, part.subdivision_level);
    for (const Placement& place : part.places) {
      if (place.visible_from_m > 0.0f) continue;
      for (const auto& corners : surface.polygons)
        for (std::uint32_t k = 0; k < geometry::corner_count(corners); ++k) {
          const Vec3 at = place.parent_from_object * (Vec3(place.scale) * Vec3(surface.vertices_m[corners[k]]));
          if (is_mirror(model, at)) continue;
          of_part.add(at);
        }
    }
  }
  return extent;
}

}  // namespace

TEST_CASE(
    "what is drawn of a vehicle and the box by which it is hit agree to two centimetres in length, width and height, "
    "mirrors and what stands on a car's roof excepted") {
  constexpr double most_m = 0.0201, most_on_roof_m = 0.12;
  for (const VehicleModel& model : vehicle_models()) {
    // A walker's box has room for a stride.
    if (model.kind == ParticipantKind::pedestrian) continue;
    CAPTURE(model.name);
    const auto [drawn, on_roof] = drawn_extent(model);
    CHECK(std::abs(drawn.low_m.x + model.rear_overhang_m) < most_m);
    CHECK(std::abs(drawn.high_m.x - model.front_m()) < most_m);
    CHECK(std::abs(drawn.low_m.y + 0.5 * model.width_m) < most_m);
    CHECK(std::abs(drawn.high_m.y - 0.5 * model.width_m) < most_m);
    CHECK(std::abs(drawn.low_m.z) < most_m);
    CHECK(std::abs(drawn.high_m.z - model.height_m) < most_m);
    CHECK(on_roof.high_m.z - model.height_m < most_on_roof_m);
  }
}

}  // namespace septet::scenery
