#pragma once
/// The axes of a chart.

#include <string>
#include <vector>

namespace septet::document {

struct Range {
  double low = 0.0, high = 1.0;
};

/// Maps from the data's unit to the picture's.
struct Axis {
  double low, high;        ///< In the data's unit.
  double at_low, at_high;  ///< In the picture.
  double operator()(double value) const { return at_low + (value - low) / (high - low) * (at_high - at_low); }
};

/// Axis over a range; a range of no width becomes one wide.
Axis axis_of(Range range, double at_low, double at_high);

/// Round numbers in the range, about `count` of them: 1, 2, 2.5 or 5 times a power of ten apart.
std::vector<double> round_ticks(Range range, int count);

/// The least range from one round number to another that contains this one.
Range round_range(Range range, int count);

/// A tick's number with enough digits to tell it from the others.
std::string tick_label(double value, const std::vector<double>& ticks);

}  // namespace septet::document
