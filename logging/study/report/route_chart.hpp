#pragma once
/// The path of a car, seen from above, with equal scales along both axes, in a box as flat as the path. Each stretch
/// has the colour of its class of speed, with a legend, and moments can be marked on it.

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "logging/session/records.hpp"

namespace septet::logging {

/// A moment to mark. Marks at the same place in the picture share a dot.
struct RouteMark {
  double time_s = 0.0;
  std::string label;  ///< A character or two; empty: a dot alone.
  std::string tip;    ///< Shown by the browser over the dot.
};

inline constexpr std::size_t route_speed_classes = 7;

/// Width of a class of speed, so that at most `route_speed_classes` reach up to the largest speed: 5, 10, 20, 25, 50,
/// 100 … km/h.
double speed_class_width_kmh(double largest_kmh);

/// An `svg` element for a page with report_style.hpp; empty if the car never moved. `marks` in the order of time.
std::string route_svg(std::span<const Sample> samples, std::span<const RouteMark> marks, std::string_view title);

}  // namespace septet::logging
