#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <optional>
#include <span>
#include <vector>

#include "engine/traffic/network/town_stages.hpp"

namespace septet::traffic {
namespace {

constexpr double braking_mps2 = 1.0;  ///< A leader's, that is to be noticed.
constexpr double follows_s = 2.5, least_follows_mps = 5.0;
constexpr double runs_light_mps = 3.0;  ///< Slower ones stop at a light.

std::optional<ParticipantId> id_of(const TownTick& tick, const TownState& town, std::int32_t who) {
  if (who >= 0) return town.vehicles[static_cast<std::size_t>(who)].id;
  const auto foreign = static_cast<std::size_t>(-1 - static_cast<std::int64_t>(who));
  return foreign < tick.foreign.size() ? std::optional(tick.foreign[foreign].id) : std::nullopt;
}

std::optional<std::int32_t> who_is(const TownTick& tick, const TownState& town, ParticipantId id) {
  if (const auto own = std::ranges::find(town.vehicles, id, &TownVehicle::id); own != town.vehicles.end())
    return static_cast<std::int32_t>(own - town.vehicles.begin());
  if (const auto other = std::ranges::find(tick.foreign, id, &ForeignVehicle::id); other != tick.foreign.end())
    return -1 - static_cast<std::int32_t>(other - tick.foreign.begin());
  return std::nullopt;
}

DriverError* waiting_error(ParticipantId who, PeopleError kind, TownErrors& errors) {
  for (DriverError& error : errors_of(who, errors))
    if (error.kind == kind && error.stage == DriverError::Stage::waits) return &error;
  return nullptr;
}

void begin(std::optional<ParticipantId> whom, double time_s, DriverError& error, TownErrors& errors) {
  error.stage = DriverError::Stage::runs;
  error.whom = whom;
  error.since_s = time_s;
  errors.told.push_back(
      {.kind = error.kind, .who = error.who, .whom = whom, .lasted_s = 0.0, .end = {}, .nearest_m = {}});
}

void remember(const Leader& leader, DriverError& error) {
  error.leader_gap_m = leader.gap_m;
  error.leader_mps = leader.speed_mps;
}

/// Where he takes his leader to be by now.
Leader remembered(const TownTick& tick, const TownVehicle& vehicle, DriverError& error) {
  error.leader_gap_m -= (vehicle.speed_mps - error.leader_mps) * tick.dt_s;
  Leader leader;
  leader.gap_m = error.leader_gap_m;
  leader.speed_mps = error.leader_mps;
  return leader;
}

bool brakes(const TownTick& tick, const TownState& town, const Leader& leader) {
  if (leader.speed_mps < least_follows_mps) return false;
  if (leader.who >= 0) return town.vehicles[static_cast<std::size_t>(leader.who)].acceleration_mps2 < -braking_mps2;
  const auto foreign = static_cast<std::size_t>(-1 - static_cast<std::int64_t>(leader.who));
  return foreign < tick.foreign.size() && tick.foreign[foreign].lamps.has(Lamp::brake);
}

/// An overlook, by an impulse or a wish, begins where he would go but for one other.
void overlook_if_due(const TownTick& tick, const Presences& presences, TownState& town, std::size_t index) {
  TownErrors& errors = town.errors;
  const ParticipantId self = town.vehicles[index].id;
  DriverError* error = waiting_error(self, PeopleError::overlook, errors);
  if (error == nullptr && errors.awaited.empty()) return;
  const Leader leader = leader_of(tick.graph, presences, town, index);
  const auto who = only_one_let_pass(tick.graph, tick.lights, leader, presences, town, index);
  const auto whom = who ? id_of(tick, town, *who) : std::nullopt;
  if (!whom) return;
  const auto wish = std::ranges::find(errors.awaited, *whom, &AwaitedOverlook::whom);
  if (error == nullptr && wish == errors.awaited.end()) return;
  if (wish != errors.awaited.end()) errors.awaited.erase(wish);
  if (error == nullptr) error = &add_error({.who = self, .kind = PeopleError::overlook, .whom = {}}, errors);
  begin(whom, town.time_s, *error, errors);
}

Minded mind_but_one(const TownTick& tick, Random& random, Presences& presences, TownState& town, std::size_t index,
                    std::int32_t overlooked) {
  Presences seen = without(presences, overlooked);
  const Minded minded = mind_others(tick, random, seen, town, index);
  // His claim is shown to all.
  const auto self = static_cast<std::int32_t>(index);
  for (const Presence& own : seen.all)
    if (own.who == self && own.claims)
      for (std::uint32_t p = presences.first[own.way]; p < presences.first[own.way + 1]; ++p)
        if (presences.all[p].who == self) presences.all[p].claims = true;
  return minded;
}

Minded mind_late(const TownTick& tick, Random& random, Presences& presences, TownState& town, std::size_t index,
                 DriverError& error) {
  Minded minded = mind_others(tick, random, presences, town, index);
  if (error.stage == DriverError::Stage::waits) {
    const double v = town.vehicles[index].speed_mps;
    if (v < least_follows_mps || minded.leader.gap_m > follows_s * v || !brakes(tick, town, minded.leader))
      return minded;
    remember(minded.leader, error);
    begin(id_of(tick, town, minded.leader.who), town.time_s, error, town.errors);
  }
  minded.leader = remembered(tick, town.vehicles[index], error);
  return minded;
}

Minded mind_telephone(const TownTick& tick, const Presences& presences, TownState& town, std::size_t index,
                      DriverError& error) {
  Minded minded;
  if (error.stage == DriverError::Stage::waits) {
    remember(leader_of(tick.graph, presences, town, index), error);
    error.waits_within = wait_within_mps2(tick.graph, presences, town, index) != no_leader;
    begin({}, town.time_s, error, town.errors);
  }
  minded.leader = remembered(tick, town.vehicles[index], error);
  minded.line_m = stop_unclaimed_m(tick.graph, town.vehicles[index]);
  if (error.waits_within) minded.within_mps2 = wait_within_mps2(tick.graph, presences, town, index);
  return minded;
}

/// The lights as he takes them, perhaps from now on; empty: as they are.
std::vector<LightState> lights_taken(const TownTick& tick, TownState& town, const TownVehicle& vehicle,
                                     DriverError& error) {
  const auto ahead = light_ahead(tick.graph, vehicle);
  const std::vector<double>& red_for_s = town.errors.red_for_s;
  if (!ahead || ahead->line_m <= 0.0 || tick.lights.empty() || red_for_s.size() != tick.lights.size()) return {};
  const Way& before = tick.graph.ways[ahead->way];
  const std::size_t light = 2 * before.road + (before.along_s ? 0 : 1);
  const bool waits = error.stage == DriverError::Stage::waits;
  if (waits && tick.lights[light] == LightState::red && vehicle.speed_mps > runs_light_mps &&
      red_for_s[light] + ahead->line_m / vehicle.speed_mps <= error.lasts_s) {
    error.way = ahead->way;
    begin({}, town.time_s, error, town.errors);
  } else if (waits && tick.lights[light] != LightState::amber) {
    return {};
  }
  std::vector<LightState> taken(tick.lights.begin(), tick.lights.end());
  taken[light] = LightState::green;
  return taken;
}

Minded mind_red(const TownTick& tick, Random& random, Presences& presences, TownState& town, std::size_t index,
                DriverError& error) {
  const std::vector<LightState> taken = lights_taken(tick, town, town.vehicles[index], error);
  const std::span<const LightState> lights = taken.empty() ? tick.lights : taken;
  return mind_others({tick.graph, lights, tick.foreign, tick.dt_s}, random, presences, town, index);
}

/// True where a light that is not green is before him.
bool is_before_light(const TownTick& tick, const TownVehicle& vehicle) {
  const auto ahead = tick.lights.empty() ? std::nullopt : light_ahead(tick.graph, vehicle);
  if (!ahead) return false;
  const Way& before = tick.graph.ways[ahead->way];
  const LightState light = tick.lights[2 * before.road + (before.along_s ? 0 : 1)];
  return light == LightState::amber || light == LightState::red;
}

}  // namespace

Presences without(const Presences& presences, std::int32_t who) {
  Presences others;
  others.all.reserve(presences.all.size());
  others.first.reserve(presences.first.size());
  for (std::size_t way = 0; way + 1 < presences.first.size(); ++way) {
    others.first.push_back(static_cast<std::uint32_t>(others.all.size()));
    for (const Presence& presence : presences.on(static_cast<WayIndex>(way)))
      if (presence.who != who) others.all.push_back(presence);
  }
  others.first.push_back(static_cast<std::uint32_t>(others.all.size()));
  std::ranges::copy_if(presences.high, std::back_inserter(others.high),
                       [&](const HighBody& body) { return body.who != who; });
  return others;
}

Minded mind_erring(const TownTick& tick, Random& random, Presences& presences, TownState& town, std::size_t index) {
  const TownVehicle& vehicle = town.vehicles[index];
  if (running_error(vehicle.id, town.errors) == nullptr) overlook_if_due(tick, presences, town, index);
  DriverError* error = running_error(vehicle.id, town.errors);
  if (error == nullptr) error = waiting_error(vehicle.id, PeopleError::telephone, town.errors);
  if (error == nullptr && is_before_light(tick, vehicle))
    error = waiting_error(vehicle.id, PeopleError::red, town.errors);
  if (error == nullptr) error = waiting_error(vehicle.id, PeopleError::late_brake, town.errors);
  if (error == nullptr) return mind_others(tick, random, presences, town, index);
  if (error->kind == PeopleError::late_brake) return mind_late(tick, random, presences, town, index, *error);
  if (error->kind == PeopleError::telephone) return mind_telephone(tick, presences, town, index, *error);
  if (error->kind == PeopleError::red) return mind_red(tick, random, presences, town, index, *error);
  const auto who = error->whom ? who_is(tick, town, *error->whom) : std::nullopt;
  return who ? mind_but_one(tick, random, presences, town, index, *who)
             : mind_others(tick, random, presences, town, index);
}

}  // namespace septet::traffic
