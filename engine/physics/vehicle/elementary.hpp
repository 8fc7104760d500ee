#pragma once
/// Sine and cosine from additions and multiplications alone.
///
/// The C library picks its sin by the processor's instruction set, and two of them may differ in
/// the last bit. What feeds the car's state uses these and square roots (correctly rounded
/// everywhere), so that equal inputs give equal bits on every machine.

#include <utility>

namespace septet::vehicle {

/// {sin x, cos x} for |x| ≤ 1.6 rad, error below 1e-12: Taylor polynomials of half the angle, then
/// doubled.
inline std::pair<double, double> sine_cosine(double x_rad) {
  const double h = 0.5 * x_rad;
  const double q = h * h;
  const double s =
      h * (1 - q / 6 * (1 - q / 20 * (1 - q / 42 * (1 - q / 72 * (1 - q / 110 * (1 - q / 156))))));
  const double c =
      1 - q / 2 * (1 - q / 12 * (1 - q / 30 * (1 - q / 56 * (1 - q / 90 * (1 - q / 132)))));
  return {2 * s * c, c * c - s * s};
}

}  // namespace septet::vehicle
