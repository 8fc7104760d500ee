#include "engine/simulation/effects/body_box.hpp"

#include <glm/geometric.hpp>

#include "engine/world/participant_shape.hpp"
#include "engine/world/vehicle_body.hpp"

namespace septet::simulation {
debris::Box body_box(const Participant& participant) {
  const VehicleModel model = shape_of(participant);
  const double low = vehicle_body(model.kind).clearance_m, high = model.height_m;
  const Vec3 centre(model.centre_x_m(), 0.0, middle_height_m(model));
  const Vec3 arm = participant.world_from_vehicle.orientation * centre;
  debris::Box box;
  box.world_from_box = {participant.world_from_vehicle.position_m + arm, participant.world_from_vehicle.orientation};
  box.half_size_m = {0.5 * model.length_m, 0.5 * model.width_m, 0.5 * (high - low)};
  if (const auto slope = front_slope(model.kind)) {
    const double rise = (1.0 - slope->edge_height) * model.height_m, run = slope->roof_begins * model.length_m;
    const Vec3 normal = glm::normalize(Vec3(rise, 0.0, run));
    const Vec3 roof_begins(box.half_size_m.x - run, 0.0, box.half_size_m.z);
    box.cuts.push_back({normal, glm::dot(normal, roof_begins)});
  }
  box.velocity_mps = participant.velocity_mps + glm::cross(participant.angular_velocity_radps, arm);
  box.angular_velocity_radps = participant.angular_velocity_radps;
  return box;
}

double corner_m(const Participant& participant) {
  constexpr double box_corner_m = 0.02;  // Of a carton or a crate.
  return is_box(participant) ? box_corner_m : impact::vehicle_corner_m();
}

impact::Outline outline_of(const debris::Box& box, double corner_m) {
  const Vec2 forward(box.world_from_box.orientation * Vec3(1.0, 0.0, 0.0));
  return impact::box_outline(Vec2(box.world_from_box.position_m), glm::normalize(forward), Vec2(box.half_size_m),
                             corner_m);
}

}  // namespace septet::simulation
