#include "engine/audio/signal.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

namespace septet::audio {
namespace {

constexpr double reference_db = 94.0;  // Level of 1 Pa above 20 µPa: 93.98.

struct Angle {
  double cosine, alpha;
};
Angle angle_of(double frequency_hz, double quality) {
  const double omega = 2.0 * std::numbers::pi * frequency_hz / sample_rate_hz;
  return {std::cos(omega), std::sin(omega) / (2.0 * quality)};
}

Section section(double b0, double b1, double b2, const Angle& angle) {
  const double a0 = 1.0 + angle.alpha;
  return {float(b0 / a0), float(b1 / a0), float(b2 / a0), float(-2.0 * angle.cosine / a0),
          float((1.0 - angle.alpha) / a0)};
}

}  // namespace

double pressure_pa(double level) { return std::pow(10.0, (level - reference_db) / 20.0); }
double level_db(double pressure) { return reference_db + 20.0 * std::log10(std::max(pressure, 1e-12)); }

double a_weight(double frequency_hz) {
  const double f2 = frequency_hz * frequency_hz;
  const double a =
      12194.0 * 12194.0 * f2 * f2 /
      ((f2 + 20.6 * 20.6) * std::sqrt((f2 + 107.7 * 107.7) * (f2 + 737.9 * 737.9)) * (f2 + 12194.0 * 12194.0));
  return a * 1.2589;  // 2 dB
}

Section Section::low_pass(double frequency_hz, double quality) {
  const Angle angle = angle_of(frequency_hz, quality);
  const double b = 1.0 - angle.cosine;
  return section(b / 2.0, b, b / 2.0, angle);
}

Section Section::high_pass(double frequency_hz, double quality) {
  const Angle angle = angle_of(frequency_hz, quality);
  const double b = 1.0 + angle.cosine;
  return section(b / 2.0, -b, b / 2.0, angle);
}

Section Section::band_pass(double frequency_hz, double quality) {
  const Angle angle = angle_of(frequency_hz, quality);
  return section(angle.alpha, 0.0, -angle.alpha, angle);
}

double Section::gain(double frequency_hz) const {
  const std::complex<double> z1 = std::polar(1.0, -2.0 * std::numbers::pi * frequency_hz / sample_rate_hz);
  const std::complex<double> z2 = z1 * z1;
  return std::abs((double(b0) + double(b1) * z1 + double(b2) * z2) / (1.0 + double(a1) * z1 + double(a2) * z2));
}

double a_level_of_noise_db(const Section& first, const Section& second) {
  // Trapezoids in the logarithm of the frequency; the power of white noise is even over 0 to half of the sample rate.
  constexpr double low_hz = 10.0, high_hz = sample_rate_hz / 2.0;
  constexpr int steps = 400;
  double power = 0.0;
  for (int i = 0; i < steps; ++i) {
    const double f = low_hz * std::pow(high_hz / low_hz, (i + 0.5) / steps);
    const double width = f * std::log(high_hz / low_hz) / steps;
    const double gain = first.gain(f) * second.gain(f) * a_weight(f);
    power += gain * gain * width / high_hz;
  }
  return level_db(std::sqrt(power));
}

}  // namespace septet::audio
