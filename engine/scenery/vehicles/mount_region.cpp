#include "engine/scenery/vehicles/mount_region.hpp"

#include <algorithm>

#include <glm/common.hpp>
#include <glm/vector_relational.hpp>

#include "engine/scenery/vehicles/car_lines.hpp"

namespace septet::scenery {
namespace {

using debris::Mount;

/// Beyond any surface of the body.
constexpr float beyond_m = 0.3f;

struct Body {
  const VehicleModel& model;
  CarShape shape;
  float front, rear, half;
};

MountRegion bumper(const Body& body, bool ahead) {
  const auto radius = static_cast<float>(body.model.wheel_radius_m), axle = static_cast<float>(body.model.wheelbase_m);
  const bool car = body.model.kind == ParticipantKind::car;
  const float arch = 1.2f * radius + 0.04f, wide = body.half + beyond_m;
  MountRegion region;
  region.outward = {ahead ? 1.0f : -1.0f, 0.0f, 0.0f};
  region.recess_m = 0.09f;
  if (ahead)
    // Below the radiator's grille.
    region.skin = RegionBox{{std::max(body.front - 0.45f, axle + arch), -wide, 0.0f},
                            {body.front + beyond_m, wide, body.shape.hood_front_m - 0.28f}};
  else
    region.skin = RegionBox{{body.rear - beyond_m, -wide, 0.0f},
                            {std::min(body.rear + 0.45f, -arch), wide, car ? body.shape.tail_m - 0.26f : 0.60f}};
  return region;
}

MountRegion lamp(const Body& body, bool ahead, float side) {
  constexpr float margin_m = 0.012f, indicator_m = 0.055f;  // Indicators stand below the head lamps.
  const LampPlace place = ahead ? head_lamp(body.model, body.shape) : tail_lamp(body.model, body.shape);
  const float inner = side * (place.inner - margin_m), outer = side * (place.outer + 3.0f * margin_m);
  const float low = place.low - margin_m - (ahead ? indicator_m : 0.0f);
  MountRegion region;
  region.outward = {ahead ? 1.0f : -1.0f, 0.0f, 0.0f};
  region.recess_m = 0.12f;
  region.skin =
      RegionBox{{ahead ? body.front - 0.40f : body.rear - beyond_m, std::min(inner, outer), low},
                {ahead ? body.front + beyond_m : body.rear + 0.40f, std::max(inner, outer), place.top + margin_m}};
  return region;
}

/// Empty for a rear door that there is no room for: the vehicle has two.
std::optional<MountRegion> door(const Body& body, bool ahead, float side) {
  const DoorSeams seams = door_seams(body.model, body.shape);
  const float from = ahead ? seams.middle : 0.5f * (seams.rear_low + seams.rear_high),
              to = ahead ? seams.front : seams.middle;
  constexpr float narrowest_m = 0.1f;
  if (to - from < narrowest_m) return std::nullopt;
  const auto across = [&](float inner, float outer, float x_from, float x_to, float low, float high) {
    return RegionBox{{x_from, std::min(side * inner, side * outer), low},
                     {x_to, std::max(side * inner, side * outer), high}};
  };
  constexpr float deep_m = 0.17f;
  MountRegion region;
  region.outward = {0.0f, side, 0.0f};
  region.recess_m = 0.08f;
  region.skin = across(body.half - deep_m, body.half + beyond_m, from, to, seams.low, seams.belt);
  region.panes = across(0.4f * body.half, body.half + beyond_m, from, to, seams.belt,
                        static_cast<float>(body.model.height_m) - 0.1f);
  if (ahead)
    region.carried.push_back(across(0.97f * body.half, body.half + beyond_m, from, to, seams.belt, seams.belt + 0.45f));
  return region;
}

/// The panes of a door alone.
std::optional<MountRegion> window(const Body& body, bool ahead, float side) {
  std::optional<MountRegion> region = door(body, ahead, side);
  if (!region) return region;
  region->skin.reset();
  region->carried.clear();
  return region;
}

MountRegion windscreen(const Body& body) {
  const auto axle = static_cast<float>(body.model.wheelbase_m), high = static_cast<float>(body.model.height_m);
  MountRegion region;
  region.panes = RegionBox{{axle - body.shape.roof_front_m - 0.1f, -body.half, body.shape.hood_rear_m - 0.05f},
                           {axle - body.shape.cowl_m + 0.2f, body.half, high + 0.1f}};
  // Side windows reach as far forward, but lie further out.
  region.panes->low_m.y *= 0.6f;
  region.panes->high_m.y *= 0.6f;
  return region;
}

}  // namespace

bool RegionBox::holds(const glm::vec3& place_m) const {
  return glm::all(glm::greaterThanEqual(place_m, low_m)) && glm::all(glm::lessThanEqual(place_m, high_m));
}

std::optional<MountRegion> mount_region(const VehicleModel& model, Mount mount) {
  if (!has_car_lines(model)) return std::nullopt;
  const Body body{model, car_shape(model), static_cast<float>(model.front_m()),
                  static_cast<float>(-model.rear_overhang_m), static_cast<float>(model.width_m / 2)};
  switch (mount) {
    case Mount::front_bumper:
    case Mount::rear_bumper:
      return bumper(body, mount == Mount::front_bumper);
    case Mount::front_left_lamp:
    case Mount::front_right_lamp:
      return lamp(body, true, mount == Mount::front_left_lamp ? 1.0f : -1.0f);
    case Mount::rear_left_lamp:
    case Mount::rear_right_lamp:
      return lamp(body, false, mount == Mount::rear_left_lamp ? 1.0f : -1.0f);
    case Mount::front_left_door:
    case Mount::front_right_door:
      return door(body, true, mount == Mount::front_left_door ? 1.0f : -1.0f);
    case Mount::rear_left_door:
    case Mount::rear_right_door:
      return door(body, false, mount == Mount::rear_left_door ? 1.0f : -1.0f);
    case Mount::front_left_window:
    case Mount::front_right_window:
      return window(body, true, mount == Mount::front_left_window ? 1.0f : -1.0f);
    case Mount::rear_left_window:
    case Mount::rear_right_window:
      return window(body, false, mount == Mount::rear_left_window ? 1.0f : -1.0f);
    case Mount::windscreen:
      break;
  }
  return windscreen(body);
}

}  // namespace septet::scenery
