#include "engine/effects/debris/mounted_part.hpp"

#include <numbers>

#include "engine/math/gravity.hpp"

namespace septet::debris {
namespace {

struct MountStrengths {
  double door_strength_n, windscreen_strength_n;
  double clips_hold_g;  // Strength of the mounts of bumpers and lamps, in their own weights.
};
#define SEPTET_ENTRY(name, ...) constexpr MountStrengths name __VA_ARGS__;
#include "engine/effects/debris/mounts.toml.inc"

double clip_strength_n(Part part) { return passenger_car.clips_hold_g * gravity_mps2 * part_recipe(part).mass_kg; }

Mount lamp_mount(bool ahead, bool left) {
  if (ahead) return left ? Mount::front_left_lamp : Mount::front_right_lamp;
  return left ? Mount::rear_left_lamp : Mount::rear_right_lamp;
}

Mount door_mount(bool ahead, bool left) {
  if (ahead) return left ? Mount::front_left_door : Mount::front_right_door;
  return left ? Mount::rear_left_door : Mount::rear_right_door;
}

Mount window_mount(bool ahead, bool left) {
  if (ahead) return left ? Mount::front_left_window : Mount::front_right_window;
  return left ? Mount::rear_left_window : Mount::rear_right_window;
}

}  // namespace

Mount carrier_of(Mount mount) {
  switch (mount) {
    case Mount::front_left_window:
      return Mount::front_left_door;
    case Mount::front_right_window:
      return Mount::front_right_door;
    case Mount::rear_left_window:
      return Mount::rear_left_door;
    case Mount::rear_right_window:
      return Mount::rear_right_door;
    default:
      return mount;
  }
}

std::vector<MountedPart> passenger_car_parts(const Vec3& half_size_m) {
  std::vector<MountedPart> parts;
  const auto& h = half_size_m;
  const Quat straight(1, 0, 0, 0), backwards = glm::angleAxis(std::numbers::pi, Vec3(0, 0, 1));
  const auto half = [](Part part) { return 0.5 * part_recipe(part).size_m; };
  const Vec3 bumper = half(Part::bumper), lamp = half(Part::lamp), door = half(Part::door),
             window = half(Part::side_window);
  for (const double end : {1.0, -1.0}) {
    const Quat turn = end > 0 ? straight : backwards;
    const bool ahead = end > 0;
    parts.push_back({Part::bumper,
                     {{end * (h.x - bumper.x), 0, -0.35 * h.z}, turn},
                     clip_strength_n(Part::bumper),
                     ahead ? Mount::front_bumper : Mount::rear_bumper});
    for (const double side : {1.0, -1.0})
      parts.push_back({Part::lamp,
                       {{end * (h.x - lamp.x), side * (h.y - lamp.y), 0.05 * h.z}, turn},
                       clip_strength_n(Part::lamp),
                       lamp_mount(ahead, side > 0)});
  }
  const bool four_doors = h.x > 2.0;
  for (int row = 0; row < (four_doors ? 2 : 1); ++row)
    for (const double side : {1.0, -1.0}) {
      const double x = 0.15 * h.x - row * (2.0 * door.x + 0.02);
      parts.push_back({Part::door,
                       {{x, side * (h.y - door.y), -0.15 * h.z}, straight},
                       passenger_car.door_strength_n,
                       door_mount(row == 0, side > 0)});
      // It runs in its door's frame.
      parts.push_back({Part::side_window,
                       {{x, side * (h.y - window.y), 0.45 * h.z}, straight},
                       passenger_car.door_strength_n,
                       window_mount(row == 0, side > 0)});
    }
  parts.push_back({Part::windscreen,
                   {{0.35 * h.x, 0, 0.5 * h.z}, glm::angleAxis(-0.6, Vec3(0, 1, 0))},
                   passenger_car.windscreen_strength_n,
                   Mount::windscreen});
  return parts;
}

}  // namespace septet::debris
