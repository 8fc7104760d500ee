#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

#include "engine/core/check.hpp"
#include "engine/traffic/network/town_stages.hpp"

namespace septet::traffic {
namespace {

constexpr int tries = 40;
/// Vehicles come in no nearer to the swarm's middle than this share of its radius, and than the distance.
constexpr double entry_share = 0.5, entry_m = 120.0;
constexpr double beside_driver_m = 12.0;
/// Long vehicles do not take turns tighter than this in their own lane.
constexpr double tight_per_m = 1.0 / 9.0;
constexpr double turn_back_rad = 2.6;

bool is_long(ModelIndex model) { return vehicle_models()[model].length_m > long_vehicle_m; }

/// False in a town with turns that a long vehicle does not take in its own lane: long ones stay out of it.
bool admits_long(const LaneGraph& graph) {
  return std::ranges::none_of(graph.ways,
                              [](const Way& way) { return way.in_junction() && way.tightest_per_m > tight_per_m; });
}

const VehicleClass& draw_class(const TrafficParameters& parameters, bool with_long, Random& random) {
  double total = 0.0;
  const auto share = [&](const VehicleClass& entry) { return with_long || !is_long(entry.model) ? entry.share : 0.0; };
  for (const VehicleClass& entry : parameters.classes) total += share(entry);
  double at = random.uniform(0.0, total);
  for (const VehicleClass& entry : parameters.classes)
    if ((at -= share(entry)) < 0.0) return entry;
  return parameters.classes.front();
}

void add_member(const TrafficParameters& parameters, bool with_long, Random& random, TownState& town) {
  const VehicleClass& kind = draw_class(parameters, with_long, random);
  const double bell = (random.uniform() + random.uniform() + random.uniform()) / 3.0;
  const double temperament = 0.5 + kind.temperament_spread * (bell - 0.5) * 1.5;
  TownVehicle& vehicle = town.vehicles.emplace_back();
  vehicle.id = town.next_id++;
  vehicle.model = kind.model;
  vehicle.paint = static_cast<std::uint8_t>(random.below(12));
  vehicle.driver = driver_in_town(kind.middle, temperament);
  vehicle.law = FollowingLaw(vehicle.driver.following);
  vehicle.urge = 1.15 - 0.3 * std::clamp(temperament, 0.0, 1.0);
}

/// Ways that hold a vehicle, with their lengths summed up; those without an end if there are any.
struct Places {
  std::vector<WayIndex> ways;
  std::vector<double> until_m;
};

Places places_within(const TrafficParameters& parameters, const LaneGraph& graph, const Vec3& middle_m) {
  Places places;
  constexpr double least_m = 15.0;
  for (const bool endless : {true, false}) {
    double sum_m = 0.0;
    for (WayIndex index = 0; index < graph.ways.size(); ++index) {
      const Way& way = graph.ways[index];
      if (way.in_junction() || way.length_m < least_m || way.goes_on != endless) continue;
      const Vec3 at = place_on_way(graph, way, 0.5 * way.length_m).position_m;
      if (glm::distance(at, middle_m) > parameters.radius_m + 0.5 * way.length_m) continue;
      places.ways.push_back(index);
      places.until_m.push_back(sum_m += way.length_m);
    }
    if (!places.ways.empty()) break;
  }
  return places;
}

/// Bodies on a way near a place: its rear and front in presences, and vehicles placed since.
bool is_clear(std::span<const Presence> presences, const TownState& town, WayIndex way, double front_m, double rear_m,
              double& ahead_m, double& ahead_mps) {
  constexpr double apart_m = 6.0;
  const auto near = [&](double low_m, double high_m, double mps) {
    if (high_m > rear_m - apart_m && low_m < front_m + apart_m) return true;
    // Room for him who comes from behind to notice.
    if (high_m <= rear_m && rear_m - high_m < 2.0 * mps + apart_m) return true;
    if (low_m > front_m && low_m - front_m < ahead_m) ahead_m = low_m - front_m, ahead_mps = mps;
    return false;
  };
  for (const Presence& other : presences)
    if (other.is_there() && near(other.rear_m, other.front_m, other.speed_mps)) return false;
  for (const TownVehicle& other : town.vehicles)
    if (!other.outside && other.route.front() == way &&
        near(other.front_m - other.length_m(), other.front_m, other.speed_mps))
      return false;
  return true;
}

/// True where a body from one place of a way to another, and one on any way, stand in each other: lanes may lie nearer to
/// each other than cars are wide. Both as rows of circles along their middle lines.
bool is_in_somebody(const LaneGraph& graph, const TownState& town, const VehicleModel& body, const Way& way,
                    double front_m) {
  constexpr double step_m = 0.5, beside_m = 0.2;
  const Vec3 own_front_m = place_on_way(graph, way, front_m).position_m;
  return std::ranges::any_of(town.vehicles, [&](const TownVehicle& other) {
    if (other.outside) return false;
    const VehicleModel& his = vehicle_models()[other.model];
    const double least_m = 0.5 * (body.width_m + his.width_m) + beside_m;
    const auto place_of = [&](double back_m) {
      return place_on_route(graph, other, other.front_m - back_m).position_m;
    };
    if (glm::distance(place_of(0.0), own_front_m) > body.length_m + his.length_m + least_m) return false;
    for (double own_m = 0.0; own_m <= body.length_m; own_m += step_m)
      for (double his_m = 0.0; his_m <= his.length_m; his_m += step_m)
        if (glm::distance(place_on_way(graph, way, front_m - own_m).position_m, place_of(his_m)) < least_m) return true;
    return false;
  });
}

/// True where somebody walks on a crossing of the way, from behind the rear of a vehicle to where it could stop.
bool somebody_crosses(const LaneGraph& graph, const TownState& town, const Way& way, double rear_m, double front_m) {
  constexpr double behind_m = 3.0, stops_in_m = 40.0;
  for (const WalkedStretch& stretch : graph.walked_of(way)) {
    if (stretch.to_m < rear_m - behind_m || stretch.from_m > front_m + stops_in_m) continue;
    if (!std::ranges::all_of(people_at(town, stretch.crossing), &PersonCrossing::waits)) return true;
  }
  return false;
}

/// Speed that the bends allow to a vehicle of which all from its rear to its front is in them.
double bend_mps(const LaneGraph& graph, const Way& way, double rear_m, double front_m) {
  double square_m2ps2 = bend_square_at(graph, way, front_m).m2ps2;
  for (double at = rear_m; at < front_m; at += 1.0)
    square_m2ps2 = std::min(square_m2ps2, bend_square_at(graph, way, at).m2ps2);
  return std::sqrt(square_m2ps2);
}

bool try_to_enter(const TrafficParameters& parameters, const LaneGraph& graph, const Presences& presences,
                  const Places& places, const Vec3& middle_m, double least_m, Random& random, TownState& town,
                  TownVehicle& vehicle) {
  const double at = random.uniform(0.0, places.until_m.back());
  const auto k = static_cast<std::size_t>(std::ranges::upper_bound(places.until_m, at) - places.until_m.begin());
  const WayIndex index = places.ways[std::min(k, places.ways.size() - 1)];
  const Way& way = graph.ways[index];
  const double front_m = random.uniform(0.0, way.length_m);
  const double length_m = vehicle.length_m();
  const double to_end_m = way.length_m - front_m;
  if (front_m < length_m + 1.0 || to_end_m < way.line_before_m + 1.0) return false;
  // Where a lane opens or ends it is narrower than what drives on it, and lies in its neighbour.
  const double width_m = vehicle_models()[vehicle.model].width_m;
  for (const double at_m : {front_m - length_m, front_m})
    if (place_on_way(graph, way, at_m).width_m < width_m) return false;
  const Vec3 there = place_on_way(graph, way, front_m).position_m;
  const double distance_m = glm::distance(there, middle_m);
  if (distance_m < least_m || distance_m > parameters.radius_m) return false;
  double ahead_m = 200.0, ahead_mps = 0.0;
  if (!is_clear(presences.on(index), town, index, front_m, front_m - length_m, ahead_m, ahead_mps)) return false;
  if (is_in_somebody(graph, town, vehicle_models()[vehicle.model], way, front_m)) return false;
  if (somebody_crosses(graph, town, way, front_m - length_m, front_m)) return false;
  vehicle.outside = false;
  vehicle.route = {index};
  vehicle.front_m = front_m;
  const double v = std::sqrt(2.0 * 1.2 * std::max(0.0, std::min(to_end_m - way.line_before_m, ahead_m) - 4.0));
  vehicle.speed_mps = std::min({v, 0.9 * way.limit_mps, 0.9 * vehicle.driver.following.desired_speed_mps,
                                0.9 * bend_mps(graph, way, front_m - length_m, front_m)});
  vehicle.acceleration_mps2 = 0.0;
  vehicle.rolled_m = front_m;
  vehicle.claims.clear();
  vehicle.waits_s = vehicle.stands_s = vehicle.unused_s = vehicle.hidden_s = 0.0;
  vehicle.is_held = false;
  prolong_route(graph, random, vehicle);
  return true;
}

void take_away(TownVehicle& vehicle) {
  vehicle.outside = true;
  vehicle.route.clear();
  vehicle.front_m = vehicle.speed_mps = vehicle.acceleration_mps2 = 0.0;
  vehicle.claims.clear();
  vehicle.waits_s = vehicle.stands_s = vehicle.unused_s = vehicle.hidden_s = 0.0;
  vehicle.is_held = false;
  vehicle.swerve.reset();
}

}  // namespace

void prolong_route(const LaneGraph& graph, Random& random, TownVehicle& vehicle) {
  // A claim covers all of a junction and ends where there is room beyond: so must the route.
  const double room_m = vehicle.length_m() + standing_gap_m;
  double end_m = -vehicle.front_m, free_m = 0.0;
  const auto add_to_end = [&](const Way& way) {
    end_m += way.length_m;
    free_m = way.in_junction() ? 0.0 : free_m + way.length_m;
  };
  for (const WayIndex index : vehicle.route) add_to_end(graph.ways[index]);
  constexpr std::size_t most_ways = 400;
  while ((end_m < horizon_m || free_m < room_m) && vehicle.route.size() < most_ways) {
    const auto next = graph.next_of(graph.ways[vehicle.route.back()]);
    if (next.empty()) return;
    // Those that suit it, else those that go on, else any.
    const auto suits = [&](WayIndex index, int least) {
      const Way& way = graph.ways[index];
      if (least < 2 && !way.goes_on) return false;
      return least > 0 ||
             (std::abs(way.turns_rad) < turn_back_rad && (!is_long(vehicle.model) || way.tightest_per_m < tight_per_m));
    };
    for (int least = 0; least < 3; ++least) {
      const auto count = std::ranges::count_if(next, [&](WayIndex index) { return suits(index, least); });
      if (count == 0) continue;
      auto chosen = random.below(static_cast<std::uint64_t>(count));
      for (const WayIndex index : next)
        if (suits(index, least) && chosen-- == 0) {
          vehicle.route.push_back(index);
          break;
        }
      break;
    }
    add_to_end(graph.ways[vehicle.route.back()]);
  }
}

void choose_anew_if_tired(const LaneGraph& graph, double dt_s, Random& random, TownVehicle& vehicle) {
  constexpr double after_s = 60.0, each_s = 5.0;
  const double before_s = vehicle.waits_s - dt_s;
  if (vehicle.waits_s < after_s || std::floor(vehicle.waits_s / each_s) == std::floor(before_s / each_s)) return;
  // What it has a claim on it drives; who waits has reached no other junction.
  double end_m = 0.0;
  for (std::size_t k = 0; k < vehicle.route.size(); ++k) {
    if (end_m >= vehicle.front_m && k > 0 && k >= vehicle.claims.size() && graph.ways[vehicle.route[k]].in_junction()) {
      vehicle.route.resize(k);
      prolong_route(graph, random, vehicle);
      return;
    }
    end_m += graph.ways[vehicle.route[k]].length_m;
  }
}

Driver driver_in_town(const Driver& middle, double temperament) {
  constexpr double time_gap_share = 0.75;
  Driver driver = with_temperament(middle, temperament);
  driver.following.time_gap_s *= time_gap_share;
  return driver;
}

TownState populate_town(const TrafficParameters& parameters, const road::RoadNetwork& network, const LaneGraph& graph,
                        std::span<const ForeignVehicle> foreign, Random& random) {
  TownState town;
  town.next_id = parameters.first_id;
  if (parameters.count == 0 || graph.ways.empty()) return town;
  SEPTET_CHECK(!parameters.classes.empty(), "{} vehicles of no class", parameters.count);
  const Presences presences = find_presences(network, graph, foreign, 0.0, town);
  const Vec3 middle_m = foreign.empty() ? Vec3(0.5 * (network.low_m + network.high_m), 0.0)
                                        : foreign.front().world_from_vehicle.position_m;
  const Places places = places_within(parameters, graph, middle_m);
  town.vehicles.reserve(parameters.count);
  for (std::uint32_t k = 0; k < parameters.count; ++k) add_member(parameters, admits_long(graph), random, town);
  if (places.ways.empty()) return town;
  for (TownVehicle& vehicle : town.vehicles)
    for (int attempt = 0; attempt < 5 * tries; ++attempt)
      if (try_to_enter(parameters, graph, presences, places, middle_m, foreign.empty() ? 0.0 : beside_driver_m, random,
                       town, vehicle))
        break;
  return town;
}

void recycle_town(const TrafficParameters& parameters, const LaneGraph& graph, const Presences& presences,
                  const Vec3& middle_m, Random& random, TownState& town) {
  for (TownVehicle& vehicle : town.vehicles) {
    if (vehicle.outside) continue;
    double begin_m = 0.0;
    for (const WayIndex index : vehicle.route) begin_m += graph.ways[index].length_m;
    const bool at_end = vehicle.front_m > begin_m - 1.0 && graph.ways[vehicle.route.back()].next.count == 0;
    const Vec3 at = place_on_way(graph, graph.ways[vehicle.route.front()], vehicle.front_m).position_m;
    if (at_end || glm::distance(at, middle_m) > 1.1 * parameters.radius_m) take_away(vehicle);
  }
  if (std::ranges::none_of(town.vehicles, &TownVehicle::outside)) return;
  const Places places = places_within(parameters, graph, middle_m);
  if (places.ways.empty()) return;
  const double least_m = std::max(entry_share * parameters.radius_m > 600.0 ? 300.0 : entry_share * parameters.radius_m,
                                  std::min(entry_m, 0.8 * parameters.radius_m));
  for (TownVehicle& vehicle : town.vehicles)
    for (int attempt = 0; vehicle.outside && attempt < tries; ++attempt)
      try_to_enter(parameters, graph, presences, places, middle_m, least_m, random, town, vehicle);
}

void worsen_town(TrafficParameters& parameters, const LaneGraph& graph, std::uint32_t more, Random& random,
                 TownState& town) {
  ++parameters.worsened;
  for (TownVehicle& vehicle : town.vehicles) {
    vehicle.driver = with_worse_manners(vehicle.driver);
    vehicle.law = FollowingLaw(vehicle.driver.following);
  }
  for (std::uint32_t k = 0; k < more; ++k) {
    add_member(parameters, admits_long(graph), random, town);
    for (std::uint32_t step = 0; step < parameters.worsened; ++step)
      town.vehicles.back().driver = with_worse_manners(town.vehicles.back().driver);
    town.vehicles.back().law = FollowingLaw(town.vehicles.back().driver.following);
  }
  parameters.count += more;
}

}  // namespace septet::traffic
