#include "engine/audio/other_sound.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "engine/audio/horn.hpp"
#include "engine/audio/levels.hpp"
#include "engine/audio/siren.hpp"

namespace septet::audio {
namespace {

constexpr double engine_follows_s = 0.15;
constexpr double masked_db = 8.0;  // Margin below the tyres from which an engine's noise is masked.
constexpr double least_hz = 80.0;  // The A curve would make a roar of an idling engine's lowest tones.
constexpr std::size_t engine_multiples = 8, siren_multiples = 8;

const Shape& rolling_shape() {
  static const Shape shape(Section::band_pass(1000.0, 0.6), Section::low_pass(4000.0, 0.7));
  return shape;
}
const Shape& exhaust_shape() {
  static const Shape shape(Section::band_pass(250.0, 0.5), Section::low_pass(1500.0, 0.7));
  return shape;
}
const Section& blow_section() {
  static const Section section = Section::low_pass(2500.0, 0.6);
  return section;
}

/// Harmonics that fall off as 1/n, of this level in dB(A) for a fundamental near `hz`.
Harmonics toned(double hz, double a_level_db, double falloff, std::size_t count) {
  Harmonics harmonics{};
  double power = 0.0;
  for (std::size_t n = 1; n <= count; ++n) {
    harmonics[n - 1] = static_cast<float>(std::pow(double(n), -falloff));
    const double weighted = harmonics[n - 1] * a_weight(std::max(hz, least_hz) * double(n));
    power += 0.5 * weighted * weighted;
  }
  const auto gain = static_cast<float>(pressure_pa(a_level_db) / std::sqrt(power));
  for (float& pressure : harmonics) pressure *= gain;
  return harmonics;
}

}  // namespace

void begin_other(OtherState& state, const OtherSound& sound, std::uint32_t first_seed, std::uint32_t second_seed) {
  state = {};
  state.rolling.noise.bits = first_seed;
  state.exhaust.noise.bits = second_seed;
  state.engine_hz = sound.engine_hz;
}

namespace {

/// Levels of a vehicle's rolling and engine.
struct Loudness {
  double rolling_db, engine_db;
};
Loudness loudness_of(const OtherSound& sound) {
  return {rolling_outside_db(sound.kind, sound.speed_mps),
          propulsion_outside_db(sound.kind, sound.speed_mps, sound.load)};
}

void add_noises_of(std::span<OtherState* const> states, std::span<Voice> voices) {
  std::vector<NoisePart> rolling, exhaust;
  for (std::size_t i = 0; i < states.size(); ++i) {
    const OtherSound& sound = states[i]->last;
    const double here = states[i]->is_leaving ? 0.0 : 1.0, moving = std::min(1.0, sound.speed_mps / 1.0);
    const auto [rolling_db, engine_db] = loudness_of(sound);
    const bool is_masked = engine_db < rolling_db - masked_db;
    rolling.push_back({&states[i]->rolling, here * moving * rolling_shape().gain(rolling_db), &voices[i].samples});
    exhaust.push_back(
        {&states[i]->exhaust, is_masked ? 0.0 : here * exhaust_shape().gain(engine_db - 3.0), &voices[i].samples});
  }
  add_noises(rolling, rolling_shape());
  add_noises(exhaust, exhaust_shape());
}

void add_tones_of(OtherState& state, Voice& voice) {
  const OtherSound& sound = state.last;
  const double here = state.is_leaving ? 0.0 : 1.0;
  Block& out = voice.samples;
  const double engine_db = loudness_of(sound).engine_db;
  state.engine_hz += (sound.engine_hz - state.engine_hz) * (1.0 - std::exp(-block_s / engine_follows_s));
  const bool is_heavy = sound.kind == ParticipantKind::lorry || sound.kind == ParticipantKind::bus;
  const double firing_hz = (is_heavy ? 3.0 : 2.0) * state.engine_hz;  // Six cylinders, or four.
  add_harmonics(state.orders, firing_hz * sound.doppler,
                state.is_leaving ? Harmonics{} : toned(firing_hz, engine_db - 3.0, 1.3, engine_multiples),
                engine_multiples, out);

  if (sound.siren || state.siren.pressure_pa[0] != 0.0f) {
    const double hz = siren_hz(siren_of(sound.kind), sound.siren_s);
    const Harmonics on = toned(500.0, siren_db, 1.2, siren_multiples);
    add_harmonics(state.siren, hz * sound.doppler, sound.siren && here > 0.0 ? on : Harmonics{}, siren_multiples, out);
  }
  add_horn(state.horn_low, state.horn_high, sound.horn ? here * horn_pressure(horn_db) : 0.0, sound.doppler, out);

  if (sound.blow_mps > 0.0)
    state.blow.strike(pressure_pa(std::min(blow_at_1_mps_db + 20.0 * std::log10(sound.blow_mps), most_blow_db) + 12.0));
  if (!state.blow.is_over()) {
    static const float attack = attack_of(0.004), decay = decay_of(0.15);
    Ramp ramp(1.0, here);
    for (float& sample : out)
      sample += ramp.next() * state.blow.step(attack, decay) *
                state.blow_filter.step(blow_section(), state.rolling.noise.next());
  }
}

}  // namespace

void render_others(std::span<OtherState* const> states, std::span<Voice> voices) {
  std::vector<CabinWall*> walls;
  std::vector<Block*> blocks;
  for (std::size_t i = 0; i < states.size(); ++i) {
    voices[i].position_m = states[i]->last.position_m;
    voices[i].is_near = false;
    voices[i].echo = 1.0f;
    voices[i].samples.fill(0.0f);
    states[i]->wall.air_pole = air_pole(glm::length(states[i]->last.position_m));
    walls.push_back(&states[i]->wall);
    blocks.push_back(&voices[i].samples);
  }
  add_noises_of(states, voices);
  for (std::size_t i = 0; i < states.size(); ++i) add_tones_of(*states[i], voices[i]);
  apply_walls(walls, blocks);
}

}  // namespace septet::audio
