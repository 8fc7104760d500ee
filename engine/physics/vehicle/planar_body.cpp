#include "engine/physics/vehicle/planar_body.hpp"

#include <glm/geometric.hpp>

namespace septet::vehicle {

impact::Body planar_body(const BodyParameters& body, const VehicleState& state) {
  impact::Body planar;
  planar.mass_kg = body.mass_kg;
  planar.yaw_inertia_kgm2 = body.inertia_kgm2.z;
  planar.mass_centre_m = Vec2(state.world_from_body.position_m);
  planar.velocity_mps = Vec2(state.velocity_mps);
  planar.yaw_rate_radps = (state.world_from_body.orientation * state.angular_velocity_radps).z;
  return planar;
}

void take_over(const impact::Body& before, const impact::Body& after, double dt_s, VehicleState& state) {
  const Vec3 up(0.0, 0.0, 1.0);
  const Vec3 change(after.velocity_mps - before.velocity_mps, 0.0);
  const Vec3 turn =
      glm::conjugate(state.world_from_body.orientation) * ((after.yaw_rate_radps - before.yaw_rate_radps) * up);
  state.velocity_mps += change;
  state.angular_velocity_radps += turn;
  state.acceleration_mps2 += change / dt_s;
  state.whole_acceleration_mps2 += change / dt_s;
  state.angular_acceleration_radps2 += turn / dt_s;
  state.world_from_body.position_m += Vec3(after.mass_centre_m - before.mass_centre_m, 0.0);
  state.world_from_body.orientation =
      glm::normalize(glm::angleAxis(after.heading_rad - before.heading_rad, up) * state.world_from_body.orientation);
}

}  // namespace septet::vehicle
