#include "engine/audio/layers.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>

namespace septet::audio {
namespace {

constexpr double wall_db = -11.0, wall_hz = 225.0;

float wall_pole() { return static_cast<float>(std::exp(-2.0 * std::numbers::pi * wall_hz / sample_rate_hz)); }
float wall_gain() { return static_cast<float>(std::pow(10.0, wall_db / 20.0)); }

}  // namespace

void add_noise(NoiseLayer& layer, const Shape& shape, double gain, Block& out) {
  const NoisePart one{&layer, gain, &out};
  add_noises(std::span(&one, 1), shape);
}

namespace {

constexpr std::size_t together = 4;

/// Four layers' memories side by side. An absent one has gain 0.
void add_four(std::span<const NoisePart> parts, const Shape& shape) {
  std::array<std::uint32_t, together> bits;
  std::array<float, together> first1{}, first2{}, second1{}, second2{}, gain{}, step{};
  bits.fill(1);
  for (std::size_t i = 0; i < parts.size(); ++i) {
    NoiseLayer& layer = *parts[i].layer;
    const Ramp ramp(layer.gain, parts[i].gain);
    bits[i] = layer.noise.bits;
    first1[i] = layer.first.s1, first2[i] = layer.first.s2;
    second1[i] = layer.second.s1, second2[i] = layer.second.s2;
    gain[i] = ramp.value, step[i] = ramp.step;
  }
  const Section a = shape.first, b = shape.second;
  std::array<std::array<float, together>, block_samples> made;
  for (auto& sample : made)
    for (std::size_t i = 0; i < together; ++i) {
      // Noise::next and Filter::step, of four.
      std::uint32_t x = bits[i];
      x ^= x << 13;
      x ^= x >> 17;
      x ^= x << 5;
      bits[i] = x;
      const float in = static_cast<float>(static_cast<std::int32_t>(x)) * (1.7320508f / 2147483648.0f);
      const float middle = a.b0 * in + first1[i];
      first1[i] = a.b1 * in - a.a1 * middle + first2[i];
      first2[i] = a.b2 * in - a.a2 * middle;
      const float out = b.b0 * middle + second1[i];
      second1[i] = b.b1 * middle - b.a1 * out + second2[i];
      second2[i] = b.b2 * middle - b.a2 * out;
      gain[i] += step[i];
      sample[i] = gain[i] * out;
    }
  for (std::size_t i = 0; i < parts.size(); ++i) {
    NoiseLayer& layer = *parts[i].layer;
    layer.noise.bits = bits[i];
    layer.first = {first1[i], first2[i]};
    layer.second = {second1[i], second2[i]};
    layer.gain = parts[i].gain;
    Block& out = *parts[i].out;
    for (std::size_t n = 0; n < block_samples; ++n) out[n] += made[n][i];
  }
}

}  // namespace

void add_noises(std::span<const NoisePart> parts, const Shape& shape) {
  std::array<NoisePart, together> some;
  std::size_t count = 0;
  for (const NoisePart& part : parts) {
    if (part.gain == 0.0 && part.layer->gain == 0.0) {
      part.layer->first = part.layer->second = {};
      continue;
    }
    some[count++] = part;
    if (count < together) continue;
    add_four(some, shape);
    count = 0;
  }
  if (count > 0) add_four(std::span(some).first(count), shape);
}

float attack_of(double seconds) { return static_cast<float>(1.0 - std::exp(-1.0 / (seconds * sample_rate_hz))); }
float decay_of(double seconds) { return static_cast<float>(std::exp(-1.0 / (seconds * sample_rate_hz))); }

void apply_walls(std::span<CabinWall* const> walls, std::span<Block* const> blocks) {
  static const float pole = wall_pole(), gain = wall_gain() * (1.0f - pole);
  Block unused{};
  for (std::size_t first = 0; first < walls.size(); first += together) {
    const std::size_t count = std::min(together, walls.size() - first);
    std::array<float, together> memory{}, air{}, air_pole{};
    std::array<float*, together> samples;
    samples.fill(unused.data());
    for (std::size_t i = 0; i < count; ++i) {
      memory[i] = walls[first + i]->memory;
      air[i] = walls[first + i]->air_memory;
      air_pole[i] = walls[first + i]->air_pole;
      samples[i] = blocks[first + i]->data();
    }
    for (std::size_t n = 0; n < block_samples; ++n)
      for (std::size_t i = 0; i < together; ++i) {
        air[i] = samples[i][n] + air_pole[i] * (air[i] - samples[i][n]);
        memory[i] = pole * memory[i] + gain * air[i];
        samples[i][n] = memory[i];
      }
    for (std::size_t i = 0; i < count; ++i) {
      walls[first + i]->memory = memory[i];
      walls[first + i]->air_memory = air[i];
    }
  }
}

float air_pole(double way_m) {
  constexpr double at_hz = 5000.0, db_per_m = 0.05, farthest_m = 2000.0;
  const double way = std::isfinite(way_m) ? std::clamp(way_m, 0.0, farthest_m) : farthest_m;
  const double power = std::pow(10.0, -0.1 * db_per_m * way);
  if (power > 1.0 - 1e-9) return 0.0f;
  // (1 − p)² / (1 − 2p·cos ω + p²) is that power.
  const double cosine = std::cos(2.0 * std::numbers::pi * at_hz / sample_rate_hz);
  const double half = (1.0 - power * cosine) / (1.0 - power);
  return static_cast<float>(half - std::sqrt(half * half - 1.0));
}

double CabinWall::gain(double frequency_hz) {
  const double pole = wall_pole(), omega = 2.0 * std::numbers::pi * frequency_hz / sample_rate_hz;
  return wall_gain() * (1.0 - pole) / std::sqrt(1.0 - 2.0 * pole * std::cos(omega) + pole * pole);
}

}  // namespace septet::audio
