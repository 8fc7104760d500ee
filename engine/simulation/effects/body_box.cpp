#include "engine/simulation/effects/body_box.hpp"

#include <optional>

#include <glm/geometric.hpp>

namespace septet::simulation {
namespace {

double clearance_m(ParticipantKind kind) {
  switch (kind) {
    case ParticipantKind::lorry:
    case ParticipantKind::bus: return 0.45;
    case ParticipantKind::motorcycle:
    case ParticipantKind::bicycle:
    case ParticipantKind::pedestrian: return 0.05;
    default: return 0.20;
  }
}

/// From the bonnet's edge to where the roof begins, as shares of the height and the length (engine/scenery/car_body.cpp).
struct Slope {
  double edge_height, roof_begins;
};
std::optional<Slope> front_slope(ParticipantKind kind) {
  switch (kind) {
    case ParticipantKind::car: return Slope{0.55, 0.43};
    case ParticipantKind::van:
    case ParticipantKind::ambulance: return Slope{0.48, 0.26};
    default: return std::nullopt;
  }
}

}  // namespace

debris::Box body_box(const Participant& participant) {
  const VehicleModel& model = vehicle_models()[participant.model];
  const double low = clearance_m(model.kind), high = model.height_m;
  const Vec3 centre(model.centre_x_m(), 0.0, 0.5 * (low + high));
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

}  // namespace septet::simulation
