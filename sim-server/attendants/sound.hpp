#pragma once
/// The sound of a drive, or of a session that is shown again, as the rig's [sound] asks for it: each tick goes to a thread that plays
/// (host/live_sound.hpp). Where the device is lost, actuators that may hang on it are cut.

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

/// Sources of what is heard: the car and the road of the drive's `model` or, without one, of the `session`; echoes of the `store`.
struct SoundSources {
  const rig::Rig& rig;
  std::shared_ptr<const simulation::Model> model;
  const logging::SessionReader* session = nullptr;
  const scene::Store& store;
};

class Sound final : public Attendant {
 public:
  /// `live` outlives it; null where a session is shown again.
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
