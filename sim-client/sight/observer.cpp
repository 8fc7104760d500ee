#include "sim-client/sight/observer.hpp"

#include <cmath>

#include <glm/geometric.hpp>

#include "engine/scenery/vehicles/eye_point.hpp"
#include "engine/scenery/vehicles/vehicle_mirrors.hpp"
#include "engine/world/participant_sight.hpp"

namespace septet::sight {
namespace {

constexpr double protruding_m = 0.3;  ///< Mirrors and limbs beyond a model's box.

Mirror mirror_of_rig(const rig::Mirror& from) {
  const rig::Window& glass = from.glass;
  const Vec3 along = glass.lower_right_m - glass.lower_left_m, upward = glass.upper_left_m - glass.lower_left_m;
  return {from.name,
          0.5 * (glass.lower_right_m + glass.upper_left_m),
          glm::normalize(along),
          glm::normalize(upward),
          0.5 * glm::length(along),
          0.5 * glm::length(upward),
          from.radius_m};
}

std::string name_of(const scenery::VehicleMirror& mirror) {
  constexpr double inside_m = 0.3;
  if (std::abs(mirror.middle_m.y) < inside_m) return "inner mirror";
  return mirror.middle_m.y > 0.0 ? "left mirror" : "right mirror";
}

}  // namespace

Vec3 Mirror::normal() const { return glm::cross(right, up); }

Vec3 Mirror::normal_at(double across_m, double upward_m) const {
  if (!(radius_m > 0.0)) return normal();
  return glm::normalize(radius_m * normal() + across_m * right + upward_m * up);
}

Vec3 eye_in_vehicle(const Participant& observer, const Snapshot& world, const DriverSeat& seat) {
  if (observer.id == world.driver_car.participant) return seat.eye_m + world.driver_car.head.from_rest_m;
  return scenery::eye_in(vehicle_models()[observer.model]);
}

std::vector<Mirror> mirrors_of(const Participant& observer, const Snapshot& world, const DriverSeat& seat) {
  std::vector<Mirror> mirrors;
  if (observer.id == world.driver_car.participant && seat.rig)
    for (const rig::Mirror& mirror : seat.rig->mirrors) mirrors.push_back(mirror_of_rig(mirror));
  else
    for (const scenery::VehicleMirror& mirror : scenery::vehicle_mirrors(vehicle_models()[observer.model]))
      mirrors.push_back({name_of(mirror), mirror.middle_m, mirror.right, mirror.up(), 0.5 * mirror.width_m,
                         0.5 * mirror.height_m, mirror.radius_m});
  return mirrors;
}

Box box_around(const Participant& participant) {
  Box box = box_of(participant);
  box.half_m += protruding_m;
  return box;
}

}  // namespace septet::sight
