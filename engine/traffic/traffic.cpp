#include "engine/traffic/traffic.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/gtc/constants.hpp>

#include "engine/core/check.hpp"
#include "engine/road/lane_geometry.hpp"
#include "engine/road/road_locate.hpp"
#include "engine/traffic/lane_order.hpp"

namespace septet::traffic {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double hardest_braking_mps2 = 9.0;
constexpr double look_ahead_lane_end_m = 250.0;

/// A foreign vehicle as a corridor's lanes see it.
struct ForeignEntry {
  std::size_t corridor;
  int lane;
  LaneEntry entry;
};

std::vector<ForeignEntry> place_foreign(const road::RoadNetwork& network, std::span<const ForeignVehicle> foreign, TrafficState& state) {
  state.foreign_places.resize(foreign.size());
  std::vector<ForeignEntry> entries;
  for (std::size_t i = 0; i < foreign.size(); ++i) {
    const ForeignVehicle& vehicle = foreign[i];
    const VehicleModel& model = vehicle_models()[vehicle.model];
    const Vec3 middle = vehicle.world_from_vehicle * Vec3(model.centre_x_m(), 0.0, 0.0);
    auto& hint = state.foreign_places[i];
    const auto place = road::locate(network, {middle.x, middle.y}, hint ? &*hint : nullptr);
    if (!place || place->lanes.lane == 0) continue;
    hint = place->position;
    const int lane = std::abs(place->lanes.lane);
    for (std::size_t c = 0; c < state.corridors.size(); ++c) {
      const auto x = x_of(network, state.corridors[c].corridor, place->position, place->lanes.lane);
      if (!x) continue;
      const LaneEntry entry{*x + 0.5 * model.length_m, model.length_m, glm::length(vehicle.velocity_mps), -1};
      entries.push_back({c, lane, entry});
      // Over the line: it is in the way in the next lane too.
      const double width = road::lane_width_m(network, place->position.road, place->lanes.lane, place->position.s_m);
      const double over = std::abs(place->lanes.offset_m) + 0.5 * model.width_m - 0.5 * width;
      const bool outwards = (place->lanes.offset_m > 0.0) == (place->lanes.lane > 0);
      if (over > 0.2) entries.push_back({c, outwards ? lane + 1 : lane - 1, entry});
    }
  }
  return entries;
}

LaneOrder order_lanes(const CorridorTraffic& traffic, std::size_t corridor, const std::vector<ForeignEntry>& foreign) {
  LaneOrder order(static_cast<std::size_t>(traffic.lanes) + 2);
  for (std::size_t i = 0; i < traffic.size(); ++i) {
    const LaneEntry entry{traffic.x_m[i], traffic.length_m[i], traffic.speed_mps[i], static_cast<std::int32_t>(i)};
    order[static_cast<std::size_t>(traffic.lane[i])].push_back(entry);
    if (traffic.from_lane[i] != traffic.lane[i]) order[static_cast<std::size_t>(traffic.from_lane[i])].push_back(entry);
  }
  for (const auto& entry : foreign)
    if (entry.corridor == corridor && entry.lane >= 1 && entry.lane <= traffic.lanes)
      order[static_cast<std::size_t>(entry.lane)].push_back(entry.entry);
  for (auto& lane : order)
    std::ranges::sort(lane, [](const LaneEntry& a, const LaneEntry& b) { return a.x_m != b.x_m ? a.x_m < b.x_m : a.vehicle < b.vehicle; });
  return order;
}

/// The next one ahead of and behind x in a lane, not counting `self`; on a ring the order wraps.
struct Neighbours {
  const LaneEntry* ahead = nullptr;
  const LaneEntry* behind = nullptr;
};

Neighbours neighbours(const CorridorTraffic& traffic, const std::vector<LaneEntry>& lane, double x_m, std::int32_t self) {
  Neighbours result;
  if (lane.empty()) return result;
  const auto first_ahead = std::ranges::upper_bound(lane, x_m, {}, &LaneEntry::x_m) - lane.begin();
  const auto count = static_cast<std::ptrdiff_t>(lane.size());
  const auto pick = [&](std::ptrdiff_t from, std::ptrdiff_t step) -> const LaneEntry* {
    for (std::ptrdiff_t k = 0; k < count; ++k) {
      std::ptrdiff_t at = from + step * k;
      if (at < 0 || at >= count) {
        if (!traffic.corridor.closed) return nullptr;
        at = (at % count + count) % count;
      }
      if (lane[static_cast<std::size_t>(at)].vehicle != self || self < 0) return &lane[static_cast<std::size_t>(at)];
    }
    return nullptr;
  };
  result.ahead = pick(first_ahead, 1);
  result.behind = pick(first_ahead - 1, -1);
  return result;
}

double ring_positive(const Corridor& corridor, double d) { return corridor.closed && d < 0.0 ? d + corridor.length_m : d; }

double gap_to(const CorridorTraffic& traffic, double x_m, const LaneEntry* ahead) {
  if (!ahead) return infinity;
  return ring_positive(traffic.corridor, ahead->x_m - x_m) - ahead->length_m;
}

double acceleration_behind(const CorridorTraffic& traffic, std::size_t i, const LaneEntry* ahead) {
  return idm_acceleration(traffic.following[i], traffic.speed_mps[i], ahead ? ahead->speed_mps : 0.0, gap_to(traffic, traffic.x_m[i], ahead));
}

/// A lane that ends soon is a standing obstacle at its end; the distance to it.
double lane_end_gap(const road::RoadNetwork& network, const CorridorTraffic& traffic, std::size_t i, int lane) {
  constexpr double step_m = 25.0;
  for (double d = 0.0; d <= look_ahead_lane_end_m; d += step_m) {
    const double x = wrap_x(traffic.corridor, traffic.x_m[i] + d);
    if (!traffic.corridor.closed && x > traffic.corridor.length_m) return infinity;
    if (!lane_open(network, traffic.corridor, x, lane)) return std::max(0.1, d - step_m);
  }
  return infinity;
}

/// MOBIL: what the change would bring the driver and, politely, those behind; not a number if it is unsafe.
double incentive(const TrafficParameters& parameters, const CorridorTraffic& traffic, const LaneOrder& order, std::size_t i, int lane,
                 double own_now) {
  const auto self = static_cast<std::int32_t>(i);
  const auto [ahead, behind] = neighbours(traffic, order[static_cast<std::size_t>(lane)], traffic.x_m[i], self);
  const double gap_ahead = gap_to(traffic, traffic.x_m[i], ahead);
  if (gap_ahead < traffic.following[i].standstill_gap_m) return -infinity;
  const double own_then = acceleration_behind(traffic, i, ahead);
  if (own_then < -parameters.lane_change.largest_braking_mps2) return -infinity;
  double others = 0.0;
  if (behind) {
    const double gap = ring_positive(traffic.corridor, traffic.x_m[i] - behind->x_m) - traffic.length_m[i];
    if (gap < 2.0) return -infinity;
    const FollowingParameters& follower = traffic.following[behind->vehicle >= 0 ? static_cast<std::size_t>(behind->vehicle) : i];
    const double then = idm_acceleration(follower, behind->speed_mps, traffic.speed_mps[i], gap);
    if (then < -parameters.lane_change.largest_braking_mps2) return -infinity;
    const double now = idm_acceleration(follower, behind->speed_mps, ahead ? ahead->speed_mps : 0.0,
                                        ahead ? ring_positive(traffic.corridor, ahead->x_m - behind->x_m) - ahead->length_m : infinity);
    others = then - now;
  }
  return own_then - own_now + parameters.lane_change.politeness * others;
}

void decide_lane(const TrafficParameters& parameters, const road::RoadNetwork& network, CorridorTraffic& traffic, const LaneOrder& order,
                 std::size_t i) {
  const LaneChangeParameters& change = parameters.lane_change;
  const int lane = traffic.lane[i];
  const auto self = static_cast<std::int32_t>(i);
  const double end_gap = lane_end_gap(network, traffic, i, lane);
  const double own_now = std::min(acceleration_behind(traffic, i, neighbours(traffic, order[static_cast<std::size_t>(lane)], traffic.x_m[i], self).ahead),
                                  idm_acceleration(traffic.following[i], traffic.speed_mps[i], 0.0, end_gap));
  int best = lane;
  double best_gain = change.threshold_mps2;
  for (const int target : {lane - 1, lane + 1}) {
    if (target < 1 || target > traffic.lanes) continue;
    if (!lane_open(network, traffic.corridor, traffic.x_m[i], target) || lane_end_gap(network, traffic, i, target) < look_ahead_lane_end_m) continue;
    const double gain = incentive(parameters, traffic, order, i, target, own_now) + (target > lane ? change.keep_right_mps2 : -change.keep_right_mps2);
    if (gain > best_gain) {
      best = target;
      best_gain = gain;
    }
  }
  if (best == lane) return;
  traffic.from_lane[i] = static_cast<std::int16_t>(lane);
  traffic.lane[i] = static_cast<std::int16_t>(best);
  traffic.change_s[i] = 0.0;
}

/// x of the swarm's middle in a corridor, for either direction of travel.
double middle_x(const road::RoadNetwork& network, const CorridorTraffic& traffic, const TrafficState& state) {
  if (state.foreign_places.empty() || !state.foreign_places.front()) return 0.5 * traffic.corridor.length_m;
  const auto& place = *state.foreign_places.front();
  return x_of(network, traffic.corridor, place, traffic.corridor.pieces.front().side).value_or(0.5 * traffic.corridor.length_m);
}

bool clear_at(const CorridorTraffic& traffic, const std::vector<LaneEntry>& lane, double x_m, double length_m, double speed_mps) {
  const auto [ahead, behind] = neighbours(traffic, lane, x_m, -2);
  if (ahead && gap_to(traffic, x_m, ahead) < 8.0 + 0.8 * speed_mps) return false;
  return !behind || ring_positive(traffic.corridor, x_m - behind->x_m) - length_m > 8.0 + 0.8 * std::max(speed_mps, behind->speed_mps);
}

const VehicleClass& choose_class(const TrafficParameters& parameters, Random& random) {
  double total = 0.0;
  for (const auto& entry : parameters.classes) total += entry.share;
  double at = random.uniform(0.0, total);
  for (const auto& entry : parameters.classes)
    if ((at -= entry.share) < 0.0) return entry;
  return parameters.classes.back();
}

void add_vehicle(const TrafficParameters& parameters, CorridorTraffic& traffic, ParticipantId id, Random& random) {
  const VehicleClass& kind = choose_class(parameters, random);
  FollowingParameters driver = kind.following;
  driver.desired_speed_mps *= std::max(0.6, 1.0 + kind.desired_speed_spread * random.normal());
  driver.time_gap_s *= std::max(0.5, 1.0 + kind.time_gap_spread * random.normal());
  traffic.id.push_back(id);
  traffic.model.push_back(kind.model);
  traffic.paint.push_back(static_cast<std::uint8_t>(random.below(12)));
  traffic.following.push_back(driver);
  for (auto* array : {&traffic.x_m, &traffic.speed_mps, &traffic.acceleration_mps2, &traffic.wheel_spin_rad, &traffic.change_s})
    array->push_back(0.0);
  traffic.next_decision_s.push_back(random.uniform(0.0, 1.0));
  traffic.lane.push_back(1);
  traffic.from_lane.push_back(1);
  traffic.length_m.push_back(vehicle_models()[kind.model].length_m);
}

/// Cars keep left of what lorries use; lorries the two outer lanes.
int likely_lane(const CorridorTraffic& traffic, std::size_t i, Random& random) {
  const bool heavy = traffic.length_m[i] > 8.0;
  const int lowest = heavy ? std::max(1, traffic.lanes - 1) : 1;
  return lowest + static_cast<int>(random.below(static_cast<std::uint64_t>(traffic.lanes - lowest + 1)));
}

bool try_place(const road::RoadNetwork& network, CorridorTraffic& traffic, LaneOrder& order, std::size_t i, double x_m, int lane) {
  if (!traffic.corridor.closed && (x_m < 30.0 || x_m > traffic.corridor.length_m - 30.0)) return false;
  const double x = wrap_x(traffic.corridor, x_m);
  if (!lane_open(network, traffic.corridor, x, lane)) return false;
  const double speed = traffic.following[i].desired_speed_mps * (0.8 + 0.08 * (traffic.lanes - lane) / std::max(1, traffic.lanes));
  auto& entries = order[static_cast<std::size_t>(lane)];
  if (!clear_at(traffic, entries, x, traffic.length_m[i], speed)) return false;
  // As fast as the one ahead allows: who comes in does not have to brake at once.
  const auto ahead = neighbours(traffic, entries, x, -2).ahead;
  traffic.x_m[i] = x;
  traffic.speed_mps[i] = ahead && gap_to(traffic, x, ahead) < 120.0 ? std::min(speed, ahead->speed_mps) : speed;
  traffic.acceleration_mps2[i] = 0.0;
  traffic.lane[i] = traffic.from_lane[i] = static_cast<std::int16_t>(lane);
  const LaneEntry entry{x, traffic.length_m[i], traffic.speed_mps[i], static_cast<std::int32_t>(i)};
  entries.insert(std::ranges::upper_bound(entries, x, {}, &LaneEntry::x_m), entry);
  return true;
}

/// Who has left the swarm, or the end of the road, comes in at the rim that vehicles enter by.
void recycle(const TrafficParameters& parameters, const road::RoadNetwork& network, CorridorTraffic& traffic, LaneOrder& order,
             double middle, double middle_speed, Random& random) {
  if (traffic.corridor.closed) return;
  for (std::size_t i = 0; i < traffic.size(); ++i) {
    const double away = traffic.x_m[i] - middle;
    const bool out = std::abs(away) > parameters.radius_m + 60.0 || traffic.x_m[i] > traffic.corridor.length_m - 20.0;
    if (!out) continue;
    const bool enters_ahead = traffic.following[i].desired_speed_mps < middle_speed;
    for (int attempt = 0; attempt < 4; ++attempt) {
      const double rim = (enters_ahead != (attempt >= 2) ? 1.0 : -1.0) * (parameters.radius_m - random.uniform(0.0, 40.0));
      if (try_place(network, traffic, order, i, middle + rim, likely_lane(traffic, i, random))) break;
    }
  }
}

int highest_lane(const road::RoadNetwork& network, const Corridor& corridor) {
  int lanes = 0;
  for (const auto& piece : corridor.pieces)
    for (const auto& section : network.roads[piece.road].sections)
      for (const auto& lane : section.lanes)
        if (lane.id * piece.side > 0 && road::is_drivable(lane.type)) lanes = std::max(lanes, std::abs(lane.id));
  return lanes;
}

}  // namespace

