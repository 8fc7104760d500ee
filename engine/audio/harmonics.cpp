#include "engine/audio/harmonics.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

namespace septet::audio {
namespace {

constexpr std::size_t lanes = 8;
constexpr double highest_hz = 16000.0;

}  // namespace

void add_harmonics(Tone& tone, double hz, const Harmonics& pressure_pa, std::size_t count, Block& out) {
  static_assert(block_samples % lanes == 0);
  if (!std::isfinite(hz)) {
    tone = {};  // No tone, until there is a frequency again.
    return;
  }
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
  // Within eight samples the frequency stands still, so that one turn leads from each to the next; another leads from turn to turn.
  constexpr double groups = double(block_samples) / double(lanes), turn_rad = 2.0 * std::numbers::pi;
  using Turn = std::complex<double>;
  const auto times = [](const Turn& a, const Turn& b) {
    return Turn(a.real() * b.real() - a.imag() * b.imag(), a.real() * b.imag() + a.imag() * b.real());
  };
  const double change_hz = (hz - from_hz) / groups;
  const Turn faster = std::polar(1.0, turn_rad * change_hz / sample_rate_hz);
  Turn step = std::polar(1.0, turn_rad * (from_hz + 0.5 * change_hz) / sample_rate_hz);
  Turn place = std::polar(1.0, turn_rad * tone.phase);
  for (std::size_t first = 0; first < block_samples; first += lanes) {
    std::array<float, lanes> before{}, now, twice_cosine, sum{};
    for (std::size_t i = 0; i < lanes; ++i) {
      place = times(place, step);
      now[i] = static_cast<float>(place.imag());
      twice_cosine[i] = static_cast<float>(2.0 * place.real());
    }
    step = times(step, faster);
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
  tone.phase += 0.5 * (from_hz + hz) * double(block_samples) / sample_rate_hz;
  tone.phase -= std::floor(tone.phase);
}

}  // namespace septet::audio
