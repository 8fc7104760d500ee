#include "engine/simulation/driver_eyes.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include <fmt/core.h>
#include <glm/geometric.hpp>

#include "engine/sight/air.hpp"
#include "engine/sight/lookout.hpp"
#include "engine/simulation/air_now.hpp"
#include "engine/world/participant_sight.hpp"
#include "engine/world/seen_participants.hpp"

namespace septet::simulation {
namespace {

constexpr Tick eyes_ticks = 12;

/// Those near the driver's eyes, in the order of all.
std::vector<const Participant*> near_ones(const std::vector<Participant>& participants, const Vec3& eye_m) {
  std::vector<const Participant*> near;
  for (const Participant& other : participants)
    if (other.id != driver_participant &&
        glm::distance(other.world_from_vehicle.position_m, eye_m) < looked_for_within_m)
      near.push_back(&other);
  return near;
}

std::vector<sight::OpaqueBody> opaque_bodies(const std::vector<const Participant*>& near) {
  std::vector<sight::OpaqueBody> bodies;
  bodies.reserve(near.size());
  for (const Participant* other : near)
    if (const auto box = opaque_box_of(*other)) bodies.push_back({other->id, *box});
  return bodies;
}

/// What the air leaves of things around the driver's eyes.
struct Through {
  Air air;
  Vec3 eye_m{0.0};
  double lit_lx = 0.0;
  std::optional<double> beams_rad{};  ///< Heading of the own beams, where they are lit.

  bool sees(const Vec3& place_m, bool shining) const {
    const double away_m = glm::distance(eye_m, place_m);
    const double depth = depth_between(air, eye_m, place_m);
    if (shining && depth <= sight::shining_depth) return true;
    double light_lx = lit_lx;
    if (beams_rad && light_lx < sight::full_light_lx) {
      const Vec3 way = place_m - eye_m;
      light_lx += sight::dipped_light_lx(away_m, depth, std::atan2(way.y, way.x) - *beams_rad);
    }
    return sight::sees_reflecting(depth, light_lx);
  }
};

Through through_air(const Model& model, const State& state, const Participant& driver, const Vec3& eye_m) {
  Through through{.air = air_of(state), .eye_m = eye_m};
  through.lit_lx = through.air.natural_lx;
  if (state.car_road && is_roofed(model.roads, *state.car_road)) through.lit_lx = sight::full_light_lx;
  if (has_beams(driver)) through.beams_rad = heading_rad(driver.world_from_vehicle.orientation);
  return through;
}

/// Somebody's sighting after a look at which the seen point is this far away; empty: he is hidden. Told where he comes into
/// sight.
Sighting looked_at(const Sighting& before, const std::optional<double>& seen_m, Tick tick, std::vector<Event>& events) {
  Sighting now = before;
  now.seen = seen_m.has_value();
  if (!now.seen) return now;
  const double hidden_s = static_cast<double>(tick - before.since) / tick_rate_hz;
  if (!before.seen && hidden_s > (before.was_seen ? remembered_s : 0.0))
    events.push_back({"first_sight", now.id, fmt::format("distance_m={:.1f} hidden_s={:.1f}", *seen_m, hidden_s)});
  now.was_seen = true;
  now.since = tick;
  return now;
}

std::vector<ParticipantId> seen_ids(const std::vector<Sighting>& near) {
  std::vector<ParticipantId> seen;
  for (const Sighting& sighting : near)
    if (sighting.seen) seen.push_back(sighting.id);
  return seen;
}

}  // namespace

void look_for_others(const Model& model, const std::vector<Participant>& participants, State& state,
                     std::vector<Event>& events) {
  if (state.tick != 0 && state.tick % eyes_ticks != 1) return;
  const Participant& driver = participants.front();
  const Vec3 eye_m = driver.world_from_vehicle * driver_eyes_m(vehicle_models()[driver.model]);
  const auto near = near_ones(participants, eye_m);
  const sight::Lookout lookout(eye_m, opaque_bodies(near), model.obstacles ? &model.obstacles->walls() : nullptr,
                               state.gone);
  const Through through = through_air(model, state, driver, eye_m);
  std::vector<Sighting> now;
  now.reserve(near.size());
  for (const Participant* other : near) {
    const bool shining = shines(state, *other);
    const auto point_m = lookout.seen_point(other->id, box_of(*other),
                                            [&](const Vec3& place_m) { return through.sees(place_m, shining); });
    std::optional<double> seen_m;
    if (point_m) seen_m = glm::distance(eye_m, *point_m);
    const auto before = std::ranges::lower_bound(state.sightings.near, other->id, {}, &Sighting::id);
    const bool is_new = before == state.sightings.near.end() || before->id != other->id;
    now.push_back(
        looked_at(is_new ? Sighting{.id = other->id, .since = state.tick} : *before, seen_m, state.tick, events));
  }
  if (seen_ids(now) != seen_ids(state.sightings.near) || now.empty() != state.sightings.near.empty())
    state.sightings.changed = state.tick;
  state.sightings.near = std::move(now);
}

bool is_known(const State& state, ParticipantId id) {
  const auto found = std::ranges::lower_bound(state.sightings.near, id, {}, &Sighting::id);
  if (found == state.sightings.near.end() || found->id != id) return false;
  return found->seen || (found->was_seen && state.tick < found->since + static_cast<Tick>(remembered_s * tick_rate_hz));
}

std::optional<EffectKeyframe> seen_keyframe(const State& state) {
  if (state.sightings.near.empty()) return std::nullopt;
  EffectKeyframe keyframe;
  keyframe.id = seen_effect_id;
  keyframe.kind = seen_keyframe_kind;
  keyframe.data = encode_seen(seen_ids(state.sightings.near));
  keyframe.tick = state.sightings.changed;
  return keyframe;
}

}  // namespace septet::simulation
