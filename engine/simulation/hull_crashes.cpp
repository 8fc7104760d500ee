#include "engine/simulation/hull_crashes.hpp"

#include <algorithm>
#include <optional>

#include <fmt/core.h>
#include <glm/geometric.hpp>

#include "engine/simulation/crash_recording.hpp"

namespace septet::simulation {
namespace {

/// Begins the record of what stands that the hull has touched in this tick.
void begin_record(const HullOwner& owner, const vehicle::HullTouch& touch, State& state) {
  OpenCrash& crash = open_crash(
      {owner.id, std::nullopt, {Vec2(touch.point_m), -Vec2(touch.normal)}, touch.point_m.z, touch.closing_speed_mps},
      state);
  crash.run = touch.run;
  crash.record.stands = name_of(touch.kind);
  impact::Body body = owner.side.body;
  body.velocity_mps = Vec2(touch.velocity_mps);
  body.yaw_rate_radps = touch.angular_velocity_radps.z;
  note_first(body, owner.mass_centre_ahead_m, true, crash);
  crash.has_ledger = true;
}

void go_on_recording(const HullOwner& owner, const std::vector<vehicle::HullTouch>& before,
                     const vehicle::HullTouch& touch, State& state) {
  OpenCrash* crash = find_open_crash_with_run(state, owner.id, touch.run);
  if (!crash) return;
  const auto known = std::ranges::find(before, touch.run, &vehicle::HullTouch::run);
  const vehicle::HullTouch was = known == before.end() ? vehicle::HullTouch{} : *known;
  const impact::Engagement &now = touch.engagement, &then = was.engagement;
  // What yields is knocked over at once, and its work is not reckoned.
  const bool yields = now.given_ns == Vec2(0.0);
  const Vec2 given_ns = yields ? touch.mass_kg * (was.delta_v_mps - touch.delta_v_mps) : now.given_ns - then.given_ns;
  if (given_ns == Vec2(0.0)) return;
  crash->has_ledger = !yields;
  note_push(state.tick, {owner.side.body, {}, given_ns, impact::difference(now.ledger, then.ledger)}, *crash);
  if (!yields) note_crush(now, owner.side, {}, *crash);
}

void tell_over(ParticipantId owner, const vehicle::HullTouch& touch, State& state, std::vector<Event>& events) {
  constexpr double least_mps = 0.5;  // Slower contacts are leaning.
  const double delta_v_mps = glm::length(touch.delta_v_mps);
  if (touch.closing_speed_mps < least_mps && delta_v_mps < least_mps) return;
  const bool by_driver = owner == driver_participant;
  if (by_driver) ++state.diagnostics.collisions;
  events.push_back({by_driver ? "collision" : "crash_of_others", by_driver ? std::nullopt : std::optional(owner),
                    fmt::format("{} closing_speed_mps={:.2f} delta_v_mps={:.2f}", name_of(touch.kind),
                                touch.closing_speed_mps, delta_v_mps)});
}

}  // namespace

void note_hull(const HullOwner& owner, const std::vector<vehicle::HullTouch>& before, const vehicle::HullState& hull,
               const vehicle::HullReport& met, State& state, std::vector<Event>& events) {
  for (const vehicle::HullTouch& touch : met.begun) state.effects.crashes.struck_standing.push_back({owner.id, touch});
  for (const vehicle::HullTouch& touch : met.over) tell_over(owner.id, touch, state, events);
  for (const vehicle::HullTouch& touch : met.begun) begin_record(owner, touch, state);
  for (const vehicle::HullTouch& touch : hull.touches) go_on_recording(owner, before, touch, state);
}

}  // namespace septet::simulation
