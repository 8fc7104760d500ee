#include "sim-client/frame/viewpoint.hpp"

namespace septet::frame {

Viewpoint driver_viewpoint(const Snapshot& shown) {
  const Participant* car = find_participant(shown, shown.driver_car.participant);
  if (!car && !shown.participants.empty()) car = &shown.participants.front();
  return car ? Viewpoint{car->world_from_vehicle, car->id} : Viewpoint{};
}

Vec3 eye_in(const VehicleModel& model) {
  switch (model.kind) {
    case ParticipantKind::car:
      return {0.48 * model.wheelbase_m, 0.2 * model.width_m, 0.81 * model.height_m};
    // Seats above the front axle or close behind it, eyes well below the roof of the box.
    case ParticipantKind::van:
    case ParticipantKind::ambulance:
      return {model.front_m() - 1.9, 0.22 * model.width_m, 0.68 * model.height_m};
    case ParticipantKind::lorry:
    case ParticipantKind::bus:
      return {model.front_m() - 1.2, 0.24 * model.width_m, 0.66 * model.height_m};
    case ParticipantKind::motorcycle:
    case ParticipantKind::bicycle:
      return {model.centre_x_m() - 0.1, 0.0, 1.5};
    case ParticipantKind::pedestrian:
    case ParticipantKind::object:
      break;
  }
  return {model.centre_x_m(), 0.0, 0.93 * model.height_m};
}

}  // namespace septet::frame
