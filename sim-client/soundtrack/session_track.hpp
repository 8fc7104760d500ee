#pragma once
/// Sound of a session, block by block: its ticks through the synthesis and OpenAL's loopback device, as the driver
/// heard them.
///
/// The same session gives the same samples. Clock and output are the caller's; one thread.

#include <cstdint>
#include <functional>
#include <span>

#include "engine/audio/sound_stage.hpp"
#include "engine/core/expected.hpp"
#include "logging/session/session_reader.hpp"
#include "sim-client/soundtrack/session_sound.hpp"

namespace septet::sound {

inline constexpr double ticks_per_second = audio::sample_rate_hz / double(audio::block_samples);

/// Constant part of a session's sound.
struct SessionSound {
  audio::CarSound car;
  std::vector<audio::EchoBox> boxes;
  road::RoadNetwork roads;
};
/// Sound of a session. Error: its ticks lack the data for sound, or its scene cannot be read.
Expected<SessionSound> sound_of(const logging::SessionReader& session);

struct TrackOptions {
  double from_s = 0.0, to_s = 0.0;  ///< Simulated time; both within the session.
  audio::StageOptions stage;
  std::uint64_t seed = 1;  ///< Seed of the noises.
};

struct TrackMade {
  std::uint64_t blocks = 0, bad_numbers = 0;
  bool stopped = false;
};

/// One block, interleaved, of the tick at this simulated time; return false to stop.
using TakeBlock = std::function<Expected<bool>(std::span<const float> samples, double tick_s)>;

/// Renders one block per tick from `from_s` to before `to_s`. A tick missing from the log repeats the sound of the one
/// before.
Expected<TrackMade> render_track(const logging::SessionReader& session, const SessionSound& sound,
                                 const TrackOptions& options, const TakeBlock& take);

}  // namespace septet::sound
