#include "engine/audio/layers.hpp"

#include <cmath>
#include <numbers>

namespace septet::audio {
namespace {

constexpr double wall_db = -11.0, wall_hz = 225.0;

float wall_pole() { return static_cast<float>(std::exp(-2.0 * std::numbers::pi * wall_hz / sample_rate_hz)); }
float wall_gain() { return static_cast<float>(std::pow(10.0, wall_db / 20.0)); }

}  // namespace

void add_noise(NoiseLayer& layer, const Shape& shape, double gain, Block& out) {
  if (gain == 0.0 && layer.gain == 0.0) {
    layer.first = layer.second = {};
    return;
  }
  Ramp ramp(layer.gain, gain);
  layer.gain = gain;
  for (float& sample : out)
    sample += ramp.next() * layer.second.step(shape.second, layer.first.step(shape.first, layer.noise.next()));
}

float attack_of(double seconds) { return static_cast<float>(1.0 - std::exp(-1.0 / (seconds * sample_rate_hz))); }
float decay_of(double seconds) { return static_cast<float>(std::exp(-1.0 / (seconds * sample_rate_hz))); }

void CabinWall::apply(Block& block) {
  const float pole = wall_pole(), gain = wall_gain() * (1.0f - pole);
  for (float& sample : block) {
    memory = pole * memory + gain * sample;
    sample = memory;
  }
}

double CabinWall::gain(double frequency_hz) {
  const double pole = wall_pole(), omega = 2.0 * std::numbers::pi * frequency_hz / sample_rate_hz;
  return wall_gain() * (1.0 - pole) / std::sqrt(1.0 - 2.0 * pole * std::cos(omega) + pole * pole);
}

}  // namespace septet::audio
