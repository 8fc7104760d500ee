#include "sim-server/drive/drive_sound.hpp"

#include <cstdint>
#include <utility>

#include "engine/instant/scene_summary.hpp"
#include "engine/physics/vehicle/read_vehicle.hpp"
#include "engine/road/opendrive_reader.hpp"
#include "engine/scene/resolve.hpp"
#include "sim-client/frame/car_sound.hpp"
#include "sim-server/host/live_sound.hpp"

namespace septet::server {

std::function<void(const std::shared_ptr<const TakenSnapshot>&, double)> drive_sound(
    const rig::Rig& rig, const std::shared_ptr<const simulation::Model>& model, const logging::SessionReader* session,
    const scene::Store& store, std::function<void(const std::string&)> message, std::function<void()> lost) {
  audio::CarSound sound{.ear_m = rig.eye_point_m};
  std::shared_ptr<const road::RoadNetwork> roads;
  if (model) {
    sound = frame::car_sound(model->car, rig.eye_point_m);
    roads = {model, &model->roads};
  }
  if (session)
    for (const auto& source : session->info().files) {
      if (source.role == "road")
        if (auto read = road::read_opendrive(source.content, source.name))
          roads = std::make_shared<const road::RoadNetwork>(std::move(*read));
      if (source.role != "vehicle") continue;
      const auto driven = vehicle::read_vehicle(source.content, source.name);
      if (driven) sound = frame::car_sound(*driven, rig.eye_point_m);
    }
  auto boxes = frame::echo_boxes(instant::summarise(scene::resolve(store)));
  const auto live = std::make_shared<LiveSound>(
      SoundFeeder(device_opener(rig.sound.value_or(rig::Sound{})), sound, std::move(boxes), std::move(roads)));
  return [live, message = std::move(message), lost = std::move(lost), times_lost = std::uint64_t{0}](
             const std::shared_ptr<const TakenSnapshot>& tick, double shaking_share) mutable {
    live->add(tick, shaking_share);
    if (live->counts().lost > std::exchange(times_lost, live->counts().lost)) lost();
    while (const auto text = live->take_message()) message(*text);
  };
}

}  // namespace septet::server
