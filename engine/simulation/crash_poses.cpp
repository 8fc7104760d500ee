#include "engine/simulation/crash_poses.hpp"

#include <algorithm>
#include <optional>

#include "engine/physics/impact/outline.hpp"
#include "engine/physics/vehicle/planar_body.hpp"
#include "engine/simulation/bodies/bodies.hpp"
#include "engine/simulation/bodies/loose_body.hpp"
#include "engine/world/vehicle_body.hpp"

namespace septet::simulation {
namespace {

const Participant* find(const std::vector<Participant>& participants, ParticipantId id) {
  const auto found = std::ranges::lower_bound(participants, id, {}, &Participant::id);
  return found == participants.end() || found->id != id ? nullptr : &*found;
}

/// The motion of one whom contacts push.
impact::Body body_of(const Model& model, const State& state, const Participant& one) {
  if (const LooseBody* loose = find_loose(state, one.id)) return loose->body;
  if (one.id == driver_participant) return vehicle::planar_body(model.car.body, state.car);
  return impact_side(one, mass_kg(model, one)).body;
}

double mass_centre_above_m(const Model& model, const Participant& one) {
  if (one.id == driver_participant) return model.car.body.mass_centre_z_m;
  const VehicleModel& shape = vehicle_models()[one.model];
  return 0.5 * (vehicle_body(shape.kind).clearance_m + shape.height_m);
}

/// Takes over a side's motion; what it has lost since its last push is of wheels and others.
void settle(const impact::Body& now, impact::Body& last, OpenCrash& crash) {
  crash.wheels_j += impact::kinetic_loss_j(last, now);
  last = now;
}

}  // namespace

void note_poses(const Model& model, const std::vector<Participant>& participants, State& state) {
  for (OpenCrash& crash : state.open_crashes) {
    const Participant* first = find(participants, crash.record.first);
    const Participant* second = crash.record.second ? find(participants, *crash.record.second) : nullptr;
    if (first) crash.record.of_first.mass_centre_above_m = mass_centre_above_m(model, *first);
    if (second) crash.record.of_second.mass_centre_above_m = mass_centre_above_m(model, *second);
    const bool is_pushed = crash.last_push == state.tick;
    if (is_pushed && first && crash.first_moves) settle(body_of(model, state, *first), crash.first, crash);
    if (!second || !crash.second_moves) continue;
    if (is_pushed) settle(body_of(model, state, *second), crash.second, crash);
    if (!first || !crash.first_moves) continue;
    const impact::Outline own = impact_side(*first, 1.0).outline, other = impact_side(*second, 1.0).outline;
    crash.deepest_m = std::max(crash.deepest_m, -impact::nearest(own, other).gap_m);
    if (is_pushed) crash.record.depth_m = crash.deepest_m;
  }
}

}  // namespace septet::simulation
