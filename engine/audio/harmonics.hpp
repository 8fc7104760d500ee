#pragma once
/// A sum of sines whose frequencies are the whole multiples of one: an engine by its orders, a horn, a siren.
///
/// sin((h+1)θ) = 2·cosθ·sin(hθ) − sin((h−1)θ), for eight samples at a time. Frequency and amplitudes are interpolated
/// linearly from one block to the next, the amplitudes in steps of eight samples, so that there are no clicks. Pure
/// functions over plain states.

#include <array>
#include <cstddef>

#include "engine/audio/signal.hpp"

namespace septet::audio {

inline constexpr std::size_t most_harmonics = 64;
/// Peak pressure of each multiple, from the fundamental on.
using Harmonics = std::array<float, most_harmonics>;

/// Fundamental and amplitudes at the end of the last block.
struct Tone {
  double phase = 0.0;  ///< In turns, 0 to 1.
  double hz = 0.0;
  Harmonics pressure_pa{};
};

/// Adds a block of the first `count` harmonics to `out`, those at most that stay below 16 kHz.
void add_harmonics(Tone& tone, double hz, const Harmonics& pressure_pa, std::size_t count, Block& out);
/// Adds two tones of one frequency that have always been rendered together: the sines are made once.
void add_harmonics(const std::array<Tone*, 2>& tones, double hz, const std::array<const Harmonics*, 2>& pressures_pa,
                   std::size_t count, const std::array<Block*, 2>& out);

}  // namespace septet::audio
