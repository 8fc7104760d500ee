#pragma once
/// What a session sounds like, block for block: its ticks through the synthesis and OpenAL's loopback device, as the driver heard them.
///
/// The same session gives the same samples. Clock and output are the caller's; one thread.

#include <cstdint>
#include <functional>
#include <span>

#include "engine/audio/sound_stage.hpp"
#include "engine/core/expected.hpp"
#include "logging/session_reader.hpp"
#include "sim-client/soundtrack/session_sound.hpp"

namespace septet::sound {

inline constexpr double ticks_per_second = audio::sample_rate_hz / double(audio::block_samples);

/// What of a session's sound does not change.
struct SessionSound {
  audio::CarSound car;
  std::vector<audio::EchoBox> boxes;
  road::RoadNetwork roads;
};
/// Error: its ticks are not those that sound is made of, or its scene cannot be read.
Expected<SessionSound> sound_of(const logging::SessionReader& session);

struct TrackOptions {
  double from_s = 0.0, to_s = 0.0;  ///< Simulated time; both within the session.
  audio::StageOptions stage;
  std::uint64_t seed = 1;  ///< Of noises.
};

struct TrackMade {
  std::uint64_t blocks = 0, bad_numbers = 0;
  bool stopped = false;
};

/// One block, interleaved, of the tick at this simulated time; false: no more.
using TakeBlock = std::function<Expected<bool>(std::span<const float> samples, double tick_s)>;

/// A block for each tick from `from_s` to before `to_s`. Ticks that the log lacks are heard as the one before them.
Expected<TrackMade> render_track(const logging::SessionReader& session, const SessionSound& sound,
                                 const TrackOptions& options, const TakeBlock& take);

}  // namespace septet::sound
