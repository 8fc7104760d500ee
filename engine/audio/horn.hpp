#pragma once
/// A horn of two tones, 400 and 500 Hz, with harmonics to 4 kHz.

#include "engine/audio/harmonics.hpp"

namespace septet::audio {

/// Peak pressure of its fundamentals where the whole has this level in dB(A).
double horn_pressure(double a_level_db);
/// Adds a block; it swells and fades within 20 ms.
void add_horn(Tone& low, Tone& high, double pressure_pa, double doppler, Block& out);

}  // namespace septet::audio
