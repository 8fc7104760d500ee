#include "sim-client/frame/car_sound.hpp"

namespace septet::frame {
namespace {

constexpr float darkest_that_is_open = 0.5f;  // A bridge overhead is no tunnel.

}  // namespace

audio::CarSound car_sound(const vehicle::VehicleParameters& vehicle, const Vec3& ear_m) {
  return {.cylinders = vehicle.powertrain.cylinders,
          .idle_radps = vehicle.powertrain.idle_radps,
          .wheelbase_m = vehicle.body.wheelbase_m,
          .wheel_radius_m = vehicle.tyre.radius_m,
          .final_ratio = vehicle.powertrain.final_ratio,
          .ear_m = ear_m};
}

std::vector<audio::EchoBox> echo_boxes(const instant::SceneSummary& scene) {
  std::vector<audio::EchoBox> boxes;
  for (const instant::Roof& roof : scene.roofs)
    if (roof.share_of_sky < darkest_that_is_open)
      boxes.push_back({roof.object_from_world, Vec3(roof.min_m), Vec3(roof.max_m)});
  return boxes;
}

}  // namespace septet::frame
