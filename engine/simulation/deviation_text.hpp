#pragma once
/// A run's departure from its table (given_motion.hpp) as text, as the run's session keeps it.

#include <string>
#include <string_view>

#include "engine/core/expected.hpp"
#include "engine/simulation/given_motion.hpp"

namespace septet::simulation {

/// Shares of the ± of time, x, y, heading, speed and yaw rate, to the last bit: "-0.25 0 0 0 0.5 1".
std::string deviation_text(const MotionDeviation& deviation);

/// Error: not six numbers of −1 to 1.
Expected<MotionDeviation> read_deviation(std::string_view text, std::string_view where);

}  // namespace septet::simulation
