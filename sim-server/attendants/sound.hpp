#pragma once
/// The sound of a drive or of a replay, as the rig's [sound] specifies: each tick goes to the thread that plays
/// (host/live_sound.hpp). If the device is lost, the actuators are cut, since a shaker may be connected to it.

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/rig/rig.hpp"
#include "engine/scene/store.hpp"
#include "engine/simulation/model.hpp"
#include "logging/session/session_reader.hpp"
#include "sim-server/drive/live_drive.hpp"
#include "sim-server/host/attendant.hpp"
#include "sim-server/host/live_sound.hpp"

namespace septet::server {

/// Sources of the sound: car and road from the drive's `model` or, without one, from the `session`; echoes from the
/// `store`.
struct SoundSources {
  const rig::Rig& rig;
  std::shared_ptr<const simulation::Model> model;
  const logging::SessionReader* session = nullptr;
  const scene::Store& store;
};

class Sound final : public Attendant {
 public:
  /// `live` outlives the sound; null for a replay.
  Sound(SoundSources sources, LiveDrive* live) : sources_(std::move(sources)), live_(live) {}

  Expected<void> begin() override;
  void after_tick(const std::shared_ptr<const TakenSnapshot>& tick, double shaking_share) override;
  std::vector<std::string> take_messages() override;

 private:
  SoundSources sources_;
  LiveDrive* live_;
  std::optional<LiveSound> sound_;  ///< From `begin` on.
  std::uint64_t times_lost_ = 0;
};

}  // namespace septet::server
