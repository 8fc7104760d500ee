#pragma once
/// Acceleration of gravity for all models: vehicles, debris, forces on the driver.

namespace septet {

inline constexpr double gravity_mps2 = 9.81;

}  // namespace septet
