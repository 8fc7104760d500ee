#include "sim-client/soundtrack/session_sound.hpp"

#include <optional>
#include <utility>

#include "engine/physics/vehicle/read_vehicle.hpp"
#include "engine/rig/rig.hpp"
#include "engine/road/opendrive_reader.hpp"
#include "engine/scene/resolve.hpp"
#include "logging/session/recorded_scene.hpp"
#include "sim-client/frame/car_sound.hpp"

namespace septet::sound {

audio::CarSound car_sound_of(const logging::SessionInfo& info) {
  audio::CarSound car;
  std::optional<Vec3> ear_m;
  for (const auto& source : info.files) {
    if (source.role == "rig")
      if (const auto rig = rig::read_rig(source.content, source.name)) ear_m = rig->eye_point_m;
    if (source.role != "vehicle") continue;
    const auto vehicle = vehicle::read_vehicle(source.content, source.name);
    if (vehicle) car = frame::car_sound(*vehicle, car.ear_m);
  }
  car.ear_m = ear_m.value_or(car.ear_m);
  return car;
}

road::RoadNetwork roads_of(const logging::SessionInfo& info) {
  for (const auto& source : info.files)
    if (source.role == "road")
      if (auto roads = road::read_opendrive(source.content, source.name)) return std::move(*roads);
  return {};
}

Expected<std::vector<audio::EchoBox>> echo_boxes_of(const logging::SessionReader& session) {
  scene::Store store;
  if (auto restored = logging::restore_scene(session, store); !restored) return tl::unexpected(restored.error());
  return frame::echo_boxes(instant::summarise(scene::resolve(store)));
}

}  // namespace septet::sound
