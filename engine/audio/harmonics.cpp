#include "engine/audio/harmonics.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

namespace septet::audio {
namespace {

constexpr std::size_t lanes = 8;
constexpr double highest_hz = 16000.0;

/// One set of amplitudes on the common sines, for one block.
struct Part {
  Tone& tone;
  const Harmonics& pressure_pa;
  Block& out;
  Harmonics from{};
};

/// Parts have the same phase and frequency: the first one's.
template <std::size_t parts_count>
void add(std::array<Part, parts_count> parts, double hz, std::size_t count) {
  static_assert(block_samples % lanes == 0);
  Tone& tone = parts.front().tone;
  if (!std::isfinite(hz)) {
    for (const Part& part : parts) part.tone = {};  // No tone, until there is a frequency again.
    return;
  }
  const double from_hz = tone.hz > 0.0 ? tone.hz : hz;
  const double fastest_hz = std::max({from_hz, hz, 1.0});
  count = std::min({count, most_harmonics, static_cast<std::size_t>(highest_hz / fastest_hz)});
  // Harmonics above the highest audible one are skipped.
  std::size_t sounding = 0;
  double phase = tone.phase + 0.5 * (from_hz + hz) * double(block_samples) / sample_rate_hz;
  phase -= std::floor(phase);
  const double began = tone.phase;
  for (Part& part : parts) {
    part.from = part.tone.pressure_pa;
    part.tone = {.phase = phase, .hz = hz, .pressure_pa = {}};
    std::copy_n(part.pressure_pa.begin(), count, part.tone.pressure_pa.begin());
    std::size_t highest = count;
    while (highest > 0 && part.from[highest - 1] == 0.0f && part.pressure_pa[highest - 1] == 0.0f) --highest;
    sounding = std::max(sounding, highest);
  }
  if (sounding == 0) return;
  // Within eight samples the frequency is constant, so that one rotation leads from each to the next; another leads
  // from rotation to rotation.
  constexpr double groups = double(block_samples) / double(lanes), turn_rad = 2.0 * std::numbers::pi;
  using Turn = std::complex<double>;
  const auto times = [](const Turn& a, const Turn& b) {
    return Turn(a.real() * b.real() - a.imag() * b.imag(), a.real() * b.imag() + a.imag() * b.real());
  };
  const double change_hz = (hz - from_hz) / groups;
  const Turn faster = std::polar(1.0, turn_rad * change_hz / sample_rate_hz);
  const Turn step = std::polar(1.0, turn_rad * (from_hz + 0.5 * change_hz) / sample_rate_hz);
  Turn place = std::polar(1.0, turn_rad * began);
  // Rotation of each of the eight samples against the end of the eight before, and its growth from these to those.
  std::array<double, lanes> turned_re, turned_im, growth_re, growth_im;
  Turn turned = 1.0, growth = 1.0;
  for (std::size_t i = 0; i < lanes; ++i) {
    turned = times(turned, step);
    growth = times(growth, faster);
    turned_re[i] = turned.real(), turned_im[i] = turned.imag();
    growth_re[i] = growth.real(), growth_im[i] = growth.imag();
  }
  for (std::size_t first = 0; first < block_samples; first += lanes) {
    std::array<float, lanes> before{}, now, twice_cosine;
    std::array<std::array<float, lanes>, parts_count> sum{};
    const double re = place.real(), im = place.imag();
    place = times(place, Turn(turned_re[lanes - 1], turned_im[lanes - 1]));
    for (std::size_t i = 0; i < lanes; ++i) {
      now[i] = static_cast<float>(re * turned_im[i] + im * turned_re[i]);
      twice_cosine[i] = static_cast<float>(2.0 * (re * turned_re[i] - im * turned_im[i]));
      const double next_re = turned_re[i] * growth_re[i] - turned_im[i] * growth_im[i];
      turned_im[i] = turned_re[i] * growth_im[i] + turned_im[i] * growth_re[i];
      turned_re[i] = next_re;
    }
    const float share = static_cast<float>(first + lanes) / static_cast<float>(block_samples);
    for (std::size_t h = 0; h < sounding; ++h) {
      for (std::size_t p = 0; p < parts_count; ++p) {
        const float from = parts[p].from[h], pressure = from + (parts[p].pressure_pa[h] - from) * share;
        for (std::size_t i = 0; i < lanes; ++i) sum[p][i] += pressure * now[i];
      }
      for (std::size_t i = 0; i < lanes; ++i) {
        const float next = twice_cosine[i] * now[i] - before[i];
        before[i] = now[i];
        now[i] = next;
      }
    }
    for (std::size_t p = 0; p < parts_count; ++p)
      for (std::size_t i = 0; i < lanes; ++i) parts[p].out[first + i] += sum[p][i];
  }
}

}  // namespace

void add_harmonics(Tone& tone, double hz, const Harmonics& pressure_pa, std::size_t count, Block& out) {
  add(std::array<Part, 1>{{{tone, pressure_pa, out}}}, hz, count);
}

void add_harmonics(const std::array<Tone*, 2>& tones, double hz, const std::array<const Harmonics*, 2>& pressures_pa,
                   std::size_t count, const std::array<Block*, 2>& out) {
  add(std::array<Part, 2>{{{*tones[0], *pressures_pa[0], *out[0]}, {*tones[1], *pressures_pa[1], *out[1]}}}, hz, count);
}

}  // namespace septet::audio
