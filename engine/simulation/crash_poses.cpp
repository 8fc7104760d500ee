#include "engine/simulation/crash_poses.hpp"

#include <algorithm>
#include <optional>

#include "engine/physics/impact/outline.hpp"
#include "engine/simulation/bodies/bodies.hpp"
#include "engine/simulation/bodies/loose_body.hpp"
#include "engine/simulation/thrown_stage.hpp"
#include "engine/world/participant_shape.hpp"
#include "engine/world/vehicle_body.hpp"

namespace septet::simulation {
namespace {

impact::Body body_of(const Model& model, const State& state, const Participant& one) {
  const auto pushed = pushed_body(model, state, one.id);
  return pushed ? *pushed : impact_side(one, mass_kg(model, one)).body;
}

double mass_centre_above_m(const Model& model, const Participant& one) {
  if (one.id == driver_participant) return model.car.body.mass_centre_z_m;
  return middle_height_m(shape_of(one));
}

/// Takes over a side's motion; what it has lost since its last push is of wheels and others.
void settle(const impact::Body& now, impact::Body& last, OpenCrash& crash) {
  crash.wheels_j += impact::kinetic_loss_j(last, now);
  last = now;
}

}  // namespace

void note_poses(const Model& model, const std::vector<Participant>& participants, State& state) {
  for (OpenCrash& crash : state.open_crashes) {
    if (crash.is_impact_over) continue;
    const Participant* first = find_participant(participants, crash.record.first);
    const Participant* second = crash.record.second ? find_participant(participants, *crash.record.second) : nullptr;
    if (first) crash.record.of_first.mass_centre_above_m = mass_centre_above_m(model, *first);
    if (second) crash.record.of_second.mass_centre_above_m = mass_centre_above_m(model, *second);
    // What a vehicle loses to somebody who is thrown is told by itself (thrown_crash.hpp).
    if (is_thrown(state, crash.record.first) || (second && is_thrown(state, second->id))) continue;
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
