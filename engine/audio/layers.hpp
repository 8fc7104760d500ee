#pragma once
/// The two kinds of sound besides tones: a layer of shaped noise, and a burst that fades. Plain states, a block at a
/// time.

#include <algorithm>
#include <span>

#include "engine/audio/signal.hpp"

namespace septet::audio {

/// Spectrum of a layer's noise; `unit_db` is its level in dB(A) before any gain.
struct Shape {
  Section first, second;
  double unit_db;
  Shape(const Section& one, const Section& two) : first(one), second(two), unit_db(a_level_of_noise_db(one, two)) {}
  /// The gain with which it has this level in dB(A).
  double gain(double a_level_db) const { return pressure_pa(a_level_db) / pressure_pa(unit_db); }
};

/// Noise through a shape.
struct NoiseLayer {
  Noise noise;
  Filter first, second;
  double gain = 0.0;  ///< At the end of the last block.
};
/// Adds a block whose gain goes from that of the last to this one. Silence is skipped.
void add_noise(NoiseLayer& layer, const Shape& shape, double gain, Block& out);

/// Adds several layers of one shape, four at a time: a filter waits for itself, and four wait together. The samples are
/// those of one after the other, whatever their neighbours.
struct NoisePart {
  NoiseLayer* layer = nullptr;
  double gain = 0.0;
  Block* out = nullptr;
};
void add_noises(std::span<const NoisePart> parts, const Shape& shape);

/// A sound that begins within 1 to 5 ms and fades: its envelope follows a value that decays, so it has no edge.
struct Burst {
  float drive = 0.0f, envelope = 0.0f;
  void strike(double pressure_pa) { drive = std::max(drive, static_cast<float>(pressure_pa)); }
  bool is_over() const { return envelope < 1e-7f && drive < 1e-7f; }
  float step(float attack, float decay) {
    drive *= decay;
    envelope += (drive - envelope) * attack;
    return envelope;
  }
};
/// Coefficients of a burst's step for a time constant.
float attack_of(double seconds);
float decay_of(double seconds);

/// Through several walls, four at a time.
struct CabinWall;
void apply_walls(std::span<CabinWall* const> walls, std::span<Block* const> blocks);

/// Attenuation from a source outside to the ear. The car's body, windows shut: −12 dB at 125 Hz, −24 at 1 kHz, −30 at 2
/// kHz: 11 dB and one pole at 225 Hz. Before it the air as one pole, which takes 5 dB of every 100 m at 5 kHz (ISO
/// 9613-1 at 10 °C and 70 %) and the first 100 m 0.4 at 1 kHz.
struct CabinWall {
  float memory = 0.0f;
  float air_memory = 0.0f, air_pole = 0.0f;  ///< 0: no air.
  static double gain(double frequency_hz);
};
/// The pole with the air's absorption at 5 kHz over that distance.
float air_pole(double way_m);

}  // namespace septet::audio
