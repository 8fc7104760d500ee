#include "engine/effects/debris/melt.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "engine/effects/debris/debris_keyframe.hpp"
#include "engine/effects/debris/piece.hpp"
#include "engine/physics/elastic/body_measures.hpp"
#include "engine/physics/elastic/element.hpp"

namespace septet::debris {
namespace {

/// A shape follows the heat in steps of this size: ten seconds at 10 K above freezing. Chosen.
constexpr double shape_step_m = 1e-5;
/// Melted thickness at which a sleeper wakes: a keyframe has no finer places.
constexpr double wake_step_m = position_quantum_m;

double lowest_m(const elastic::ElasticBody& body) {
  double lowest = INFINITY;
  for (const Eigen::Vector3d& x : body.position_m) lowest = std::min(lowest, x.z());
  return lowest;
}

/// Mean of the elements' deformation by volume.
Eigen::Matrix3d mean_deformation(const elastic::ElasticBody& body) {
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  double volume_m3 = 0.0;
  for (const elastic::Element& e : body.elements) {
    sum += e.rest_volume_m3 * elastic::deformation_gradient(e, body.position_m);
    volume_m3 += e.rest_volume_m3;
  }
  return sum / volume_m3;
}

/// Scales the shape at rest along z. With F the mean deformation, x = F X + u becomes F X' + share·u: each element's
/// deformation comes no further from the mean, so that a smaller volume stores less energy, not more.
void thin(elastic::ElasticBody& body, double share) {
  const Eigen::Vector3d centre_m = elastic::centre_of_mass_m(body);
  const Eigen::Matrix3d mean = mean_deformation(body);
  Eigen::Vector3d rest_centre_m = Eigen::Vector3d::Zero();
  for (int i = 0; i < body.node_count(); ++i) rest_centre_m += body.mass_kg[i] * body.rest_position_m[i];
  rest_centre_m /= elastic::total_mass_kg(body);
  const double lowest_before_m = lowest_m(body);
  for (int i = 0; i < body.node_count(); ++i) {
    Eigen::Vector3d arm = body.rest_position_m[i] - rest_centre_m;
    const Eigen::Vector3d bent = body.position_m[i] - centre_m - mean * arm;
    arm.z() *= share;
    body.rest_position_m[i].z() *= share;
    body.position_m[i] = centre_m + mean * arm + share * bent;
    body.mass_kg[i] *= share;
  }
  // The lowest node stays where it lies, and the rest comes down.
  const double rise_m = std::max(0.0, lowest_m(body) - lowest_before_m);
  for (Eigen::Vector3d& x : body.position_m) x.z() -= rise_m;
  for (elastic::Element& e : body.elements) {
    e.rest_volume_m3 *= share;
    e.rest_inverse.col(2) /= share;
  }
  elastic::invalidate_rest_factor(body);
}

/// False where nothing is left of it.
bool melt(Piece& piece, double melted_m) {
  piece.melted_m += melted_m;
  if (piece.melted_m < shape_step_m) return true;
  const double left_m = piece.height_m - piece.melted_m;
  if (!(left_m > least_height_left * part_recipe(piece.part).size_m.z)) return false;
  thin(piece.body, left_m / piece.height_m);
  if (std::floor(left_m / wake_step_m) != std::floor(piece.height_m / wake_step_m)) {
    piece.asleep = false;
    piece.calm_s = 0.0;
  }
  piece.height_m = left_m;
  piece.melted_m = 0.0;
  return true;
}

}  // namespace

void melt_ice(State& state, double melted_m) {
  if (!(melted_m > 0.0)) return;
  std::vector<Piece> left;
  left.reserve(state.pieces.size());
  for (Piece& piece : state.pieces)
    if (part_recipe(piece.part).material != Material::ice || melt(piece, melted_m)) left.push_back(std::move(piece));
  state.pieces = std::move(left);
}

}  // namespace septet::debris
