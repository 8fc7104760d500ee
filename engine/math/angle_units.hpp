#pragma once
/// Degrees, where people read or write them; everything else is in radians.

namespace septet {

inline constexpr double degrees_per_radian = 57.295779513082320877;

}  // namespace septet
