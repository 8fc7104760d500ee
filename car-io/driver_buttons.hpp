#pragma once
/// The driver's two-state controls, in the order of the input report's bits (REPORTS.md) and of the buttons that games
/// see.

#include <array>

#include "engine/world/driver_input.hpp"

namespace septet::car_io {

inline std::array<bool, 7> driver_buttons(const DriverInput& input) {
  return {input.indicator == IndicatorStalk::left,
          input.indicator == IndicatorStalk::right,
          input.hazard_lights,
          input.horn,
          input.low_beam,
          input.high_beam,
          input.parking_brake};
}

}  // namespace septet::car_io
