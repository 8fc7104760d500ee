// The law of contact of debris: `find_contacts` says where, engine/physics/elastic/step.cpp solves it.
//
// Condition. A surface with the outward unit normal n moves with u under a node of mass m and velocity v. The gap g
// grows by ġ = n·(v − u). The surface presses and does not pull (Signorini):
//     g ≥ 0,   P ≥ 0,   g P = 0,   P the impulse along n.
//
// Step. A contact that acts is one more constraint φ = g, whose row of the Jacobian is nᵀ, with the stiffness
// α⁻¹ = κ m/Δt² in eq. 20 of the step (step.hpp). Elimination of its multiplier leaves
//     P = −κ m (g/Δt + ġ⁺/γ),
// that is κ m/γ n nᵀ in the node's diagonal block, and −κ m g/Δt n + κ m/γ (n·u) n on the right. A lone node whose gap
// would have changed at ġ₀ leaves with ġ⁺ = (ġ₀ − κ g/Δt)/(1 + κ/γ), near −γ g/Δt where κ is large: the gap becomes
// (1 − γ) g, which is −0.43 g at the β = 0.2 Δt of the debris, and dies out because |1 − γ| < 1. At rest a column of N
// such nodes stands N g₀ Δt²/κ deep (g₀ gravity). Stiffness goes by mass and step so that the matrix is as well
// conditioned for a splinter as for a post.
//
// Complementarity. With the compliance of that spring the condition of a step is w = g/Δt + ġ⁺/γ, P ≥ 0, P = 0 where
// w > 0, else P = −κ m w: which contacts act is part of the solution. The step starts with all whose gap closes in
// flight, g + Δt n·(v + Δt g₀ − u) ≤ 0, solves, takes out those with P < 0, and solves again. From P < 0 and g ≤ 0
// follows an end gap of g + Δt ġ⁺ > (1 − γ) g ≥ 0: that contact opens by itself, and held would be glue. To zero its
// impulse alone would not do: the other velocities were solved with it, and momentum would not balance. The set only
// shrinks, so it ends after as many passes as there are contacts, or at `most_contact_passes`. A contact that closes
// because another let go is found in the next step; so this is no exact solution of the complementarity, and nothing
// proves that its set is the only one.
//
// Friction. Coulomb asks for |T| ≤ μ P against the slip s = (v − u) − ġ n. P of this step is not known before its
// solution; P' is the larger of the last step's P and the node's own m max(0, −n·(v + Δt g₀ − u)). In the same system
//     T = −c s⁺,   c = μ P'/max(|s|, s₀),
// so that a lone node keeps its direction, s⁺ = s m/(m + c), and |T| ≤ μ P' while it slows. Below s₀ friction is
// viscous: a node on a slope of tan θ creeps at s₀ tan θ/μ (1 mm/s on ice at five per cent), until its piece sleeps.
//
// Bounds. A deep overlap is left at `most_release_mps` and no faster (step.cpp). A step is linear, so a piece that
// closes fast makes several (advance_debris.cpp). A blow returns the material's share of its speed (blow.hpp). Energy
// that the friction of before, the soft gap or surfaces that close on a piece add is taken out (energy_bound.hpp).

#include "engine/effects/debris/contacts.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>
#include <glm/geometric.hpp>

namespace septet::debris {
namespace {

/// Height above a surface from which a node is a contact, beside its fall and flight in a step: its neighbours may push
/// it down. Chosen: in the fall of six parts (step.cpp) ways are within 3 % of each other from 0 to 0.1 m, but at 0.1 m
/// half as many steps again are solved twice.
constexpr double margin_m = 0.02;
/// Chosen a little above gravity, so that a fall ends within reach.
constexpr double gravity_bound_mps2 = 10.0;
/// Speed from which on a box wakes the pieces that it comes close to. Chosen: a third of the speed of a piece that
/// rests (advance_debris.cpp).
constexpr double box_moves_mps = 0.01;

/// Search distance above a surface for a node of this velocity against it.
double reach_m(double closing_mps, double step_s) {
  return margin_m + step_s * (closing_mps + gravity_bound_mps2 * step_s);
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
  const Vec3 centre = from_eigen(bounds_of(piece).center());
  double radius_m = 0.0, speed_mps = 0.0;
  for (int i = 0; i < piece.body.node_count(); ++i) {
    radius_m = std::max(radius_m, glm::distance(from_eigen(piece.body.position_m[i]), centre));
    speed_mps = std::max(speed_mps, piece.body.velocity_mps[i].norm());
  }
  constexpr double rounding_m = 1e-6;  // Chosen far above that of doubles at 10⁶ m, and far below the reach.
  for (std::size_t b = 0; b < world.boxes.size(); ++b) {
    const Box& box = world.boxes[b];
    const Vec3 arm = centre - ahead_s * box.velocity_mps - box.world_from_box.position_m;
    const Vec3 local = glm::conjugate(box.world_from_box.orientation) * arm;
    const Vec3 outside = glm::max(glm::abs(local) - box.half_size_m, Vec3(0.0));
    const double box_mps = glm::length(box.velocity_mps);
    const double surface_mps = box_mps + glm::length(box.angular_velocity_radps) * (glm::length(arm) + radius_m);
    const double reach = radius_m + reach_m(speed_mps + surface_mps, step_s) + rounding_m;
    // NaN passes this test: every node examines it.
    if (glm::dot(outside, outside) > reach * reach) continue;
    result.push_back({b, glm::length(box.half_size_m), box_mps});
  }
  return result;
}

}  // namespace

Eigen::AlignedBox3d bounds_of(const Piece& piece) {
  Eigen::AlignedBox3d bounds;
  for (const auto& x : piece.body.position_m) bounds.extend(x);
  return bounds;
}

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
    const double reach = reach_m(glm::length(velocity), step_s);
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
      if (gap.gap_m > reach_m(glm::length(velocity - surface_velocity), step_s)) continue;
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
  const Eigen::AlignedBox3d bounds = bounds_of(piece);
  const double radius = 0.5 * bounds.diagonal().norm();
  const Vec3 centre = from_eigen(bounds.center());
  return std::ranges::any_of(world.boxes, [&](const Box& box) {
    const double speed = glm::length(box.velocity_mps) + glm::length(box.angular_velocity_radps);
    return speed > box_moves_mps && gap_to_box(box, centre).gap_m < radius + 2.0 * step_s * speed;
  });
}

}  // namespace septet::debris
