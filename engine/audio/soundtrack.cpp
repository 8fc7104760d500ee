#include "engine/audio/soundtrack.hpp"

#include <algorithm>
#include <bit>
#include <span>

#include "engine/audio/other_sound.hpp"
#include "engine/audio/own_sound.hpp"

namespace septet::audio {
namespace {

std::uint32_t seed(Random& random) { return static_cast<std::uint32_t>(random.next_bits() >> 32) | 1u; }

/// Replaces NaN and infinities, so that none leaves here.
void make_finite(Block& block) {
  constexpr std::uint32_t exponent = 0x7F800000u;  // All of its bits are set in infinities and NaN.
  std::uint32_t bad = 0;
  for (const float sample : block) bad |= (std::bit_cast<std::uint32_t>(sample) & exponent) == exponent ? 1u : 0u;
  if (bad == 0) return;
  block.fill(0.0f);
}

}  // namespace

State start(const CarSound& car, const Random& random) {
  State state;
  state.car = car;
  state.random = random;
  const auto give = [&](NoiseLayer& layer) { layer.noise.bits = seed(state.random); };
  OwnState& own = state.own;
  for (NoiseLayer* layer : {&own.mechanical, &own.intake, &own.rain_hiss, &own.low_road, &own.wind[0], &own.wind[1]})
    give(*layer);
  for (OwnState::Tyre& tyre : own.tyres)
    for (NoiseLayer* layer : {&tyre.air, &tyre.structure, &tyre.spray, &tyre.gravel, &tyre.skid}) give(*layer);
  own.drops.bits = seed(state.random);
  own.sparks.bits = seed(state.random);
  return state;
}

void render(State& state, const Heard& heard, std::vector<Voice>& voices) {
  voices.resize(own_voices);
  render_own(state.own, state.car, heard.car, voices);
  for (auto& [id, other] : state.others) other.is_leaving = true;
  for (const OtherSound& sound : heard.others) {
    const auto [place, is_new] = state.others.try_emplace(sound.id);
    OtherState& other = place->second;
    if (is_new) begin_other(other, sound, seed(state.random), seed(state.random));
    other.last = sound;
    other.is_leaving = false;
  }
  std::vector<OtherState*> others;
  for (auto& [id, other] : state.others) {
    voices.emplace_back().key = id + 256ull;
    others.push_back(&other);
  }
  render_others(others, std::span(voices).subspan(own_voices));
  std::erase_if(state.others, [](const auto& other) { return other.second.is_leaving; });
  for (Voice& voice : voices) make_finite(voice.samples);
}

}  // namespace septet::audio
