#include "engine/audio/siren.hpp"

#include <cmath>

namespace septet::audio {

double siren_hz(std::span<const SirenTone> pattern, double time_s) {
  double whole_s = 0.0;
  for (const SirenTone& tone : pattern) whole_s += tone.seconds;
  double left_s = std::fmod(time_s, whole_s);
  for (const SirenTone& tone : pattern) {
    if (left_s < tone.seconds) return tone.from_hz + (tone.to_hz - tone.from_hz) * left_s / tone.seconds;
    left_s -= tone.seconds;
  }
  return pattern.front().from_hz;
}

}  // namespace septet::audio
