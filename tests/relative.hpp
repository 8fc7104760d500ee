#pragma once
/// A value within a relative tolerance. doctest's own Approx takes the share of the value and one together, so that
/// small values always pass.

#include <doctest/doctest.h>

namespace septet {

/// Matches values within `share` of `value`, which is not zero.
inline doctest::Approx relative(double value, double share) { return doctest::Approx(value).scale(0.0).epsilon(share); }

}  // namespace septet
