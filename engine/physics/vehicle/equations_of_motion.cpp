#include "engine/physics/vehicle/equations_of_motion.hpp"

namespace septet::vehicle {
namespace {

constexpr int body_count = coordinate_count - wheel_count;
using BodyCoordinates = std::array<double, body_count>;

/// M x = b for a symmetric positive definite M of which the lower triangle is given: M = L D Lᵀ.
BodyCoordinates solve(std::array<BodyCoordinates, body_count> m, BodyCoordinates x) {
  constexpr int n = body_count;
  BodyCoordinates inverse{};
  for (int j = 0; j < n; ++j) {
    for (int k = 0; k < j; ++k) x[j] -= m[j][k] * x[k];
    inverse[j] = 1.0 / m[j][j];
    for (int i = j + 1; i < n; ++i) {
      const double factor = m[i][j] * inverse[j];
      for (int k = j + 1; k <= i; ++k) m[i][k] -= factor * m[k][j];
    }
    for (int i = j + 1; i < n; ++i) m[i][j] *= inverse[j];
  }
  for (int i = n - 1; i >= 0; --i) {
    x[i] *= inverse[i];
    for (int k = i + 1; k < n; ++k) x[i] -= m[k][i] * x[k];
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
                          const std::array<WheelPlace, wheel_count>& places, const Coordinates& force) {
  // A travel meets the body's coordinates and no other travel: the four are eliminated one by one,
  // and five equations are left (the Schur complement of the travels).
  std::array<BodyCoordinates, body_count> mass{};
  BodyCoordinates body_force;
  for (int i = 0; i < body_count; ++i) body_force[i] = force[i];
  for (int i = 0; i < 3; ++i) mass[i][i] = statics.sprung_mass_kg;
  mass[3][3] = parameters.body.inertia_kgm2.x;
  mass[4][4] = parameters.body.inertia_kgm2.y;
  std::array<BodyCoordinates, wheel_count> coupling;  // Coupling of a travel with the body.
  std::array<double, wheel_count> inverse_travel_mass;
  for (int wheel = 0; wheel < wheel_count; ++wheel) {
    const double mass_kg = parameters.suspension[axle_of(wheel)].unsprung_mass_kg;
    const Vec3& c = places[wheel].centre_m;
    const Vec3 path{places[wheel].centre_slope, 1.0};
    for (int i = 0; i < 3; ++i) mass[i][i] += mass_kg;
    mass[3][1] -= mass_kg * c.z;
    mass[3][2] += mass_kg * c.y;
    mass[3][3] += mass_kg * (c.y * c.y + c.z * c.z);
    mass[4][0] += mass_kg * c.z;
    mass[4][2] -= mass_kg * c.x;
    mass[4][3] -= mass_kg * c.x * c.y;
    mass[4][4] += mass_kg * (c.x * c.x + c.z * c.z);
    coupling[wheel] = {mass_kg * path.x, mass_kg * path.y, mass_kg, mass_kg * (c.y - c.z * path.y),
                       mass_kg * (c.z * path.x - c.x)};
    inverse_travel_mass[wheel] = 1.0 / (mass_kg * glm::dot(path, path));
    for (int i = 0; i < body_count; ++i) {
      const double part = coupling[wheel][i] * inverse_travel_mass[wheel];
      body_force[i] -= part * force[body_count + wheel];
      for (int j = 0; j <= i; ++j) mass[i][j] -= part * coupling[wheel][j];
    }
  }
  const BodyCoordinates body = solve(mass, body_force);
  Coordinates result{};
  for (int i = 0; i < body_count; ++i) result[i] = body[i];
  for (int wheel = 0; wheel < wheel_count; ++wheel) {
    double left = force[body_count + wheel];
    for (int i = 0; i < body_count; ++i) left -= coupling[wheel][i] * body[i];
    result[body_count + wheel] = left * inverse_travel_mass[wheel];
  }
  return result;
}

}  // namespace septet::vehicle
