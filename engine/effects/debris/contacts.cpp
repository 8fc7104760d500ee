#include "engine/effects/debris/contacts.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>
#include <glm/geometric.hpp>

#include "engine/physics/elastic/element.hpp"

namespace septet::debris {
namespace {

using elastic::ElasticBody;
using Bounds = Eigen::AlignedBox3d;

Bounds bounds_of(const ElasticBody& body) {
  Bounds bounds;
  for (const auto& x : body.position_m) bounds.extend(x);
  return bounds;
}

/// Places of the outer faces in each element: bit f set where the face opposite to node f is outer.
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

void exchange(Piece& hitter, Piece& target, const Bounds& target_bounds, double step_s) {
  const auto outer = outer_faces(target);
  auto& a = hitter.body;
  auto& b = target.body;
  for (int i = 0; i < a.node_count(); ++i) {
    const Eigen::Vector3d point = a.position_m[i];
    if (!target_bounds.contains(point)) continue;
    for (std::size_t k = 0; k < b.elements.size(); ++k) {
      if (outer[k] == 0) continue;
      const auto& e = b.elements[k];
      Eigen::Matrix3d edges;
      for (int c = 0; c < 3; ++c) edges.col(c) = b.position_m[e.nodes[c + 1]] - b.position_m[e.nodes[0]];
      const Eigen::Matrix3d inverse = edges.inverse();
      const Eigen::Vector3d last = inverse * (point - b.position_m[e.nodes[0]]);
      const Eigen::Vector4d weight(1.0 - last.sum(), last[0], last[1], last[2]);
      if (!(weight.minCoeff() >= 0.0)) continue;
      // Out through the nearest outer face; a weight over its gradient is the depth below it.
      double depth = INFINITY;
      Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();
      for (int f = 0; f < 4; ++f) {
        if (!(outer[k] & (1u << f))) continue;
        const Eigen::Vector3d gradient =
            f == 0 ? (-inverse.colwise().sum()).transpose().eval() : inverse.row(f - 1).transpose().eval();
        const double d = weight[f] / gradient.norm();
        if (d < depth) depth = d, normal = -gradient.normalized();
      }
      Eigen::Vector3d surface_velocity = Eigen::Vector3d::Zero();
      double inverse_mass = a.fixed[i] ? 0.0 : 1.0 / a.mass_kg[i];
      for (int c = 0; c < 4; ++c) {
        surface_velocity += weight[c] * b.velocity_mps[e.nodes[c]];
        if (!b.fixed[e.nodes[c]]) inverse_mass += weight[c] * weight[c] / b.mass_kg[e.nodes[c]];
      }
      if (inverse_mass == 0.0) break;
      const Eigen::Vector3d relative = a.velocity_mps[i] - surface_velocity;
      const double wanted = std::min(0.2 * depth / step_s, 1.0) - relative.dot(normal);
      if (wanted <= 0.0) break;
      const double pressing = wanted / inverse_mass;
      const Eigen::Vector3d slide = relative - relative.dot(normal) * normal;
      const double friction =
          std::min(0.5 * (hitter.material.friction + target.material.friction) * pressing, slide.norm() / inverse_mass);
      const Eigen::Vector3d impulse =
          pressing * normal -
          (slide.norm() > 0 ? Eigen::Vector3d(friction * slide.normalized()) : Eigen::Vector3d::Zero().eval());
      if (!a.fixed[i]) a.velocity_mps[i] += impulse / a.mass_kg[i];
      for (int c = 0; c < 4; ++c)
        if (!b.fixed[e.nodes[c]]) b.velocity_mps[e.nodes[c]] -= weight[c] * impulse / b.mass_kg[e.nodes[c]];
      if (wanted > 0.05) hitter.asleep = target.asleep = false;
      break;
    }
  }
}

/// A box that a piece may touch, with the data that all its nodes need.
struct NearBox {
  std::size_t index;
  double radius_m, speed_mps;
};

/// A trunk is twenty metres long and thin: a sphere round it holds half a wood, so the distance to the box itself
/// decides.
std::vector<NearBox> boxes_within_reach(const Piece& piece, const ContactWorld& world, double step_s, double ahead_s) {
  std::vector<NearBox> result;
  if (world.boxes.empty()) return result;
  const Vec3 centre = from_eigen(bounds_of(piece.body).center());
  double radius_m = 0.0, speed_mps = 0.0;
  for (int i = 0; i < piece.body.node_count(); ++i) {
    radius_m = std::max(radius_m, glm::distance(from_eigen(piece.body.position_m[i]), centre));
    speed_mps = std::max(speed_mps, piece.body.velocity_mps[i].norm());
  }
  constexpr double rounding_m = 1e-6;
  for (std::size_t b = 0; b < world.boxes.size(); ++b) {
    const Box& box = world.boxes[b];
    const Vec3 arm = centre - ahead_s * box.velocity_mps - box.world_from_box.position_m;
    const Vec3 local = glm::conjugate(box.world_from_box.orientation) * arm;
    const Vec3 outside = glm::max(glm::abs(local) - box.half_size_m, Vec3(0.0));
    const double box_mps = glm::length(box.velocity_mps);
    const double surface_mps = box_mps + glm::length(box.angular_velocity_radps) * (glm::length(arm) + radius_m);
    const double reach = radius_m + 0.02 + step_s * (speed_mps + surface_mps + 10.0 * step_s) + rounding_m;
    // NaN passes this test: every node examines it.
    if (glm::dot(outside, outside) > reach * reach) continue;
    result.push_back({b, glm::length(box.half_size_m), box_mps});
  }
  return result;
}

}  // namespace

BoxGap gap_to_box(const Box& box, const Vec3& point_m) {
  const Vec3 local = inverse(box.world_from_box) * point_m;
  const Vec3 nearest = glm::clamp(local, -box.half_size_m, box.half_size_m);
  const Vec3 outside = local - nearest;
  double gap = glm::length(outside);
  Vec3 normal(0.0);
  if (gap > 0.0) {
    normal = outside / gap;
  } else {
    int axis = 0;
    gap = -INFINITY;
    for (int c = 0; c < 3; ++c) {
      const double g = std::abs(local[c]) - box.half_size_m[c];
      if (g > gap) gap = g, axis = c;
    }
    normal[axis] = local[axis] < 0.0 ? -1.0 : 1.0;
  }
  for (const HullPlane& cut : box.cuts) {
    const double beyond = glm::dot(cut.normal, local) - cut.offset_m;
    if (beyond > gap) gap = beyond, normal = cut.normal;
  }
  return {gap, box.world_from_box.orientation * normal};
}

std::vector<FoundContact> find_contacts(const Piece& piece, const ContactWorld& world, double step_s, double ahead_s) {
  const std::vector<NearBox> boxes = boxes_within_reach(piece, world, step_s, ahead_s);
  std::vector<FoundContact> result;
  for (int i = 0; i < piece.body.node_count(); ++i) {
    const Vec3 point = from_eigen(piece.body.position_m[i]);
    const Vec3 velocity = from_eigen(piece.body.velocity_mps[i]);
    const double reach = 0.02 + step_s * (glm::length(velocity) + 10.0 * step_s);
    if (world.ground) {
      const GroundPoint ground = world.ground(point.x, point.y);
      const double gap = (point.z - ground.height_m) * ground.normal.z;
      if (gap < reach) {
        FoundContact found;
        found.contact.node = i;
        found.contact.normal = to_eigen(ground.normal);
        found.contact.gap_m = gap;
        found.contact.friction = piece.material.friction * ground.friction_factor;
        result.push_back(found);
      }
    }
    for (const NearBox& near : boxes) {
      const Box& box = world.boxes[near.index];
      const Vec3 seen = point - ahead_s * box.velocity_mps;  // Seen from the box's first position.
      const Vec3 arm = seen - box.world_from_box.position_m;
      const double far = near.radius_m + reach + step_s * near.speed_mps;
      if (glm::dot(arm, arm) > far * far) continue;
      const Vec3 surface_velocity = box.velocity_mps + glm::cross(box.angular_velocity_radps, arm);
      const BoxGap gap = gap_to_box(box, seen);
      if (gap.gap_m > 0.02 + step_s * (glm::length(velocity - surface_velocity) + 10.0 * step_s)) continue;
      FoundContact found;
      found.contact.node = i;
      found.contact.normal = to_eigen(gap.normal);
      found.contact.gap_m = gap.gap_m;
      found.contact.surface_velocity_mps = to_eigen(surface_velocity);
      found.contact.friction = std::min(box.friction, piece.material.friction);
      found.box = static_cast<int>(near.index);
      result.push_back(found);
    }
  }
  return result;
}

bool box_near(const Piece& piece, const ContactWorld& world, double step_s) {
  const Bounds bounds = bounds_of(piece.body);
  const double radius = 0.5 * bounds.diagonal().norm();
  const Vec3 centre = from_eigen(bounds.center());
  return std::ranges::any_of(world.boxes, [&](const Box& box) {
    const double speed = glm::length(box.velocity_mps) + glm::length(box.angular_velocity_radps);
    return speed > 0.01 && gap_to_box(box, centre).gap_m < radius + 2.0 * step_s * speed;
  });
}

void exchange_impulses(std::vector<Piece>& pieces, double step_s) {
  std::vector<Bounds> bounds;
  bounds.reserve(pieces.size());
  for (const Piece& piece : pieces) bounds.push_back(bounds_of(piece.body));
  for (std::size_t i = 0; i < pieces.size(); ++i)
    for (std::size_t j = i + 1; j < pieces.size(); ++j) {
      if (pieces[i].asleep && pieces[j].asleep) continue;
      if (!bounds[i].intersects(bounds[j])) continue;
      exchange(pieces[i], pieces[j], bounds[j], step_s);
      exchange(pieces[j], pieces[i], bounds[i], step_s);
    }
}

}  // namespace septet::debris
