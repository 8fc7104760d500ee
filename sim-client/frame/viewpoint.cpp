#include "sim-client/frame/viewpoint.hpp"

#include "engine/scenery/vehicles/eye_point.hpp"
#include "engine/world/vehicle_model.hpp"

namespace septet::frame {

Viewpoint driver_viewpoint(const Snapshot& shown) {
  const Participant* car = find_participant(shown, shown.driver_car.participant);
  if (!car && !shown.participants.empty()) car = &shown.participants.front();
  return car ? Viewpoint{car->world_from_vehicle, car->id} : Viewpoint{};
}

std::optional<Viewpoint> viewpoint_of(const Snapshot& shown, ParticipantId participant, const Vec3& rig_eye_m) {
  const Participant* found = find_participant(shown, participant);
  if (!found) return std::nullopt;
  RigidTransform vehicle_from_views;
  vehicle_from_views.position_m = scenery::eye_in(vehicle_models()[found->model]) - rig_eye_m;
  return Viewpoint{found->world_from_vehicle * vehicle_from_views, participant};
}

}  // namespace septet::frame
