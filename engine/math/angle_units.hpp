#pragma once
/// Degrees, where people read or write them; everything else is in radians.

namespace septet {

inline constexpr double degrees_per_radian = 57.295779513082320877;
inline constexpr double radians_per_degree = 0.017453292519943295769;

}  // namespace septet
