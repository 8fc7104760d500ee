#pragma once
/// Loudness of all sounds: the one table of sound levels, in dB(A) unless it says otherwise. Engineer's values where no
/// source is named.
///
/// Inside the driver's car with windows shut: 57–60, 64–67 and 68–71 dB(A) at 50, 100 and 130 km/h, a middle-class
/// car's; wind grows by 16 dB as its speed doubles (NVH Basics 9, 2010), rolling by 34 dB as it grows tenfold and with
/// its most at 1 kHz (CNOSSOS-EU 2020, cars, 50 to 130 km/h). Outside: power over half a sphere, 8 dB more than the
/// level at 1 m. Pure functions.

#include <algorithm>
#include <cmath>

#include "engine/audio/heard.hpp"

namespace septet::audio {

inline constexpr double reference_speed_mps = 100.0 / 3.6;

// Inside.
inline double rolling_inside_db(double speed_mps) {
  return 61.5 + 34.0 * std::log10(std::max(std::abs(speed_mps), 0.3) / reference_speed_mps);
}
inline double wind_inside_db(double air_mps) {
  return 61.5 + 53.15 * std::log10(std::max(air_mps, 1.0) / reference_speed_mps);
}
/// Level of the engine's firing order (unweighted): on the overrun without fuel 12 dB less.
inline double firing_order_db(double engine_hz, double load, bool fuel_cut) {
  return 69.0 + 3.0 * std::log2(std::max(engine_hz, 3.0) / 30.0) + 9.0 * load - (fuel_cut ? 12.0 : 0.0);
}
/// Moving parts and combustion of the engine, besides the orders.
inline double engine_noise_db(double engine_hz, double load, bool fuel_cut) {
  return 50.6 + 7.0 * std::log2(std::max(engine_hz, 3.0) / 30.0) + 9.0 * load - (fuel_cut ? 4.0 : 0.0);
}
/// Intake: 14 dB more with the throttle open.
inline double intake_db(double engine_hz, double load) {
  return 42.0 + 9.0 * std::log2(std::max(engine_hz, 3.0) / 30.0) + 14.0 * (load - 0.2);
}
inline constexpr double gear_whine_at_100_kmh_db = 38.0, reverse_whine_more_db = 14.0;
inline constexpr double skid_db = 80.0;   ///< A sliding tyre.
inline constexpr double relay_db = 58.0;  ///< Peak of a click, unweighted.
inline constexpr double own_horn_db = 84.0;
inline constexpr double rain_at_15_mm_per_h_db = 58.0;
inline constexpr double blow_at_1_mps_db = 88.0, most_blow_db = 108.0;  ///< Unweighted, at the beginning.
inline constexpr double piece_db = 74.0;

// Outside, dB(A) at 1 m.
inline constexpr double siren_db = 110.0 + 10.9;  ///< 110 at 3.5 m (DIN 14610).
inline constexpr double horn_db = 93.0 + 16.9;    ///< 93 at 7 m (UN R28).
/// Excess over a car, whose wheels have 102.6 dB(A) of power at 70 km/h and whose engine and exhaust have 93.0
/// (CNOSSOS-EU 2020): lorries 8 dB more.
inline double heavy_db(ParticipantKind kind) {
  switch (kind) {
    case ParticipantKind::lorry:
    case ParticipantKind::bus:
      return 8.0;
    case ParticipantKind::van:
    case ParticipantKind::ambulance:
      return 2.0;
    case ParticipantKind::bicycle:
      return -30.0;
    case ParticipantKind::pedestrian:
    case ParticipantKind::object:
      return -200.0;
    default:
      return 0.0;
  }
}
inline double rolling_outside_db(ParticipantKind kind, double speed_mps) {
  return 102.6 - 8.0 + heavy_db(kind) + 34.0 * std::log10(std::max(speed_mps, 0.3) * 3.6 / 70.0);
}
inline double propulsion_outside_db(ParticipantKind kind, double speed_mps, double load) {
  const double standing_db =
      -12.0 * std::max(0.0, 1.0 - speed_mps * 3.6 / 20.0);  // Below 20 km/h, where the table ends.
  if (kind == ParticipantKind::bicycle) return -200.0;
  return 93.0 - 8.0 + standing_db + heavy_db(kind) + 8.0 * (speed_mps * 3.6 - 70.0) / 70.0 + 4.4 * (load - 0.15) / 0.3;
}
inline double level_at_1_m_db(const OtherSound& sound) {
  double level = std::max(rolling_outside_db(sound.kind, sound.speed_mps),
                          propulsion_outside_db(sound.kind, sound.speed_mps, sound.load));
  if (sound.horn) level = std::max(level, horn_db);
  if (sound.siren) level = std::max(level, siren_db);
  if (sound.blow_mps > 0.0) level = std::max(level, most_blow_db);
  return level;
}

/// Assumed engine speed of another vehicle, which snapshots do not hold: from 800 to 3000 turns a minute in each of
/// five gears.
inline double supposed_engine_hz(ParticipantKind kind, double speed_mps) {
  const bool heavy = kind == ParticipantKind::lorry || kind == ParticipantKind::bus;
  const double idle_hz = heavy ? 9.0 : 13.3, shift_hz = heavy ? 30.0 : 45.0;
  double gear_mps = heavy ? 5.0 : 8.5;  // Speed at which the gear reaches its shift.
  for (int gear = 1; gear < 5 && speed_mps > gear_mps; ++gear) gear_mps *= 1.55;
  return std::clamp(shift_hz * speed_mps / gear_mps, idle_hz, 1.5 * shift_hz);
}

}  // namespace septet::audio
