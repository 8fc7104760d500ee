#pragma once
/// A value within a share of itself. doctest's own Approx takes the share of the value and one together, so that what is small passes whatever it is.

#include <doctest/doctest.h>

namespace septet {

/// Equal to what lies within `share` of `value`, which is not nought.
inline doctest::Approx relative(double value, double share) { return doctest::Approx(value).scale(0.0).epsilon(share); }

}  // namespace septet
