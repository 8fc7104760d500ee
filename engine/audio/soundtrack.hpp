#pragma once
/// Synthesis: from the sounds of a tick (heard.hpp) to one block of samples for each source.
///
/// All that lasts from block to block is `State`, an argument; its random numbers come from the caller's. Values that
/// change from tick to tick are interpolated linearly over the block, and a source no longer heard fades over one, so
/// that there are no clicks. The Doppler effect is ours, not OpenAL's: every frequency of a source is multiplied by its
/// factor, sample for sample. OpenAL's would play streamed blocks faster than they come, and takes its velocities in
/// steps. Levels: levels.hpp; samples are pascals (signal.hpp). One thread a state.

#include <cstdint>
#include <map>
#include <vector>

#include "engine/audio/harmonics.hpp"
#include "engine/audio/heard.hpp"
#include "engine/audio/layers.hpp"
#include "engine/core/random.hpp"

namespace septet::audio {

/// One source and its next block.
struct Voice {
  std::uint64_t key = 0;  ///< Constant from block to block.
  Vec3 position_m{0.0};   ///< Ear frame.
  bool is_near = true;    ///< Sound of the driver's car: its level is that at the ear. Otherwise that at 1 m from it.
  bool is_low = false;    ///< For the channel of low frequencies and the shaker alone.
  float echo = 0.0f;      ///< Share of it that a tunnel reflects.
  Block samples{};
};

enum class OwnVoice : std::uint8_t {
  engine,
  exhaust,
  wind_left,
  wind_right,
  front_left,
  front_right,
  rear_left,
  rear_right,
  rain,
  relay,
  horn,
  crash,
  low
};
inline constexpr std::size_t own_voices = 13;

/// The driver's car from block to block.
struct OwnState {
  double gain = 0.0, engine_hz = 0.0, load = 0.0, fuel_cut = 0.0;  ///< The engine's, following within 80 ms.
  Tone front_orders, rear_orders, whine, horn_low, horn_high, low_orders, low_wheel, low_line;
  NoiseLayer mechanical, intake, rain_hiss, low_road;
  struct Tyre {
    NoiseLayer air, structure, spray, gravel, skid;
  };
  std::array<Tyre, 4> tyres;
  std::array<NoiseLayer, 2> wind;
  std::array<double, 2> gust{};
  Noise drops, sparks;
  std::array<Filter, 3> roof;
  double drop_rate = 0.0, drop_pressure = 0.0;
  bool was_lit = false;
  Burst relay, blow, glass, pieces, bump;
  double bump_phase = 0.0, low_share = 1.0;
  double relay_phase = 0.0, relay_hz = 2300.0;
  Filter blow_filter, glass_filter, pieces_filter, low_first, low_second, low_blow;
};

/// Another participant from block to block.
struct OtherState {
  Vec3 position_m{0.0};
  Tone orders, siren, horn_low, horn_high;
  NoiseLayer rolling, exhaust;
  Burst blow;
  Filter blow_filter;
  CabinWall wall;
  double engine_hz = 0.0;
  OtherSound last;
  bool is_leaving = false;
};

struct State {
  CarSound car;
  OwnState own;
  std::map<ParticipantId, OtherState> others;
  Random random{0};
};

State start(const CarSound& car, const Random& random);

/// The voices of the next block; `voices` are those of the last one, or empty.
void render(State& state, const Heard& heard, std::vector<Voice>& voices);

}  // namespace septet::audio
