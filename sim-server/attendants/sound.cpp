#include "sim-server/attendants/sound.hpp"

#include <utility>

#include "engine/instant/scene_summary.hpp"
#include "engine/physics/vehicle/read_vehicle.hpp"
#include "engine/road/opendrive_reader.hpp"
#include "engine/scene/resolve.hpp"
#include "sim-client/frame/car_sound.hpp"

namespace septet::server {
namespace {

SoundFeeder feeder_of(const SoundSources& sources) {
  const rig::Rig& rig = sources.rig;
  audio::CarSound sound{.ear_m = rig.eye_point_m};
  std::shared_ptr<const road::RoadNetwork> roads;
  if (sources.model) {
    sound = frame::car_sound(sources.model->car, rig.eye_point_m);
    roads = {sources.model, &sources.model->roads};
  }
  if (sources.session)
    for (const auto& source : sources.session->info().files) {
      if (source.role == "road")
        if (auto read = road::read_opendrive(source.content, source.name))
          roads = std::make_shared<const road::RoadNetwork>(std::move(*read));
      if (source.role != "vehicle") continue;
      const auto driven = vehicle::read_vehicle(source.content, source.name);
      if (driven) sound = frame::car_sound(*driven, rig.eye_point_m);
    }
  auto boxes = frame::echo_boxes(instant::summarise(scene::resolve(sources.store)));
  return {device_opener(rig.sound.value_or(rig::Sound{})), sound, std::move(boxes), std::move(roads)};
}

}  // namespace

Expected<void> Sound::begin() {
  sound_.emplace(feeder_of(sources_));
  return {};
}

void Sound::after_tick(const std::shared_ptr<const TakenSnapshot>& tick, double shaking_share) {
  sound_->add(tick, shaking_share);
  // A shaker may be connected to the same device: without sound nothing controls it, so the actuators are cut.
  if (sound_->counts().lost > std::exchange(times_lost_, sound_->counts().lost) && live_)
    live_->cut_actuators("the sound has stopped");
}

std::vector<std::string> Sound::take_messages() {
  std::vector<std::string> messages;
  while (auto text = sound_->take_message()) messages.push_back(std::move(*text));
  return messages;
}

}  // namespace septet::server