double idm_acceleration(const FollowingParameters& driver, double speed_mps, double leader_speed_mps, double gap_m) {
  const double ratio = speed_mps / driver.desired_speed_mps;
  const double free = 1.0 - ratio * ratio * ratio * ratio;
  if (gap_m == infinity) return driver.acceleration_mps2 * free;
  const double dynamic = speed_mps * driver.time_gap_s + speed_mps * (speed_mps - leader_speed_mps) /
                                                             (2.0 * std::sqrt(driver.acceleration_mps2 * driver.comfortable_braking_mps2));
  const double wanted = driver.standstill_gap_m + std::max(0.0, dynamic);
  const double tight = wanted / std::max(gap_m, 0.1);
  return std::max(-hardest_braking_mps2, driver.acceleration_mps2 * (free - tight * tight));
}

TrafficParameters motorway_traffic(std::uint32_t count, double radius_m) {
  const auto model = [](std::string_view name) {
    const auto index = find_vehicle_model(name);
    SEPTET_CHECK(index.has_value(), "no vehicle model {}", name);
    return *index;
  };
  const FollowingParameters car{32.0, 1.3, 1.5, 2.5, 2.0};
  const FollowingParameters van{30.0, 1.4, 1.3, 2.5, 2.2};
  const FollowingParameters lorry{23.5, 1.8, 0.7, 2.0, 2.5};
  TrafficParameters parameters;
  parameters.count = count;
  parameters.radius_m = radius_m;
  parameters.classes = {{model("hatchback"), 0.26, car}, {model("saloon"), 0.2, car}, {model("estate"), 0.18, car},
                        {model("suv"), 0.13, car},       {model("van"), 0.1, van},    {model("lorry"), 0.12, lorry, 0.03, 0.15},
                        {model("motorcycle"), 0.01, car}};
  return parameters;
}

