#include "engine/scenery/vehicles/eye_point.hpp"

#include <algorithm>

#include "engine/scenery/vehicles/car_body.hpp"
#include "engine/scenery/vehicles/cockpit.hpp"

namespace septet::scenery {

Vec3 eye_in(const VehicleModel& model) {
  /// x of the head of the windscreen.
  const auto roof_front_m = [&] { return model.wheelbase_m - car_shape(model).roof_front_m; };
  switch (model.kind) {
    case ParticipantKind::car:
      if (has_cockpit(model)) return {0.48 * model.wheelbase_m, 0.2 * model.width_m, 0.81 * model.height_m};
      return {roof_front_m() - 0.22, 0.2 * model.width_m, 0.81 * model.height_m};
    // Well below the roof of the box.
    case ParticipantKind::van:
    case ParticipantKind::ambulance:
      if (!is_driven(model)) break;
      return {roof_front_m() - 0.30, 0.22 * model.width_m, 0.68 * model.height_m};
    case ParticipantKind::lorry:
      if (!is_driven(model)) break;
      if (model.name == "farm-tractor") return {0.05, 0.0, 2.15};  // Its cab stands over the rear axle.
      return {model.front_m() - 0.95, 0.24 * model.width_m, std::min(0.66 * model.height_m, 2.35)};
    case ParticipantKind::bus:
      return {model.front_m() - 1.2, 0.24 * model.width_m, 0.66 * model.height_m};
    // Where the heads of the drawn riders and walkers have their eyes.
    case ParticipantKind::motorcycle:
      return {0.74, 0.0, 1.41};
    case ParticipantKind::bicycle:
      return {0.68, 0.0, 1.60};
    case ParticipantKind::pedestrian:
      return {0.20, 0.0, 1.64};
    case ParticipantKind::object:
      break;
  }
  return {model.centre_x_m(), 0.0, 0.93 * model.height_m};
}

}  // namespace septet::scenery
