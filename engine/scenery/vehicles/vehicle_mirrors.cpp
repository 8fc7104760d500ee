#include "engine/scenery/vehicles/vehicle_mirrors.hpp"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

#include "engine/scenery/vehicles/car_body.hpp"
#include "engine/scenery/vehicles/cockpit.hpp"
#include "engine/scenery/vehicles/eye_point.hpp"

namespace septet::scenery {
namespace {

/// Glass that shows the eye what lies in a direction.
VehicleMirror aimed(const Vec3& eye_m, const Vec3& shown, VehicleMirror mirror) {
  mirror.normal = glm::normalize(glm::normalize(eye_m - mirror.middle_m) + glm::normalize(shown));
  mirror.right = glm::normalize(glm::cross(Vec3(0, 0, 1), mirror.normal));
  return mirror;
}

/// Left and right glass, convex, around a middle on the left; each shows its own flank and the lane beside it.
void add_pair(std::vector<VehicleMirror>& mirrors, const Vec3& eye_m, const VehicleMirror& left) {
  constexpr double convex_m = 1.4;  // UN Regulation 46: at least 1.2 m outside.
  for (const double side : {1.0, -1.0}) {
    VehicleMirror mirror = left;
    mirror.middle_m.y *= side;
    mirror.radius_m = convex_m;
    mirrors.push_back(aimed(eye_m, Vec3(-1.0, 0.10 * side, -0.04), mirror));
  }
}

}  // namespace

Vec3 VehicleMirror::up() const { return glm::cross(normal, right); }

std::vector<VehicleMirror> vehicle_mirrors(const VehicleModel& model) {
  std::vector<VehicleMirror> mirrors;
  if (has_cockpit(model) || !is_driven(model)) return mirrors;
  const Vec3 eye_m = eye_in(model);
  const double half_m = 0.5 * model.width_m;
  switch (model.kind) {
    case ParticipantKind::car: {
      // Housings as in car_trim.cpp: the glass stands behind them, turned to the driver.
      const CarShape shape = car_shape(model);
      const double x_m = model.wheelbase_m - shape.cowl_m - 0.36 - 0.11;
      // The inner one hangs below the windscreen's pane, from its foot at the cowl to its head at the roof's end.
      const double inner_x_m = eye_m.x + 0.40, cowl_m = model.wheelbase_m - shape.cowl_m;
      const double up_the_pane = (cowl_m - inner_x_m) / (shape.roof_front_m - shape.cowl_m);
      const double pane_z_m = std::lerp(shape.hood_rear_m + 0.035, model.height_m - 0.135, up_the_pane);
      mirrors.push_back(aimed(eye_m, Vec3(-1.0, 0.0, 0.0),
                              {.middle_m = {inner_x_m, 0.0, std::min(eye_m.z + 0.085, pane_z_m - 0.05)},
                               .width_m = 0.22,
                               .height_m = 0.06}));
      add_pair(
          mirrors, eye_m,
          {.middle_m = {x_m, 0.97 * half_m + 0.085, shape.belt_front_m + 0.12}, .width_m = 0.17, .height_m = 0.11});
      break;
    }
    case ParticipantKind::van:
    case ParticipantKind::ambulance: {
      const CarShape shape = car_shape(model);
      const double x_m = model.wheelbase_m - shape.cowl_m - 0.20 - 0.21;
      add_pair(
          mirrors, eye_m,
          {.middle_m = {x_m, 0.97 * half_m + 0.09, shape.belt_front_m + 0.215}, .width_m = 0.17, .height_m = 0.28});
      break;
    }
    case ParticipantKind::lorry:
      if (model.name == "farm-tractor")
        add_pair(mirrors, eye_m, {.middle_m = {0.85, 1.0, 2.2}, .width_m = 0.17, .height_m = 0.26});
      else
        add_pair(mirrors, eye_m,
                 {.middle_m = {model.front_m() - 0.49, half_m + 0.10, 2.2}, .width_m = 0.20, .height_m = 0.56});
      break;
    case ParticipantKind::bus: {
      // Before the windscreen, which leans back, so that no pillar hides them.
      const double lean_m = model.name == "coach" ? 0.45 : 0.12;
      add_pair(mirrors, eye_m,
               {.middle_m = {model.front_m() + 0.22 - 0.5 * lean_m, half_m - 0.06, eye_m.z + 0.15},
                .width_m = 0.20,
                .height_m = 0.34});
      break;
    }
    case ParticipantKind::motorcycle:
      add_pair(mirrors, eye_m, {.middle_m = {1.16, 0.38, 1.20}, .width_m = 0.13, .height_m = 0.08});
      break;
    case ParticipantKind::bicycle:
    case ParticipantKind::pedestrian:
    case ParticipantKind::object:
      break;
  }
  return mirrors;
}

}  // namespace septet::scenery