TrafficState populate(const TrafficParameters& parameters, const road::RoadNetwork& network, std::span<const ForeignVehicle> foreign,
                      Random& random) {
  TrafficState state;
  if (parameters.count == 0 || network.roads.empty()) return state;
  SEPTET_CHECK(!parameters.classes.empty(), "{} vehicles of no class", parameters.count);
  road::LanePosition through{0, -1, 1.0, 0.0};
  if (!foreign.empty()) {
    const Vec3& at = foreign.front().world_from_vehicle.position_m;
    if (const auto place = road::locate(network, {at.x, at.y}); place && place->lanes.lane != 0)
      through = {place->position.road, place->lanes.lane, place->position.s_m, 0.0};
  }
  state.corridors.push_back({.corridor = build_corridor(network, through)});
  if (const auto opposite = opposite_lane(network, through)) state.corridors.push_back({.corridor = build_corridor(network, *opposite)});
  for (auto& traffic : state.corridors) traffic.lanes = highest_lane(network, traffic.corridor);

  const auto entries = place_foreign(network, foreign, state);
  ParticipantId next_id = parameters.first_id;
  const auto opposite_count = state.corridors.size() < 2 ? 0 : static_cast<std::uint32_t>(parameters.opposite_share * parameters.count);
  for (std::size_t c = 0; c < state.corridors.size(); ++c) {
    CorridorTraffic& traffic = state.corridors[c];
    const std::uint32_t wanted = c == 0 ? parameters.count - opposite_count : opposite_count;
    const double middle = middle_x(network, traffic, state);
    LaneOrder order = order_lanes(traffic, c, entries);
    for (std::uint32_t k = 0; k < wanted; ++k) {
      add_vehicle(parameters, traffic, next_id++, random);
      const std::size_t i = traffic.size() - 1;
      bool placed = false;
      for (int attempt = 0; attempt < 200 && !placed; ++attempt) {
        const double x = traffic.corridor.closed ? random.uniform(0.0, traffic.corridor.length_m)
                                                 : middle + random.uniform(-parameters.radius_m, parameters.radius_m);
        placed = try_place(network, traffic, order, i, x, likely_lane(traffic, i, random));
      }
      // A road that is full waits outside: far away, until `recycle` finds room.
      if (!placed) traffic.x_m[i] = -1e6 - 1e3 * static_cast<double>(i);
    }
  }
  return state;
}

