#include "engine/physics/vehicle/equations_of_motion.hpp"

#include <cmath>

namespace septet::vehicle {
namespace {
using Matrix = std::array<Coordinates, coordinate_count>;

/// M x = b for a symmetric positive definite M, whose lower triangle is overwritten by its Cholesky
/// factor.
Coordinates solve(Matrix& m, const Coordinates& b) {
  constexpr int n = coordinate_count;
  Coordinates x{};
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j <= i; ++j) {
      double sum = m[i][j];
      for (int k = 0; k < j; ++k) sum -= m[i][k] * m[j][k];
      m[i][j] = i == j ? std::sqrt(sum) : sum / m[j][j];
    }
    double sum = b[i];
    for (int k = 0; k < i; ++k) sum -= m[i][k] * x[k];
    x[i] = sum / m[i][i];
  }
  for (int i = n - 1; i >= 0; --i) {
    for (int k = i + 1; k < n; ++k) x[i] -= m[k][i] * x[k];
    x[i] /= m[i][i];
  }
  return x;
}
}  // namespace

std::array<Coordinates, 3> centre_jacobian(const WheelPlace& place, int wheel) {
  const Vec3& c = place.centre_m;
  std::array<Coordinates, 3> rows{};
  rows[0] = {1.0, 0.0, 0.0, 0.0, c.z};
  rows[1] = {0.0, 1.0, 0.0, -c.z, 0.0};
  rows[2] = {0.0, 0.0, 1.0, c.y, -c.x};
  rows[0][5 + wheel] = place.centre_slope.x;
  rows[1][5 + wheel] = place.centre_slope.y;
  rows[2][5 + wheel] = 1.0;
  return rows;
}

Coordinates accelerations(const VehicleParameters& parameters, const Statics& statics,
                          const std::array<WheelPlace, wheel_count>& places,
                          const Coordinates& force) {
  Matrix mass{};
  for (int i = 0; i < 3; ++i) mass[i][i] = statics.sprung_mass_kg;
  mass[3][3] = parameters.body.inertia_kgm2.x;
  mass[4][4] = parameters.body.inertia_kgm2.y;
  for (int wheel = 0; wheel < wheel_count; ++wheel) {
    const double mass_kg = parameters.suspension[axle_of(wheel)].unsprung_mass_kg;
    const int columns[] = {0, 1, 2, 3, 4, 5 + wheel};
    for (const Coordinates& row : centre_jacobian(places[wheel], wheel))
      for (const int i : columns)
        for (const int j : columns)
          if (j <= i) mass[i][j] += mass_kg * row[i] * row[j];
  }
  return solve(mass, force);
}

}  // namespace septet::vehicle
