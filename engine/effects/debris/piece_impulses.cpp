// Impulses between two pieces, node against element.
//
// A node of mass m, velocity v, lies inside a linear tetrahedron with nodes of mass m_c, velocities v_c, at barycentric
// weights w_c. The surface there moves with u = Σ w_c v_c. An impulse p on the node and −w_c p on each corner keeps
// momentum, for Σ w_c = 1, and changes the relative velocity v − u by p (1/m + Σ w_c²/m_c): the bracket is the pair's
// inverse mass at that place. Along the outward normal n of the nearest outer face the pair should part with
//
//     (v − u)·n ≥ min(outward_share · depth / step, fastest_parting),
//
// Baumgarte's correction of depth, bounded so that deep overlaps (a break in the middle of things) do not throw pieces
// apart. The impulse along n is the missing velocity over the inverse mass, never negative; across n Coulomb's friction
// takes away sliding, at most all of it.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include <Eigen/Geometry>

#include "engine/effects/debris/contacts.hpp"
#include "engine/effects/debris/energy_ledger.hpp"
#include "engine/physics/elastic/element.hpp"

namespace septet::debris {
namespace {

using elastic::ElasticBody;
using elastic::Element;

constexpr double outward_share = 0.2;        ///< Share of the depth that is given back in a step.
constexpr double fastest_parting_mps = 1.0;  ///< By depth alone.
constexpr double waking_mps = 0.05;          ///< A change of velocity along the normal that wakes both.

/// Outer faces of each element: bit f is set where the face opposite to node f is one.
std::vector<std::uint8_t> outer_faces(const Piece& piece) {
  std::vector<std::uint8_t> result(piece.body.elements.size(), 0);
  for (const auto& triangle : piece.surface) {
    const auto& t = piece.body.elements[triangle.tetrahedron].nodes;
    for (std::size_t f = 0; f < 4; ++f)
      if (std::ranges::find(triangle.nodes, t[f]) == triangle.nodes.end())
        result[triangle.tetrahedron] |= static_cast<std::uint8_t>(1u << f);
  }
  return result;
}

/// A point below the surface of an element.
struct Penetration {
  Eigen::Vector4d weight;  ///< Barycentric.
  double depth_m;          ///< Depth below the nearest outer face.
  Eigen::Vector3d normal;  ///< Normal of that face, outwards.
};

std::optional<Penetration> penetration(const ElasticBody& body, const Element& e, std::uint8_t outer,
                                       const Eigen::Vector3d& point_m) {
  Eigen::Matrix3d edges;
  for (int c = 0; c < 3; ++c) edges.col(c) = body.position_m[e.nodes[c + 1]] - body.position_m[e.nodes[0]];
  const Eigen::Matrix3d inverse = edges.inverse();
  const Eigen::Vector3d last = inverse * (point_m - body.position_m[e.nodes[0]]);
  Penetration found{{1.0 - last.sum(), last[0], last[1], last[2]}, INFINITY, Eigen::Vector3d::UnitZ()};
  if (!(found.weight.minCoeff() >= 0.0)) return std::nullopt;
  for (int f = 0; f < 4; ++f) {
    if (!(outer & (1u << f))) continue;
    // A weight over its gradient is the distance to the face where it is 0.
    const Eigen::Vector3d gradient =
        f == 0 ? (-inverse.colwise().sum()).transpose().eval() : inverse.row(f - 1).transpose().eval();
    const double depth_m = found.weight[f] / gradient.norm();
    if (depth_m < found.depth_m) found.depth_m = depth_m, found.normal = -gradient.normalized();
  }
  return found;
}

/// The impulse on node `i` of the hitter and its opposite on the corners of `e`, by the derivation above.
void respond(Piece& hitter, int i, Piece& target, const Element& e, const Penetration& at, double step_s,
             EnergyLedger* ledger) {
  auto& a = hitter.body;
  auto& b = target.body;
  Eigen::Vector3d surface_velocity = Eigen::Vector3d::Zero();
  double inverse_mass = a.fixed[i] ? 0.0 : 1.0 / a.mass_kg[i];
  for (int c = 0; c < 4; ++c) {
    surface_velocity += at.weight[c] * b.velocity_mps[e.nodes[c]];
    if (!b.fixed[e.nodes[c]]) inverse_mass += at.weight[c] * at.weight[c] / b.mass_kg[e.nodes[c]];
  }
  if (inverse_mass == 0.0) return;
  const Eigen::Vector3d relative = a.velocity_mps[i] - surface_velocity;
  const double missing_mps =
      std::min(outward_share * at.depth_m / step_s, fastest_parting_mps) - relative.dot(at.normal);
  if (missing_mps <= 0.0) return;
  const double pressing_ns = missing_mps / inverse_mass;
  const Eigen::Vector3d slide = relative - relative.dot(at.normal) * at.normal;
  const double friction_ns =
      std::min(0.5 * (hitter.material.friction + target.material.friction) * pressing_ns, slide.norm() / inverse_mass);
  const Eigen::Vector3d impulse_ns =
      pressing_ns * at.normal -
      (slide.norm() > 0 ? Eigen::Vector3d(friction_ns * slide.normalized()) : Eigen::Vector3d::Zero().eval());
  if (!a.fixed[i]) a.velocity_mps[i] += impulse_ns / a.mass_kg[i];
  for (int c = 0; c < 4; ++c)
    if (!b.fixed[e.nodes[c]]) b.velocity_mps[e.nodes[c]] -= at.weight[c] * impulse_ns / b.mass_kg[e.nodes[c]];
  if (ledger) {
    ledger->meeting_loss_j -= pressing_ns * (relative.dot(at.normal) + 0.5 * missing_mps);
    ledger->rubbing_loss_j += friction_ns * (slide.norm() - 0.5 * friction_ns * inverse_mass);
  }
  if (missing_mps > waking_mps) hitter.asleep = target.asleep = false;
}

/// Each node of the hitter against the first element of the target's skin that it lies in.
void exchange(Piece& hitter, Piece& target, const Eigen::AlignedBox3d& target_bounds, double step_s,
              EnergyLedger* ledger) {
  const auto outer = outer_faces(target);
  for (int i = 0; i < hitter.body.node_count(); ++i) {
    const Eigen::Vector3d point_m = hitter.body.position_m[i];
    if (!target_bounds.contains(point_m)) continue;
    for (std::size_t k = 0; k < outer.size(); ++k) {
      if (outer[k] == 0) continue;
      const Element& e = target.body.elements[k];
      const auto inside = penetration(target.body, e, outer[k], point_m);
      if (!inside) continue;
      respond(hitter, i, target, e, *inside, step_s, ledger);
      break;
    }
  }
}

}  // namespace

void exchange_impulses(std::vector<Piece>& pieces, double step_s, EnergyLedger* ledger) {
  std::vector<Eigen::AlignedBox3d> bounds;
  bounds.reserve(pieces.size());
  for (const Piece& piece : pieces) bounds.push_back(bounds_of(piece));
  for (std::size_t i = 0; i < pieces.size(); ++i)
    for (std::size_t j = i + 1; j < pieces.size(); ++j) {
      if (pieces[i].asleep && pieces[j].asleep) continue;
      if (!bounds[i].intersects(bounds[j])) continue;
      exchange(pieces[i], pieces[j], bounds[j], step_s, ledger);
      exchange(pieces[j], pieces[i], bounds[i], step_s, ledger);
    }
}

}  // namespace septet::debris
