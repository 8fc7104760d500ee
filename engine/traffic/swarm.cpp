#include <algorithm>
#include <cmath>

#include "engine/core/check.hpp"
#include "engine/road/lane_geometry.hpp"
#include "engine/road/lane_links.hpp"
#include "engine/road/road_locate.hpp"
#include "engine/traffic/traffic_stages.hpp"
#include "engine/traffic/wrecks.hpp"

namespace septet::traffic {
namespace {

constexpr int outside = 0;
constexpr double from_end_m = 30.0;
constexpr double standing_mps = 0.5;

/// Gap from bumper to bumper, if all of the corridor's vehicles stood evenly in the lanes that continue.
double mean_gap_m(const TrafficParameters& parameters, const CorridorTraffic& traffic) {
  constexpr double usual_length_m = 5.5;
  int lanes = 0;
  for (const auto& open : traffic.table.open)
    lanes += !open.empty() && open.back().end_m == no_leader && open.front().begin_m == -no_leader;
  const double span = traffic.corridor.closed ? traffic.corridor.length_m : 2.0 * parameters.radius_m;
  const double number = static_cast<double>(std::max<std::size_t>(traffic.size(), 1));
  return std::max(1.0, span * std::max(lanes, 1) / number - usual_length_m);
}

/// True where a vehicle at x has room: by speed, where there is that much room at all.
bool clear_at(const CorridorTraffic& traffic, int lane, double x_m, double length_m, double speed_mps,
              double mean_gap) {
  const auto wanted = [&](double speed) { return std::min(8.0 + 0.8 * speed, 0.45 * mean_gap); };
  std::uint32_t hint = 0;
  const auto [ahead, behind] = neighbours(traffic, lane, x_m, -1, hint);
  if (gap_to(traffic, lane, x_m, ahead) < wanted(speed_mps)) return false;
  if (behind == nullptr) return true;
  LaneEntry own;
  own.x_m = x_m;
  own.length_m = static_cast<float>(length_m);
  return gap_to(traffic, lane, behind->x_m, &own) > wanted(std::max(speed_mps, behind->speed_mps));
}

const VehicleClass& choose_class(const TrafficParameters& parameters, Random& random) {
  double total = 0.0;
  for (const auto& entry : parameters.classes) total += entry.share;
  double at = random.uniform(0.0, total);
  for (const auto& entry : parameters.classes) {
    if ((at -= entry.share) < 0.0) return entry;
  }
  return parameters.classes.back();
}

void add_random_vehicle(const TrafficParameters& parameters, CorridorTraffic& traffic, ParticipantId id,
                        Random& random) {
  const VehicleClass& kind = choose_class(parameters, random);
  // The mean of three: a bell from timid to aggressive.
  const double bell = (random.uniform() + random.uniform() + random.uniform()) / 3.0;
  const Driver driver = with_temperament(kind.middle, 0.5 + kind.temperament_spread * (bell - 0.5) * 1.5);
  add_vehicle(traffic, id, kind.model, driver, outside, 0.0, 0.0);
  traffic.paint.back() = static_cast<std::uint8_t>(random.below(12));
  traffic.next_decision_s.back() = random.uniform(0.0, 2.0 * parameters.decision_interval_s);
}

/// Cars anywhere, lorries on the two outer lanes.
int likely_lane(const CorridorTraffic& traffic, std::size_t i, double x_m, Random& random) {
  int highest = traffic.table.highest;
  while (highest > traffic.table.lowest && lane_end_m(traffic.table, highest, x_m) != no_leader) --highest;
  const bool heavy = traffic.length_m[i] > 8.0;
  const int lowest = heavy ? std::max(traffic.table.lowest, highest - 1) : traffic.table.lowest;
  return lowest + static_cast<int>(random.below(static_cast<std::uint64_t>(highest - lowest + 1)));
}

void put(CorridorTraffic& traffic, std::size_t i, int lane, double x_m) {
  traffic.x_m[i] = traffic.rolled_m[i] = x_m;
  traffic.acceleration_mps2[i] = 0.0;
  traffic.lane[i] = traffic.from_lane[i] = static_cast<std::int16_t>(lane);
  traffic.change_part[i] = 1.0;
  traffic.lane_end_m[i] = lane_end_m(traffic.table, lane, x_m);
  traffic.aside_m[i] = traffic.aside_mps[i] = traffic.aside_target_m[i] = traffic.heard_s[i] = 0.0;
  traffic.making_way[i] = MakingWay::no;
  insert_entry(traffic.order.lanes[static_cast<std::size_t>(lane)], entry_of(traffic, i));
}

bool within_ends(const CorridorTraffic& traffic, double x_m) {
  return traffic.corridor.closed || (x_m >= from_end_m && x_m <= traffic.corridor.length_m - from_end_m);
}

bool try_place(CorridorTraffic& traffic, std::size_t i, double x_m, double mean_gap, Random& random) {
  if (!within_ends(traffic, x_m)) return false;
  const double x = wrap_x(traffic.corridor, x_m);
  const int lane = likely_lane(traffic, i, x, random);
  if (lane_end_m(traffic.table, lane, x) < x + 300.0) return false;
  const FollowingParameters& following = traffic.driver[i].following;
  const double allowed = allowed_speed_mps(traffic.ways.lanes[static_cast<std::size_t>(lane)], x, false);
  const double speed = std::min(
      {0.85 * following.desired_speed_mps, idm_equilibrium_speed(following, std::max(3.0, mean_gap)), allowed});
  if (!clear_at(traffic, lane, x, traffic.length_m[i], speed, mean_gap)) return false;
  // Speed that the one ahead allows, so that a vehicle that comes in does not have to brake at once.
  std::uint32_t hint = 0;
  const LaneEntry* ahead = neighbours(traffic, lane, x, -1, hint).ahead;
  traffic.speed_mps[i] = gap_to(traffic, lane, x, ahead) < 120.0 ? std::min(speed, ahead->speed_mps) : speed;
  put(traffic, i, lane, x);
  return true;
}

void take_out(CorridorTraffic& traffic, std::size_t i) {
  const auto self = static_cast<std::int32_t>(i);
  for (auto& lane : traffic.order.lanes) {
    std::erase_if(lane, [&](const LaneEntry& entry) { return entry.vehicle == self; });
  }
  traffic.lane[i] = traffic.from_lane[i] = outside;
  traffic.speed_mps[i] = traffic.acceleration_mps2[i] = 0.0;
}

/// x of the swarm's middle in a corridor, for either direction of travel.
double middle_x(const road::RoadNetwork& network, const CorridorTraffic& traffic, const TrafficState& state) {
  const double otherwise = 0.5 * traffic.corridor.length_m;
  if (state.foreign_places.empty() || !state.foreign_places.front()) return otherwise;
  const auto& place = *state.foreign_places.front();
  for (const CorridorPiece& piece : traffic.corridor.pieces) {
    if (piece.road == place.road) return x_of(network, traffic.corridor, place, piece.side).value_or(otherwise);
  }
  return otherwise;
}

}  // namespace

TrafficParameters motorway_traffic(std::uint32_t count, double radius_m) {
  const auto model = [](std::string_view name) {
    const auto index = find_vehicle_model(name);
    SEPTET_CHECK(index.has_value(), "no vehicle model {}", name);
    return *index;
  };
  const Driver car{{32.0, 1.3, 1.5, 2.5, 2.0}, {}, 1.0};
  const Driver van{{30.0, 1.4, 1.3, 2.5, 2.2}, {}, 1.0};
  // Lorries keep right more strictly and take longer to change lanes.
  const Driver lorry{{23.5, 1.7, 0.7, 2.0, 2.5}, {0.2, 0.3, 0.3, 2.5, 6.0}, 1.2};
  TrafficParameters parameters;
  parameters.count = count;
  parameters.radius_m = radius_m;
  parameters.classes = {{model("hatchback"), 0.26, car}, {model("saloon"), 0.2, car},
                        {model("estate"), 0.18, car},    {model("suv"), 0.13, car},
                        {model("van"), 0.1, van},        {model("lorry"), 0.12, lorry, 0.35},
                        {model("motorcycle"), 0.01, car}};
  return parameters;
}

void set_mix(TrafficParameters& parameters, std::span<const KindShare> mix) {
  const auto kind_of = [](const VehicleClass& c) { return vehicle_models()[c.model].kind; };
  std::vector<double> shares;
  double all = 0.0;
  for (const VehicleClass& entry : parameters.classes) {
    double wanted = 0.0, before = 0.0;
    for (const KindShare& kind : mix) wanted += kind.kind == kind_of(entry) ? kind.share : 0.0;
    for (const VehicleClass& other : parameters.classes) before += kind_of(other) == kind_of(entry) ? other.share : 0.0;
    shares.push_back(before > 0.0 ? wanted * entry.share / before : 0.0);
    all += shares.back();
  }
  if (!(all > 0.0)) return;
  for (std::size_t i = 0; i < shares.size(); ++i) parameters.classes[i].share = shares[i] / all;
}

TrafficState populate(const TrafficParameters& parameters, const road::RoadNetwork& network,
                      std::span<const ForeignVehicle> foreign, Random& random) {
  TrafficState state;
  if (parameters.count == 0 || network.roads.empty()) return state;
  SEPTET_CHECK(!parameters.classes.empty(), "{} vehicles of no class", parameters.count);
  road::LanePosition through{0, -1, 1.0, 0.0};
  if (!foreign.empty()) {
    const Vec3& at = foreign.front().world_from_vehicle.position_m;
    if (const auto place = road::locate(network, {at.x, at.y}); place && place->lanes.lane != 0) {
      through = {place->position.road, place->lanes.lane, place->position.s_m, 0.0};
    }
  }
  state.corridors.push_back(empty_corridor(network, through));
  if (const auto opposite = opposite_lane(network, through)) {
    state.corridors.push_back(empty_corridor(network, *opposite));
  }
  const std::size_t directions = state.corridors.size();
  add_ramps(network, state);
  const auto placed_foreign = place_foreign(network, foreign, 1.0, state);
  ParticipantId next_id = parameters.first_id;
  const auto opposite_count =
      directions < 2 ? 0 : static_cast<std::uint32_t>(parameters.opposite_share * parameters.count);
  for (std::size_t c = 0; c < directions; ++c) {
    CorridorTraffic& traffic = state.corridors[c];
    refresh_order(traffic, placed_foreign[c]);
    const std::uint32_t wanted = c == 0 ? parameters.count - opposite_count : opposite_count;
    const double middle = middle_x(network, traffic, state);
    for (std::uint32_t k = 0; k < wanted; ++k) add_random_vehicle(parameters, traffic, next_id++, random);
    const double mean_gap = mean_gap_m(parameters, traffic);
    for (std::size_t i = 0; i < traffic.size(); ++i) {
      // On a full road the vehicle waits outside, until `recycle` finds room.
      for (int attempt = 0; attempt < 200; ++attempt) {
        const double x = traffic.corridor.closed ? random.uniform(0.0, traffic.corridor.length_m)
                                                 : middle + random.uniform(-parameters.radius_m, parameters.radius_m);
        if (try_place(traffic, i, x, mean_gap, random)) break;
      }
    }
  }
  return state;
}

void worsen(TrafficParameters& parameters, std::uint32_t more, Random& random, TrafficState& state) {
  if (state.corridors.empty()) return;
  ++parameters.worsened;
  ParticipantId next_id = std::max(parameters.first_id, state.removed_below);
  for (CorridorTraffic& traffic : state.corridors)
    for (std::size_t i = 0; i < traffic.size(); ++i) {
      next_id = std::max(next_id, traffic.id[i] + 1);
      if (traffic.emergency[i] != 0) continue;
      traffic.driver[i] = with_worse_manners(traffic.driver[i]);
      traffic.law[i] = FollowingLaw(traffic.driver[i].following);
    }
  CorridorTraffic& traffic = state.corridors.front();
  for (std::uint32_t k = 0; k < more; ++k) {
    add_random_vehicle(parameters, traffic, next_id++, random);
    for (std::uint32_t step = 0; step < parameters.worsened; ++step)
      traffic.driver.back() = with_worse_manners(traffic.driver.back());
    traffic.law.back() = FollowingLaw(traffic.driver.back().following);
  }
  parameters.count += more;
}

void show_across_rims(const TrafficParameters& parameters, double middle_m, const CorridorTraffic& traffic,
                      ForeignTraffic& seen) {
  if (traffic.corridor.closed) return;
  const double span = 2.0 * parameters.radius_m;
  for (int lane = 1; lane < static_cast<int>(traffic.order.lanes.size()); ++lane) {
    const LaneEntry *first = nullptr, *last = nullptr;
    for (const LaneEntry& entry : traffic.order.lanes[static_cast<std::size_t>(lane)]) {
      if (entry.vehicle < 0 || std::abs(entry.x_m - middle_m) > parameters.radius_m) continue;
      if (last == nullptr) last = &entry;
      first = &entry;
    }
    const auto show = [&](LaneEntry entry, double shift_m) {
      entry.x_m += shift_m;
      entry.vehicle = nobody_here;
      seen.entries.push_back({lane, entry});
    };
    if (last != nullptr && lane_end_m(traffic.table, lane, middle_m) == no_leader)
      show(*last, span), show(*first, -span);
  }
}

void recycle(const TrafficParameters& parameters, double middle, bool middle_stands, Random& random,
             CorridorTraffic& traffic) {
  if (traffic.corridor.closed) return;
  const double mean_gap = mean_gap_m(parameters, traffic);
  for (std::size_t i = 0; i < traffic.size(); ++i) {
    const bool waits = traffic.lane[i] == outside;
    const double ahead = traffic.x_m[i] - middle;
    const bool out = std::abs(ahead) > parameters.radius_m || traffic.x_m[i] > traffic.corridor.length_m - 20.0;
    if (!waits && !out) continue;
    if (!waits) {
      // Enters with the same speed in the same lane at the other rim, where its neighbours have seen it.
      const int lane = traffic.lane[i];
      const double x = traffic.x_m[i] - std::copysign(2.0 * parameters.radius_m, ahead);
      const double speed = traffic.speed_mps[i];
      take_out(traffic, i);
      std::uint32_t hint = 0;
      const auto [front, behind] = neighbours(traffic, lane, x, -1, hint);
      LaneEntry own;
      own.x_m = x, own.length_m = static_cast<float>(traffic.length_m[i]);
      if (within_ends(traffic, x) && lane_end_m(traffic.table, lane, x) == no_leader &&
          gap_to(traffic, lane, x, front) > 2.0 &&
          (behind == nullptr || gap_to(traffic, lane, behind->x_m, &own) > 2.0)) {
        const LaneWay& way = traffic.ways.lanes[static_cast<std::size_t>(lane)];
        traffic.speed_mps[i] = std::min(speed, allowed_speed_mps(way, x, false));
        put(traffic, i, lane, x);
        continue;
      }
    }
    for (int attempt = 0; attempt < 4; ++attempt) {
      // Everybody drives away from one who stands: they come from behind him, at the road's beginning if that is nearer.
      const double side = attempt % 2 == 0 && !middle_stands ? 1.0 : -1.0;
      const double within_m = random.uniform(20.0, 60.0);
      double x = middle + side * (parameters.radius_m - within_m);
      if (middle_stands) x = std::max(x, from_end_m + within_m);
      if (try_place(traffic, i, x, mean_gap, random)) break;
    }
  }
}

void advance(const TrafficParameters& parameters, const road::RoadNetwork& network,
             std::span<const ForeignVehicle> foreign, double dt_s, Random& random, TrafficState& state) {
  state.time_s += dt_s;
  auto placed_foreign = place_foreign(network, foreign, dt_s, state);
  show_across_mouths(state, placed_foreign);
  const std::size_t directions = state.corridors.size() - state.ramps.size();
  const bool middle_stands = !foreign.empty() && glm::length(foreign.front().velocity_mps) < standing_mps;
  for (std::size_t c = 0; c < state.corridors.size(); ++c) {
    CorridorTraffic& traffic = state.corridors[c];
    const double middle = c < directions ? middle_x(network, traffic, state) : 0.0;
    if (c < directions) show_across_rims(parameters, middle, traffic, placed_foreign[c]);
    refresh_order(traffic, placed_foreign[c]);
    const std::vector<Wreck> wrecks = with_the_stuck(placed_foreign[c].wrecks, traffic);
    mark_lanes(wrecks, traffic.order);
    follow(traffic);
    mind_wrecks(wrecks, traffic);
    keep_within_sight(state.sights, traffic);
    make_way(traffic, placed_foreign[c].emergencies, wrecks, dt_s);
    change_lanes(parameters, network, wrecks, state.time_s, dt_s, traffic);
    state.bad_numbers += move(network, traffic, dt_s);
    if (c < directions) recycle(parameters, middle, middle_stands, random, traffic);
  }
  take_ramps(state);
}

}  // namespace septet::traffic
