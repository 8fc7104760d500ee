#pragma once
/// Sounds of sirens: a pattern of tones that repeats. DIN 14610 requires two tones a fourth apart (4:3) between 360 and
/// 630 Hz; a′ and d″ are usual. The wail is that of SAE J1849: 500 to 1500 Hz and back, 20 times a minute. Pure
/// functions.

#include <span>

#include "engine/world/vehicle_model.hpp"

namespace septet::audio {

/// A tone that glides from one frequency to another.
struct SirenTone {
  double from_hz, to_hz, seconds;
};

inline constexpr SirenTone two_tone[] = {{440.0, 440.0, 0.75}, {1760.0 / 3.0, 1760.0 / 3.0, 0.75}};
inline constexpr SirenTone wail[] = {{500.0, 1500.0, 1.5}, {1500.0, 500.0, 1.5}};

/// Ambulances have the two tones; all other sirens wail.
inline std::span<const SirenTone> siren_of(ParticipantKind kind) {
  return kind == ParticipantKind::ambulance ? std::span<const SirenTone>(two_tone) : std::span<const SirenTone>(wail);
}

/// Frequency at a time of its melody, which repeats.
double siren_hz(std::span<const SirenTone> pattern, double time_s);

}  // namespace septet::audio
