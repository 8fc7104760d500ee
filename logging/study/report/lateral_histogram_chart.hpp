#pragma once
/// Lateral position within the lane in the form of figure 5 of Lebram, Engström and Gustavsson 2006, with that paper's
/// printed values.

#include <string>
#include <string_view>

#include "logging/study/measures/lateral_position.hpp"

namespace septet::logging {

/// 21 bars as an `svg` element. The paper's text gives one height alone, that of its centre bar, almost 25 % of 413 973
/// samples: a line.
std::string lateral_histogram_svg(const LateralPositionHistogram& histogram, std::string_view title);

}  // namespace septet::logging
