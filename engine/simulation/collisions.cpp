#include "engine/simulation/collisions.hpp"

#include <algorithm>
#include <utility>

#include <fmt/core.h>

#include "engine/simulation/effects/body_box.hpp"

namespace septet::simulation {
namespace {

/// No part of a vehicle is farther than this from its origin.
double reach_m(const VehicleModel& model) { return model.length_m + model.width_m; }

}  // namespace

void find_collisions(const Participant& car, const std::vector<Participant>& participants, State& state,
                     std::vector<Event>& events) {
  std::vector<ParticipantId> touching;
  // No collision is possible from this distance on: nearly all participants are dismissed by this test alone.
  double apart_m = 0.0;
  for (const VehicleModel& model : vehicle_models()) apart_m = std::max(apart_m, 2.0 * reach_m(model));
  for (const Participant& other : participants) {
    if (other.id == car.id) continue;
    const Vec2 apart = other.world_from_vehicle.position_m - car.world_from_vehicle.position_m;
    if (glm::dot(apart, apart) > apart_m * apart_m || !contact_of(body_box(car), body_box(other))) continue;
    touching.push_back(other.id);
    if (std::ranges::binary_search(state.touching, other.id)) continue;
    ++state.diagnostics.collisions;
    state.effects.crashes.struck_by_driver.push_back(other.id);
    events.push_back({"collision", other.id,
                      fmt::format("closing_speed_mps={:.2f}", glm::length(car.velocity_mps - other.velocity_mps))});
  }
  state.touching = std::move(touching);
}

}  // namespace septet::simulation
