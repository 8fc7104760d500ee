#pragma once
/// Elements of sounds: noise, filters of second order, ramps. Plain states and inline steps, one sample each.
///
/// A sample is a pressure in pascal: a root mean square of 1 is 94 dB, and ±1 is the full scale of a device or a file.
/// Levels with an A are weighted by the A curve of IEC 61672-1. Filters: R. Bristow-Johnson's formulas for second-order
/// sections ("Cookbook formulae for audio equalizer biquad filter coefficients"). Threads: no shared state.

#include <array>
#include <cstddef>
#include <cstdint>

namespace septet::audio {

inline constexpr double sample_rate_hz = 48000.0;
/// Samples of one block: those of one tick (1/120 s).
inline constexpr std::size_t block_samples = 400;
inline constexpr double block_s = double(block_samples) / sample_rate_hz;
using Block = std::array<float, block_samples>;

/// Pressure (root mean square, Pa) of a level in dB above 20 µPa, where 94 dB are 1 Pa.
double pressure_pa(double level_db);
double level_db(double pressure_pa);

/// Weight of the A curve as a factor of the pressure: 1 at 1 kHz.
double a_weight(double frequency_hz);

/// White noise of variance 1, evenly distributed (Marsaglia's xorshift of 32 bits).
struct Noise {
  std::uint32_t bits = 1;  ///< Never 0.
  float next() {
    bits ^= bits << 13;
    bits ^= bits >> 17;
    bits ^= bits << 5;
    return static_cast<float>(static_cast<std::int32_t>(bits)) * (1.7320508f / 2147483648.0f);
  }
};

/// Coefficients of a section of second order, H = (b0 + b1/z + b2/z²) / (1 + a1/z + a2/z²).
struct Section {
  float b0 = 1.0f, b1 = 0.0f, b2 = 0.0f, a1 = 0.0f, a2 = 0.0f;
  static Section low_pass(double frequency_hz, double quality);
  static Section high_pass(double frequency_hz, double quality);
  static Section band_pass(double frequency_hz, double quality);  ///< 0 dB at its frequency.
  double gain(double frequency_hz) const;
};

/// A section with its memory (transposed direct form II).
struct Filter {
  float s1 = 0.0f, s2 = 0.0f;
  float step(const Section& c, float in) {
    const float out = c.b0 * in + s1;
    s1 = c.b1 * in - c.a1 * out + s2;
    s2 = c.b2 * in - c.a2 * out;
    return out;
  }
};

/// Level in dB(A) of white noise of variance 1 Pa² behind two sections: the reference of a layer's gain.
double a_level_of_noise_db(const Section& first, const Section& second);

/// A linear ramp from one value to the next over a block: gains never step.
struct Ramp {
  float value, step;
  Ramp(double from, double to)
      : value(static_cast<float>(from)), step(static_cast<float>((to - from) / double(block_samples))) {}
  float next() { return value += step; }
};

}  // namespace septet::audio
