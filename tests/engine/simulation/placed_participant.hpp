#pragma once
/// A vehicle put somewhere, as a collision finds it; and two of them that meet.

#include <string_view>

#include <glm/geometric.hpp>

#include "engine/simulation/effects/body_box.hpp"
#include "engine/simulation/effects/crashes.hpp"
#include "engine/world/snapshot.hpp"
#include "engine/world/vehicle_body.hpp"
#include "engine/world/vehicle_model.hpp"

namespace septet::simulation {

/// Of this model, its rear axle at (x, y) of the world, driving the way that it looks.
inline Participant placed_participant(ParticipantId id, std::string_view model, double x_m, double y_m,
                                      double heading_rad, double speed_mps) {
  Participant p;
  p.id = id;
  p.model = *find_vehicle_model(model);
  p.world_from_vehicle = {{x_m, y_m, 0.0}, orientation_from_angles(heading_rad, 0.0, 0.0)};
  p.velocity_mps = p.world_from_vehicle.orientation * Vec3(speed_mps, 0.0, 0.0);
  return p;
}

/// What the effects are told of a car that has run into another, with the masses of their kinds. They must overlap.
inline VehicleCrash struck(const Participant& car, const Participant& other) {
  const auto contact = contact_of(body_box(car), body_box(other)).value();
  const auto kind_kg = [](const Participant& p) { return vehicle_body(vehicle_models()[p.model].kind).mass_kg; };
  const auto crashed = [&](const Participant& p) {
    return CrashedVehicle{p.id, kind_kg(p), p.velocity_mps, p.angular_velocity_radps};
  };
  return {crashed(car), crashed(other), contact.point_m, contact.normal,
          -glm::dot(car.velocity_mps - other.velocity_mps, contact.normal)};
}

}  // namespace septet::simulation
