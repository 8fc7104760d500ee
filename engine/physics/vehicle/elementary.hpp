#pragma once
/// Sine and cosine from additions and multiplications alone.
///
/// The C library picks its sin by the processor's instruction set, and two of them may differ in the last bit. All code
/// that feeds the car's state uses these and square roots (correctly rounded everywhere), so that equal inputs give
/// equal bits on every machine.

#include <utility>

namespace septet::vehicle {

/// {sin x, cos x} for |x| ≤ 1.6 rad, error below 1e-12: Taylor polynomials of half the angle, then doubled.
inline std::pair<double, double> sine_cosine(double x_rad) {
  const double h = 0.5 * x_rad;
  const double q = h * h;
  const double s =
      h * (1 - q * (1. / 6 - q * (1. / 120 -
                                  q * (1. / 5040 - q * (1. / 362880 - q * (1. / 39916800 - q * (1. / 6227020800)))))));
  const double c =
      1 - q * (1. / 2 - q * (1. / 24 - q * (1. / 720 - q * (1. / 40320 - q * (1. / 3628800 - q * (1. / 479001600))))));
  return {2 * s * c, c * c - s * s};
}

}  // namespace septet::vehicle
