#include "engine/audio/harmonics.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace septet::audio {
namespace {

constexpr std::size_t lanes = 8;
constexpr double highest_hz = 16000.0;

}  // namespace

void add_harmonics(Tone& tone, double hz, const Harmonics& pressure_pa, std::size_t count, Block& out) {
  static_assert(block_samples % lanes == 0);
  const double from_hz = tone.hz > 0.0 ? tone.hz : hz;
  const double fastest_hz = std::max({from_hz, hz, 1.0});
  count = std::min({count, most_harmonics, static_cast<std::size_t>(highest_hz / fastest_hz)});
  const Harmonics from = tone.pressure_pa;
  bool silent = true;
  for (std::size_t h = 0; h < count; ++h) silent = silent && from[h] == 0.0f && pressure_pa[h] == 0.0f;
  tone.hz = hz;
  tone.pressure_pa = {};
  std::copy_n(pressure_pa.begin(), count, tone.pressure_pa.begin());
  if (silent) {
    tone.phase += 0.5 * (from_hz + hz) * double(block_samples) / sample_rate_hz;
    tone.phase -= std::floor(tone.phase);
    return;
  }
  double phase = tone.phase;
  for (std::size_t first = 0; first < block_samples; first += lanes) {
    std::array<float, lanes> before{}, now, twice_cosine, sum{};
    // Within eight samples the frequency stands still, so that one turn leads from each to the next.
    const double t = (double(first) + 0.5 * double(lanes)) / double(block_samples);
    const double turns = (from_hz + (hz - from_hz) * t) / sample_rate_hz;
    const double angle = 2.0 * std::numbers::pi * phase, step = 2.0 * std::numbers::pi * turns;
    const double step_sine = std::sin(step), step_cosine = std::cos(step);
    double sine = std::sin(angle), cosine = std::cos(angle);
    for (std::size_t i = 0; i < lanes; ++i) {
      const double next_sine = sine * step_cosine + cosine * step_sine;
      cosine = cosine * step_cosine - sine * step_sine;
      sine = next_sine;
      now[i] = static_cast<float>(sine);
      twice_cosine[i] = static_cast<float>(2.0 * cosine);
    }
    phase += double(lanes) * turns;
    const float share = static_cast<float>(first + lanes) / static_cast<float>(block_samples);
    for (std::size_t h = 0; h < count; ++h) {
      const float pressure = from[h] + (pressure_pa[h] - from[h]) * share;
      for (std::size_t i = 0; i < lanes; ++i) {
        sum[i] += pressure * now[i];
        const float next = twice_cosine[i] * now[i] - before[i];
        before[i] = now[i];
        now[i] = next;
      }
    }
    for (std::size_t i = 0; i < lanes; ++i) out[first + i] += sum[i];
  }
  tone.phase = phase - std::floor(phase);
}

}  // namespace septet::audio
