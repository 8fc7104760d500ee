#include "sim-server/drive/what_if/variant_outcome.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/core.h>
#include <glm/geometric.hpp>

#include "engine/core/printable.hpp"
#include "engine/math/speed_units.hpp"
#include "engine/physics/impact/outline.hpp"
#include "engine/simulation/effects/body_box.hpp"
#include "logging/study/measures/collisions.hpp"

namespace septet::server {
namespace {

/// Slower than this a car stands.
constexpr double at_rest_mps = 0.05;

impact::Outline outline(const Participant& participant) {
  return simulation::outline_of(simulation::body_box(participant));
}

}  // namespace

std::optional<MetCollision> collision_among(std::span<const simulation::Event> events, const Snapshot& snapshot,
                                            const logging::ParticipantNames& names) {
  const auto hit = std::ranges::find(events, "collision", &simulation::Event::kind);
  if (hit == events.end()) return std::nullopt;
  const Participant* other = hit->participant ? find_participant(snapshot, *hit->participant) : nullptr;
  return MetCollision{.tick = snapshot.tick,
                      .other = hit->participant,
                      .with = other              ? logging::called(names, *other)
                              : hit->participant ? std::to_string(*hit->participant)
                                                 : printable(hit->detail.substr(0, hit->detail.find(' '))),
                      .closing_speed_mps = logging::number_in_detail(hit->detail, "closing_speed_mps").value_or(0.0),
                      .delta_v_mps = logging::number_in_detail(hit->detail, "delta_v_mps").value_or(0.0)};
}

void OutcomeWatch::see(const Snapshot& snapshot, std::span<const simulation::Event> events) {
  outcome_.last_tick = snapshot.tick;
  outcome_.state_hash = snapshot.state_hash;
  if (!outcome_.collision && snapshot.simulated_time_s >= from_s_)
    outcome_.collision = collision_among(events, snapshot, names_);
  const Participant* car = find_participant(snapshot, simulation::driver_participant);
  if (!car) return;
  world_from_car_ = car->world_from_vehicle;
  if (glm::length(car->velocity_mps) > at_rest_mps)
    outcome_.stopped_s.reset();
  else if (!outcome_.stopped_s)
    outcome_.stopped_s = snapshot.simulated_time_s;
  if (!logged_ || !logged_->met.other) return;
  if (const Participant* other = find_participant(snapshot, *logged_->met.other)) {
    const double gap_m = std::max(0.0, impact::nearest(outline(*car), outline(*other)).gap_m);
    outcome_.least_gap_m = std::min(gap_m, outcome_.least_gap_m.value_or(INFINITY));
  }
}

VariantOutcome OutcomeWatch::outcome() const {
  VariantOutcome outcome = outcome_;
  if (logged_ && outcome.stopped_s)
    outcome.before_place_m = glm::dot(logged_->world_from_car.position_m - world_from_car_.position_m,
                                      glm::normalize(logged_->world_from_car.orientation * Vec3(1.0, 0.0, 0.0)));
  return outcome;
}

std::string collision_text(const MetCollision& collision) {
  return fmt::format("hit {} at {:.2f} s with {:.1f} km/h", collision.with,
                     static_cast<double>(collision.tick) / simulation::tick_rate_hz,
                     kmh_per_mps * collision.closing_speed_mps);
}

std::string outcome_text(const VariantOutcome& outcome, const LoggedCollision* logged) {
  if (outcome.collision) {
    std::string text = collision_text(*outcome.collision);
    if (logged && logged->met.other == outcome.collision->other)
      text += fmt::format(" instead of {:.1f} km/h", kmh_per_mps * logged->met.closing_speed_mps);
    return text;
  }
  if (outcome.stopped_s) {
    std::string text = fmt::format("stopped at {:.2f} s", *outcome.stopped_s);
    if (outcome.least_gap_m)
      text += fmt::format(", {:.2f} m before {}", *outcome.least_gap_m, logged->met.with);
    else if (outcome.before_place_m)
      text += fmt::format(", {:.2f} m before the place of the collision with {}", *outcome.before_place_m,
                          logged->met.with);
    return text;
  }
  std::string text =
      fmt::format("no collision until {:.2f} s", static_cast<double>(outcome.last_tick) / simulation::tick_rate_hz);
  if (outcome.least_gap_m)
    text += fmt::format("; the least gap to {} was {:.2f} m", logged->met.with, *outcome.least_gap_m);
  return text;
}

}  // namespace septet::server
