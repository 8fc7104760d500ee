#include "engine/effects/debris/shards.hpp"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

#include "engine/effects/debris/air_force.hpp"
#include "engine/effects/debris/contacts.hpp"
#include "engine/effects/debris/energy_ledger.hpp"
#include "engine/effects/debris/piece.hpp"
#include "engine/math/gravity.hpp"
#include "engine/physics/elastic/body_measures.hpp"

namespace septet::debris {
namespace {

/// Removes the closing speed, with a fifth of it returned, and Coulomb's share of the sliding.
void bounce(Shard& shard, const Vec3& normal, const Vec3& surface_velocity, double friction, EnergyLedger* ledger) {
  const Vec3 relative = shard.velocity_mps - surface_velocity;
  const double closing = -glm::dot(relative, normal);
  if (closing <= 0.0) return;
  const Vec3 slide = relative + closing * normal;
  const double speed = glm::length(slide);
  const double gain = (closing > 0.5 ? 1.2 : 1.0) * closing;
  shard.velocity_mps += gain * normal;
  if (speed > 0.0) shard.velocity_mps -= std::min(1.0, friction * gain / speed) * slide;
  shard.angular_velocity_radps *= 0.7;
  if (!ledger) return;
  const double slowed = speed > 0.0 ? std::min(1.0, friction * gain / speed) : 0.0, mass = shard.mass_kg;
  ledger->pressing_loss_j += mass * gain * (closing - 0.5 * gain);
  ledger->friction_loss_j += mass * slowed * speed * speed * (1.0 - 0.5 * slowed);
  ledger->box_work_j += mass * glm::dot(gain * normal - slowed * slide, surface_velocity);
}

/// Infinitely far below where there is no ground.
GroundPoint ground_under(const ContactWorld& world, const Shard& shard) {
  if (!world.ground) return {.height_m = -INFINITY};
  return world.ground(shard.position_m.x, shard.position_m.y);
}

bool is_finite(const Shard& shard) {
  const glm::dquat& q = shard.orientation;
  return std::isfinite(glm::dot(shard.position_m, shard.position_m) + glm::dot(shard.velocity_mps, shard.velocity_mps) +
                       glm::dot(shard.angular_velocity_radps, shard.angular_velocity_radps) + shard.mass_kg +
                       shard.size_m + shard.shade_m2 + q.w + q.x + q.y + q.z);
}

}  // namespace

bool is_shard(const Piece& piece) {
  return part_recipe(piece.part).breakage == Breakage::crumbles &&
         std::ranges::all_of(piece.splinter, [&](int s) { return s == piece.splinter.front(); });
}

Shard shard_of(const Piece& piece) {
  const auto motion = elastic::rigid_motion(piece.body);
  Shard shard;
  shard.position_m = from_eigen(motion.centre_m);
  shard.velocity_mps = from_eigen(motion.velocity_mps);
  const Vec3 spin = from_eigen(motion.angular_velocity_radps);
  const double rate = glm::length(spin);
  shard.angular_velocity_radps = rate > 30.0 ? spin * (30.0 / rate) : spin;
  shard.mass_kg = elastic::total_mass_kg(piece.body);
  double volume = 0.0;
  for (const auto& e : piece.body.elements) volume += e.rest_volume_m3;
  shard.size_m = std::cbrt(shard.mass_kg / material_data(part_recipe(piece.part).material).elastic.density_kgpm3);
  // A sheet, whose lattice is thicker than itself (breakable_part.hpp): it has two faces, and no edge to speak of.
  const Vec3& part_m = part_recipe(piece.part).size_m;
  shard.shade_m2 = 0.5 * volume / std::min({part_m.x, part_m.y, part_m.z});
  return shard;
}

int advance_shards(State& state, const ContactWorld& world, double step_s, EnergyLedger* ledger) {
  for (Shard& shard : state.shards) {
    const double weight_n = shard.mass_kg * gravity_mps2, rising_mps = shard.velocity_mps.z;
    double lifted_m = 0.0;  // Out of boxes and ground.
    shard.velocity_mps.z -= gravity_mps2 * step_s;
    for (const Box& box : world.boxes) {
      const BoxGap gap = gap_to_box(box, shard.position_m);
      if (gap.gap_m > 0.0) continue;
      const Vec3 arm = shard.position_m - box.world_from_box.position_m;
      bounce(shard, gap.normal, box.velocity_mps + glm::cross(box.angular_velocity_radps, arm), box.friction, ledger);
      shard.position_m -= std::max(gap.gap_m, -0.5) * gap.normal;
      lifted_m -= std::max(gap.gap_m, -0.5) * gap.normal.z;
    }
    shard.position_m += step_s * shard.velocity_mps;
    if (ledger) {
      // Weight worked at the mean velocity of its step, and the way is that of the last.
      const double mean_mps = rising_mps - 0.5 * gravity_mps2 * step_s;
      ledger->numerical_loss_j += step_s * weight_n * (mean_mps - shard.velocity_mps.z);
      ledger->pressing_loss_j -= weight_n * lifted_m;
    }
    const double rate = glm::length(shard.angular_velocity_radps);
    if (rate > 1e-6)
      shard.orientation =
          glm::normalize(glm::angleAxis(rate * step_s, shard.angular_velocity_radps / rate) * shard.orientation);
    const GroundPoint ground = ground_under(world, shard);
    if (shard.position_m.z > ground.height_m) {
      const double before_j = ledger ? stored_energy(shard).kinetic_j : 0.0;
      shard.velocity_mps = world.wind_mps + slowed_by_air_mps(shard.velocity_mps - world.wind_mps, shard.shade_m2,
                                                              shard.mass_kg, step_s);
      if (ledger) ledger->air_work_j += stored_energy(shard).kinetic_j - before_j;
      continue;
    }
    if (ledger) ledger->pressing_loss_j -= weight_n * (ground.height_m - shard.position_m.z);
    // Close to the road the air hardly moves: what slides or lies there is not blown along.
    shard.position_m.z = ground.height_m;
    bounce(shard, ground.normal, Vec3(0.0), 0.4 * ground.friction_factor, ledger);
    if (glm::length(shard.velocity_mps) < 0.2) {
      if (ledger) ledger->settling_loss_j += stored_energy(shard).kinetic_j;
      shard.velocity_mps = Vec3(0.0);
      shard.angular_velocity_radps = Vec3(0.0);
    }
  }
  return static_cast<int>(std::erase_if(state.shards, [](const Shard& shard) { return !is_finite(shard); }));
}

}  // namespace septet::debris
