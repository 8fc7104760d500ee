#pragma once
/// A vehicle put somewhere, as a collision finds it.

#include <string_view>

#include "engine/world/snapshot.hpp"
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

}  // namespace septet::simulation
