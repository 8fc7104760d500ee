#include "engine/effects/debris/energy_ledger.hpp"

#include <algorithm>

#include <glm/geometric.hpp>

#include "engine/math/gravity.hpp"
#include "engine/physics/elastic/body_measures.hpp"

namespace septet::debris {

StoredEnergy stored_energy(const Piece& piece) {
  const auto& body = piece.body;
  StoredEnergy stored{elastic::kinetic_energy_j(body), elastic::elastic_energy_j(body), 0.0};
  for (int i = 0; i < body.node_count(); ++i)
    stored.potential_j += body.mass_kg[i] * gravity_mps2 * body.position_m[i].z();
  return stored;
}

StoredEnergy stored_energy(const Shard& shard) {
  return {0.5 * shard.mass_kg * glm::dot(shard.velocity_mps, shard.velocity_mps), 0.0,
          shard.mass_kg * gravity_mps2 * shard.position_m.z};
}

StoredEnergy stored_energy(const State& state) {
  StoredEnergy sum;
  const auto add = [&](const StoredEnergy& of) {
    sum.kinetic_j += of.kinetic_j;
    sum.elastic_j += of.elastic_j;
    sum.potential_j += of.potential_j;
  };
  for (const Piece& piece : state.pieces) add(stored_energy(piece));
  for (const Shard& shard : state.shards) add(stored_energy(shard));
  return sum;
}

double EnergyLedger::given_j() const { return air_work_j + box_work_j; }

double EnergyLedger::lost_j() const {
  return pressing_loss_j + friction_loss_j + meeting_loss_j + rubbing_loss_j + plastic_loss_j + fracture_loss_j +
         viscous_loss_j + numerical_loss_j + bound_loss_j + settling_loss_j + stiffening_loss_j + melting_loss_j;
}

double unexplained_j(const StoredEnergy& before, const StoredEnergy& now, const EnergyLedger& ledger) {
  return now.sum_j() - before.sum_j() - (ledger.given_j() - ledger.lost_j());
}

double passed_j(const StoredEnergy& before, const StoredEnergy& now, const EnergyLedger& ledger) {
  return before.kinetic_j + before.elastic_j + std::max(0.0, before.potential_j - now.potential_j) +
         std::max(0.0, ledger.air_work_j) + std::max(0.0, ledger.box_work_j);
}

void book(EnergyLedger& ledger, const elastic::StepEnergy& step) {
  ledger.air_work_j += step.force_work_j;
  ledger.box_work_j += step.surface_work_j;
  ledger.pressing_loss_j += step.pressing_loss_j;
  ledger.friction_loss_j += step.friction_loss_j;
  ledger.viscous_loss_j += step.viscous_loss_j;
  ledger.numerical_loss_j += step.numerical_loss_j;
}

}  // namespace septet::debris
