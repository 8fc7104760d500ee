#pragma once
/// The acceleration of gravity that everything falls with: vehicles, debris, what a driver feels.

namespace septet {

inline constexpr double gravity_mps2 = 9.81;

}  // namespace septet
