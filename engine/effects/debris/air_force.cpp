#include "engine/effects/debris/air_force.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include <Eigen/Geometry>
#include <glm/geometric.hpp>

namespace septet::debris {
namespace {

constexpr double radians(double degrees) { return degrees * std::numbers::pi / 180.0; }

/// Twice the area, along the outward normal.
Eigen::Vector3d double_area_m2(const elastic::ElasticBody& body, const std::array<int, 3>& face) {
  const auto& x = body.position_m;
  return (x[face[1]] - x[face[0]]).cross(x[face[2]] - x[face[0]]);
}

Eigen::Vector3d middle_of(const std::vector<Eigen::Vector3d>& at_nodes, const std::array<int, 3>& face) {
  return (at_nodes[face[0]] + at_nodes[face[1]] + at_nodes[face[2]]) / 3.0;
}

/// Middle of a surface and the mean square of the way from it, by area.
struct Spread {
  Eigen::Vector3d middle_m = Eigen::Vector3d::Zero();
  Eigen::Matrix3d square_m2 = Eigen::Matrix3d::Zero();
};

Spread spread_of(const Piece& piece) {
  Spread spread;
  const auto& x = piece.body.position_m;
  double whole_m2 = 0.0;
  for (const auto& [face, tetrahedron] : piece.surface) {
    const double area = 0.5 * double_area_m2(piece.body, face).norm();
    spread.middle_m += area * middle_of(x, face);
    whole_m2 += area;
  }
  if (!(whole_m2 > 0.0)) return spread;
  spread.middle_m /= whole_m2;
  for (const auto& [face, tetrahedron] : piece.surface) {
    const double share = 0.5 * double_area_m2(piece.body, face).norm() / whole_m2;
    const Eigen::Vector3d way = middle_of(x, face) - spread.middle_m;
    spread.square_m2 += share * way * way.transpose();
  }
  return spread;
}

}  // namespace

double plate_normal_coefficient(double sine_of_attack) {
  const double attack = std::asin(std::clamp(sine_of_attack, 0.0, 1.0));
  return attack < radians(40.0) ? 1.7 * attack / radians(40.0) : 1.15;
}

double plate_pressure_offset(double sine_of_attack) {
  const double attack = std::asin(std::clamp(sine_of_attack, 0.0, 1.0));
  if (attack < radians(38.0)) return 0.3 - 0.22 * attack / radians(38.0);
  return attack < radians(82.5) ? 0.08 * std::cos(2.0 * (attack - radians(38.0))) : 0.0;
}

Vec3 slowed_by_air_mps(const Vec3& past_air_mps, double shade_m2, double mass_kg, double step_s) {
  if (!(mass_kg > 0.0)) return past_air_mps;
  // The speed falls as dv/dt = −κv².
  const double per_m = 0.5 * air_density_kgpm3 * tumbling_coefficient * shade_m2 / mass_kg;
  return past_air_mps / (1.0 + per_m * glm::length(past_air_mps) * step_s);
}

void feel_air(Piece& piece, const Eigen::Vector3d& wind_mps) {
  auto& body = piece.body;
  std::ranges::fill(body.force_n, Eigen::Vector3d::Zero());
  const Spread spread = spread_of(piece);
  for (const auto& [face, tetrahedron] : piece.surface) {
    const Eigen::Vector3d wind = wind_mps - middle_of(body.velocity_mps, face), across = double_area_m2(body, face);
    const double speed = wind.norm(), area = 0.5 * across.norm();
    if (!(speed > 0.0) || !(area > 0.0)) continue;
    const Eigen::Vector3d normal = across.normalized();
    const double blown = wind.dot(normal) / speed, sine = std::abs(blown);
    const double half_n = 0.25 * air_density_kgpm3 * speed * speed * area * plate_normal_coefficient(sine);
    // A load that grows along the plate, of 1 in its middle, has its mean at c times its length, √12 of its spread.
    const Eigen::Vector3d along = wind - blown * speed * normal;
    const double spread_m2 = along.dot(spread.square_m2 * along);
    const double before = (spread.middle_m - middle_of(body.position_m, face)).dot(along);
    const double load =
        spread_m2 > 0.0 ? 1.0 + plate_pressure_offset(sine) * std::sqrt(12.0 / spread_m2) * before : 1.0;
    const Eigen::Vector3d force = (blown < 0.0 ? -half_n : half_n) * load * normal;
    for (const int node : face) body.force_n[node] += force / 3.0;
  }
}

}  // namespace septet::debris
