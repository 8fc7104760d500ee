#include "engine/world/participant_sight.hpp"

#include <algorithm>

namespace septet {
namespace {

sight::Box box_up_to(const Participant& participant, const VehicleModel& model, double height_m) {
  const RigidTransform& place = participant.world_from_vehicle;
  return {{place * Vec3(model.centre_x_m(), 0.0, 0.5 * height_m), place.orientation},
          0.5 * Vec3(model.length_m, model.width_m, height_m)};
}

}  // namespace

sight::Box box_of(const Participant& participant) {
  const VehicleModel model = shape_of(participant);
  return box_up_to(participant, model, model.height_m);
}

double opaque_height_m(const VehicleModel& model) {
  constexpr double belt_m = 0.93;
  switch (model.kind) {
    case ParticipantKind::car:
      return std::min(belt_m, model.height_m);
    case ParticipantKind::motorcycle:
    case ParticipantKind::bicycle:
    case ParticipantKind::pedestrian:
      return 0.0;
    case ParticipantKind::van:
    case ParticipantKind::lorry:
    case ParticipantKind::bus:
    case ParticipantKind::ambulance:
    case ParticipantKind::object:
      break;
  }
  return model.height_m;
}

std::optional<sight::Box> opaque_box_of(const Participant& participant) {
  const VehicleModel model = shape_of(participant);
  const double height_m = opaque_height_m(model);
  if (!(height_m > 0.0)) return std::nullopt;
  return box_up_to(participant, model, height_m);
}

Vec3 driver_eyes_m(const VehicleModel& model) {
  return {0.45 * model.wheelbase_m, 0.0, std::min(0.8 * model.height_m, 2.4)};
}

}  // namespace septet
