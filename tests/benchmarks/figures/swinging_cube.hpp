#pragma once
/// The swinging cube of Servin et al. (section 3): side 1 m, eight particles of 1 kg, 18 springs of U = ½k((l−L)/L)²,
/// one top corner fixed, g = 10 m/s². Three steppers in dense form, for comparison only: Septet's own has no springs.
/// tests/engine/physics/elastic/pendulum_slow_test.cpp proves that a body swings in time with it.

#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include <Eigen/Dense>

namespace septet::elastic::swinging_cube {

enum class Stepper { regularised, implicit_euler, symplectic_euler };

struct Cube {
  Eigen::Matrix<double, 24, 1> x, v = Eigen::Matrix<double, 24, 1>::Zero();
  std::vector<std::pair<int, int>> edges;
  std::vector<double> length;
  double stiffness = 1e5;
};

inline constexpr int fixed_corner = 7, opposite_corner = 0;

inline Cube make_cube() {
  Cube cube;
  for (int c = 0; c < 8; ++c) cube.x.segment<3>(3 * c) = Eigen::Vector3d(c & 1, (c >> 1) & 1, (c >> 2) & 1);
  const std::array<std::array<int, 4>, 5> tetrahedra{
      {{0, 1, 2, 4}, {3, 1, 2, 7}, {5, 1, 4, 7}, {6, 2, 4, 7}, {1, 2, 4, 7}}};
  for (int a = 0; a < 8; ++a)
    for (int b = a + 1; b < 8; ++b)
      for (const auto& t : tetrahedra) {
        const auto has = [&](int n) { return t[0] == n || t[1] == n || t[2] == n || t[3] == n; };
        if (!has(a) || !has(b)) continue;
        cube.edges.emplace_back(a, b);
        cube.length.push_back((cube.x.segment<3>(3 * a) - cube.x.segment<3>(3 * b)).norm());
        break;
      }
  return cube;
}

/// `gamma` belongs to the regularised stepper.
inline void step(Cube& cube, Stepper stepper, double dt, double gamma) {
  using Matrix = Eigen::Matrix<double, 24, 24>;
  using Vector = Eigen::Matrix<double, 24, 1>;
  Matrix stiffness = Matrix::Zero();
  Vector force = Vector::Zero();
  for (int c = 0; c < 8; ++c) force[3 * c + 2] -= 10.0;
  for (std::size_t e = 0; e < cube.edges.size(); ++e) {
    const auto [a, b] = cube.edges[e];
    const Eigen::Vector3d d = cube.x.segment<3>(3 * a) - cube.x.segment<3>(3 * b);
    const double l = d.norm(), rest = cube.length[e];
    const Eigen::Vector3d n = d / l;
    const double pull = cube.stiffness * (l - rest) / (rest * rest);
    Eigen::Matrix3d k = cube.stiffness / (rest * rest) * n * n.transpose();
    if (stepper == Stepper::implicit_euler)  // The geometric term that the regularised form drops.
      k += pull / l * (Eigen::Matrix3d::Identity() - n * n.transpose());
    force.segment<3>(3 * a) -= pull * n;
    force.segment<3>(3 * b) += pull * n;
    stiffness.block<3, 3>(3 * a, 3 * a) += k;
    stiffness.block<3, 3>(3 * b, 3 * b) += k;
    stiffness.block<3, 3>(3 * a, 3 * b) -= k;
    stiffness.block<3, 3>(3 * b, 3 * a) -= k;
  }
  Matrix system = Matrix::Identity();
  if (stepper != Stepper::symplectic_euler)
    system += dt * dt / (stepper == Stepper::regularised ? gamma : 1.0) * stiffness;
  Vector right = cube.v + dt * force;
  for (int c = 0; c < 3; ++c) {
    const int i = 3 * fixed_corner + c;
    system.row(i).setZero();
    system.col(i).setZero();
    system(i, i) = 1.0;
    right[i] = 0.0;
  }
  cube.v = system.partialPivLu().solve(right);
  cube.x += dt * cube.v;
}

/// Height of the corner opposite to the fixed one, over time, including the start.
inline std::vector<double> heights(Stepper stepper, double dt, double duration_s, double gamma) {
  Cube cube = make_cube();
  std::vector<double> result{cube.x[3 * opposite_corner + 2]};
  for (double t = 0.5 * dt; t < duration_s; t += dt) {
    step(cube, stepper, dt, gamma);
    result.push_back(cube.x[3 * opposite_corner + 2]);
  }
  return result;
}

/// Time of the first minimum, by a parabola through the lowest sample and its neighbours.
inline double time_of_minimum_s(const std::vector<double>& height, double dt) {
  for (std::size_t i = 1; i + 1 < height.size(); ++i) {
    if (static_cast<double>(i) * dt < 0.3 || height[i] > height[i - 1] || height[i] > height[i + 1]) continue;
    const double down = height[i - 1] - height[i], up = height[i + 1] - height[i];
    if (height[i] > -0.5) continue;  // A ripple of the elastic vibration, not the swing.
    return dt * (static_cast<double>(i) + 0.5 * (down - up) / (down + up));
  }
  return INFINITY;
}

}  // namespace septet::elastic::swinging_cube
