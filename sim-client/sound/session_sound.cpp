#include "sim-client/sound/session_sound.hpp"

#include "engine/physics/vehicle/read_vehicle.hpp"
#include "engine/rig/rig.hpp"
#include "engine/scene/resolve.hpp"
#include "logging/recorded_scene.hpp"

namespace septet::sound {
namespace {

constexpr float darkest_that_is_open = 0.5f;  // A bridge overhead is no tunnel.

}  // namespace

audio::CarSound car_sound_of(const logging::SessionInfo& info) {
  audio::CarSound car;
  for (const auto& source : info.files) {
    if (source.role == "rig")
      if (const auto rig = rig::read_rig(source.content, source.name)) car.ear_m = rig->eye_point_m;
    if (source.role != "vehicle") continue;
    const auto vehicle = vehicle::read_vehicle(source.content, source.name);
    if (!vehicle) continue;
    car.cylinders = vehicle->powertrain.cylinders;
    car.idle_radps = vehicle->powertrain.idle_radps;
    car.final_ratio = vehicle->powertrain.final_ratio;
    car.wheelbase_m = vehicle->body.wheelbase_m;
    car.wheel_radius_m = vehicle->tyre.radius_m;
  }
  return car;
}

std::vector<audio::EchoBox> echo_boxes(const instant::SceneSummary& scene) {
  std::vector<audio::EchoBox> boxes;
  for (const instant::Roof& roof : scene.roofs)
    if (roof.share_of_sky < darkest_that_is_open)
      boxes.push_back({roof.object_from_world, Vec3(roof.min_m), Vec3(roof.max_m)});
  return boxes;
}

Expected<std::vector<audio::EchoBox>> echo_boxes_of(const logging::SessionReader& session) {
  scene::Store store;
  if (auto restored = logging::restore_scene(session, store); !restored) return tl::unexpected(restored.error());
  return echo_boxes(instant::summarise(scene::resolve(store)));
}

}  // namespace septet::sound
