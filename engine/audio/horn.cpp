#include "engine/audio/horn.hpp"

#include <cmath>

namespace septet::audio {
namespace {

constexpr double low_hz = 400.0, high_hz = 500.0;
constexpr std::size_t horn_multiples = 8;
constexpr double follows = 0.4;  // Share of the difference, each block.

double fallen(std::size_t n) { return std::pow(double(n), -0.8); }

void add_tone(Tone& tone, double hz, double pressure_pa, Block& out) {
  const double before = tone.pressure_pa[0];
  double now = before + (pressure_pa - before) * follows;
  if (pressure_pa == 0.0 && now < 1e-6) now = 0.0;
  Harmonics harmonics{};
  for (std::size_t n = 1; n <= horn_multiples; ++n) harmonics[n - 1] = static_cast<float>(now * fallen(n));
  add_harmonics(tone, hz, harmonics, horn_multiples, out);
}

}  // namespace

double horn_pressure(double a_level_db) {
  double power = 0.0;
  for (const double hz : {low_hz, high_hz})
    for (std::size_t n = 1; n <= horn_multiples; ++n) {
      const double weighted = fallen(n) * a_weight(hz * double(n));
      power += 0.5 * weighted * weighted;
    }
  return pressure_pa(a_level_db) / std::sqrt(power);
}

void add_horn(Tone& low, Tone& high, double pressure_pa, double doppler, Block& out) {
  if (pressure_pa == 0.0 && low.pressure_pa[0] == 0.0f) return;
  add_tone(low, low_hz * doppler, pressure_pa, out);
  add_tone(high, high_hz * doppler, pressure_pa, out);
}

}  // namespace septet::audio
