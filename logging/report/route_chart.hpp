#pragma once
/// The way that a car went, seen from above: a metre is as long along both axes, and the box is as flat as the way. Each stretch has
/// the colour of its class of speed, a legend says which, and moments can be marked on it.

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "logging/records.hpp"

namespace septet::logging {

/// A moment to mark. Those that lie on each other in the picture share a dot.
struct RouteMark {
  double time_s = 0.0;
  std::string label;  ///< A character or two; of a moment without one there is only the dot.
  std::string tip;    ///< Shown by the browser over the dot.
};

inline constexpr std::size_t route_speed_classes = 7;

/// How wide a class of speed is, so that no more than `route_speed_classes` reach up to the largest speed: 5, 10, 20, 25, 50, 100 … km/h.
double speed_class_width_kmh(double largest_kmh);

/// An `svg` element for a page with report_style.hpp; empty where the car was at no two places. `marks` in the order of time.
std::string route_svg(std::span<const Sample> samples, std::span<const RouteMark> marks, std::string_view title);

}  // namespace septet::logging
