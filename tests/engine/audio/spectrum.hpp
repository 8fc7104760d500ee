#pragma once
/// Properties of a sound, for tests: power at a frequency, spectrum, A-weighted level.

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <span>
#include <vector>

#include "engine/audio/signal.hpp"

namespace septet::audio {

/// Power of one frequency, as of a sine of that mean square (Goertzel's sum, Hann's window).
inline double power_at(std::span<const float> samples, double hz) {
  std::complex<double> sum = 0.0;
  double weights = 0.0;
  const auto turn = std::polar(1.0, -2.0 * std::numbers::pi * hz / sample_rate_hz);
  const auto window_turn = std::polar(1.0, 2.0 * std::numbers::pi / static_cast<double>(samples.size()));
  std::complex<double> phasor = 1.0, window = 1.0;
  for (const float sample : samples) {
    const double weight = 0.5 - 0.5 * window.real();
    sum += double(sample) * weight * phasor;
    weights += weight;
    phasor = {phasor.real() * turn.real() - phasor.imag() * turn.imag(),
              phasor.real() * turn.imag() + phasor.imag() * turn.real()};
    window = {window.real() * window_turn.real() - window.imag() * window_turn.imag(),
              window.real() * window_turn.imag() + window.imag() * window_turn.real()};
  }
  return 2.0 * std::norm(sum / weights);
}

/// The loudest frequency within `low_hz` to `high_hz`.
inline double peak_hz(std::span<const float> samples, double low_hz, double high_hz, double step_hz = 0.2) {
  double best_hz = low_hz, best = -1.0;
  for (double hz = low_hz; hz <= high_hz; hz += step_hz)
    if (const double power = power_at(samples, hz); power > best) best = power, best_hz = hz;
  return best_hz;
}

/// Mean power of each of n/2 frequencies, i·48000/n Hz; n is a power of two, at most the number of samples.
inline std::vector<double> power_spectrum(std::span<const float> samples, std::size_t n) {
  std::vector<double> mean(n / 2, 0.0);
  std::size_t pieces = 0;
  for (std::size_t first = 0; first + n <= samples.size(); first += n / 2, ++pieces) {
    std::vector<std::complex<double>> values(n);
    for (std::size_t i = 0; i < n; ++i) {
      const double weight = std::sqrt(2.0 / 3.0) * (1.0 - std::cos(2.0 * std::numbers::pi * double(i) / double(n)));
      std::size_t turned = 0;
      for (std::size_t bit = 1, other = n / 2; bit < n; bit *= 2, other /= 2)
        if (i & bit) turned |= other;
      values[turned] = double(samples[first + i]) * weight;
    }
    for (std::size_t half = 1; half < n; half *= 2)
      for (std::size_t begin = 0; begin < n; begin += 2 * half)
        for (std::size_t k = 0; k < half; ++k) {
          const auto odd = std::polar(1.0, -std::numbers::pi * double(k) / double(half)) * values[begin + half + k];
          values[begin + half + k] = values[begin + k] - odd;
          values[begin + k] += odd;
        }
    for (std::size_t i = 1; i < n / 2; ++i) mean[i] += 2.0 * std::norm(values[i]) / (double(n) * double(n));
  }
  for (double& power : mean) power /= double(std::max<std::size_t>(pieces, 1));
  return mean;
}

inline double a_weighted_power(std::span<const float> samples) {
  constexpr std::size_t n = 8192;
  const auto spectrum = power_spectrum(samples, n);
  double power = 0.0;
  for (std::size_t i = 1; i < spectrum.size(); ++i) {
    const double weight = a_weight(double(i) * sample_rate_hz / double(n));
    power += spectrum[i] * weight * weight;
  }
  return power;
}

inline double mean_square(std::span<const float> samples) {
  double sum = 0.0;
  for (const float sample : samples) sum += double(sample) * double(sample);
  return samples.empty() ? 0.0 : sum / double(samples.size());
}

inline double decibels(double power_ratio) { return 10.0 * std::log10(power_ratio); }

}  // namespace septet::audio
