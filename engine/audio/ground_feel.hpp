#pragma once
/// Road feedback of the driver's car, felt and heard: unevenness of the ground by its material, and the painted lines
/// under the wheels.
///
/// Unevenness is a class of ISO 8608: the power spectrum of a road's height over its length is Gd(n) = Gd(n0)·(n/n0)⁻²
/// with n0 = 0.1 cycles/m. Driven over at v, the velocity of that height is white: (2π·n0)²·Gd(n0)·v in every hertz, so
/// its size grows with the roots of Gd and of v. Pure functions; `place` is remembered by the caller from tick to tick.

#include <optional>
#include <string_view>

#include "engine/road/road_network.hpp"
#include "engine/road/road_position.hpp"
#include "engine/world/snapshot.hpp"

namespace septet::audio {

/// Gd(n0) in m³ at the middle of the classes A (very good) to F (ISO 8608:1995, annex C, table C.2).
inline constexpr double class_a_m3 = 16e-6, class_b_m3 = 64e-6, class_c_m3 = 256e-6, class_d_m3 = 1024e-6,
                        class_e_m3 = 4096e-6;

struct GroundFeel {
  double unevenness_m3 = class_a_m3;
  bool on_line = false;  ///< A front wheel rolls over paint.
};

/// By the word for a surface of a road file: asphalt, concrete, cobble, gravel, grass and their like; an unknown word
/// is a good road.
double unevenness_m3(std::string_view surface);

/// Root mean square of the vertical velocity of the ground under a wheel, within a band.
double ground_velocity_mps(double unevenness_m3, double speed_mps, double low_hz, double high_hz);

/// `place` is the car's last place, if any, and becomes the present one. Beside the road the ground is as even as a
/// meadow.
GroundFeel feel_ground(const road::RoadNetwork& roads, const Snapshot& snapshot,
                       std::optional<road::RoadPosition>& place, double wheelbase_m);

}  // namespace septet::audio