void advance(const TrafficParameters& parameters, const road::RoadNetwork& network, std::span<const ForeignVehicle> foreign, double dt_s,
             Random& random, TrafficState& state) {
  if (state.corridors.empty()) return;
  state.time_s += dt_s;
  const auto entries = place_foreign(network, foreign, state);
  const double middle_speed = foreign.empty() ? 0.0 : glm::length(foreign.front().velocity_mps);
  for (std::size_t c = 0; c < state.corridors.size(); ++c) {
    CorridorTraffic& traffic = state.corridors[c];
    LaneOrder order = order_lanes(traffic, c, entries);
    // Accelerations from where everybody is now, then everybody moves: the order of the arrays does not matter.
    for (std::size_t i = 0; i < traffic.size(); ++i) {
      const auto self = static_cast<std::int32_t>(i);
      double a = acceleration_behind(traffic, i, neighbours(traffic, order[static_cast<std::size_t>(traffic.lane[i])], traffic.x_m[i], self).ahead);
      if (traffic.from_lane[i] != traffic.lane[i] && traffic.change_s[i] < 0.6 * parameters.lane_change.duration_s)
        a = std::min(a, acceleration_behind(traffic, i, neighbours(traffic, order[static_cast<std::size_t>(traffic.from_lane[i])], traffic.x_m[i], self).ahead));
      traffic.acceleration_mps2[i] = a;
    }
    for (std::size_t i = 0; i < traffic.size(); ++i) {
      if (state.time_s >= traffic.next_decision_s[i] && traffic.from_lane[i] == traffic.lane[i]) {
        traffic.next_decision_s[i] = state.time_s + 0.5;
        const double end_gap = lane_end_gap(network, traffic, i, traffic.lane[i]);
        if (end_gap != infinity)
          traffic.acceleration_mps2[i] = std::min(traffic.acceleration_mps2[i], idm_acceleration(traffic.following[i], traffic.speed_mps[i], 0.0, end_gap));
        decide_lane(parameters, network, traffic, order, i);
        if (traffic.lane[i] != traffic.from_lane[i]) {  // Whoever decides next sees it.
          auto& lane = order[static_cast<std::size_t>(traffic.lane[i])];
          lane.insert(std::ranges::upper_bound(lane, traffic.x_m[i], {}, &LaneEntry::x_m),
                      {traffic.x_m[i], traffic.length_m[i], traffic.speed_mps[i], static_cast<std::int32_t>(i)});
        }
      }
      if (traffic.from_lane[i] != traffic.lane[i]) {
        traffic.change_s[i] += dt_s;
        if (traffic.change_s[i] >= parameters.lane_change.duration_s) {
          traffic.from_lane[i] = traffic.lane[i];
          traffic.next_decision_s[i] = state.time_s + 2.0;
        }
      }
    }
    for (std::size_t i = 0; i < traffic.size(); ++i) {
      const double before = traffic.speed_mps[i];
      traffic.speed_mps[i] = std::max(0.0, before + traffic.acceleration_mps2[i] * dt_s);
      const double rolled = 0.5 * (before + traffic.speed_mps[i]) * dt_s;
      traffic.x_m[i] = wrap_x(traffic.corridor, traffic.x_m[i] + rolled);
      traffic.wheel_spin_rad[i] = std::fmod(traffic.wheel_spin_rad[i] + rolled / vehicle_models()[traffic.model[i]].wheel_radius_m, 2.0 * glm::pi<double>());
    }
    recycle(parameters, network, traffic, order, middle_x(network, traffic, state), middle_speed, random);
  }
}

void hash_state(StateHash& hash, const TrafficState& state) {
  hash.add(state.time_s);
  for (const auto& traffic : state.corridors)
    for (std::size_t i = 0; i < traffic.size(); ++i) {
      hash.add(traffic.id[i]);
      hash.add(traffic.x_m[i]);
      hash.add(traffic.speed_mps[i]);
      hash.add(traffic.lane[i]);
      hash.add(traffic.from_lane[i]);
      hash.add(traffic.change_s[i]);
    }
}

}  // namespace septet::traffic
