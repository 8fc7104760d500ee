/// Trips of given routes through a town, for tests/benchmarks/peers/town_trips.py: how long they take, and vehicle updates
/// a CPU second.
///
///     build/release/septet-town-trips ROAD.xodr TRIPS STEP_S
///
/// TRIPS has a line a trip: when it is due, s, then the ids of its roads, junctions' left out, each driven from its begin
/// to its end. Who finds no room where he comes in waits for it, and that counts. Drivers are drawn as a swarm's; all
/// vehicles are cars.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <iterator>
#include <map>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "engine/core/random.hpp"
#include "engine/road/opendrive_reader.hpp"
#include "engine/traffic/network/town.hpp"
#include "engine/traffic/traffic.hpp"

using namespace septet;
using namespace septet::traffic;

namespace {

struct Trip {
  double due_s = 0.0, entered_s = -1.0, arrived_s = -1.0;
  std::vector<WayIndex> route;
};

[[noreturn]] void fail(const std::string& what) {
  fmt::print(stderr, "{}\n", what);
  std::exit(1);
}

double cpu_s() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

WayIndex way_of_road(const road::RoadNetwork& network, const LaneGraph& graph, const std::string& id) {
  const auto road = road::find_road(network, id);
  if (!road) fail("the network has no road " + id);
  for (WayIndex index = 0; index < graph.ways.size(); ++index)
    if (graph.ways[index].road == *road && graph.ways[index].along_s) return index;
  fail("nobody drives road " + id);
}

/// The connection from one road to the next.
WayIndex between(const LaneGraph& graph, WayIndex from, WayIndex to) {
  for (const WayIndex index : graph.next_of(graph.ways[from])) {
    const auto next = graph.next_of(graph.ways[index]);
    if (std::ranges::find(next, to) != next.end()) return index;
  }
  return no_way;
}

std::vector<Trip> read_trips(const std::string& path, const road::RoadNetwork& network, const LaneGraph& graph) {
  std::ifstream file(path);
  std::vector<Trip> trips;
  for (std::string line; std::getline(file, line);) {
    std::istringstream words(line);
    Trip& trip = trips.emplace_back();
    words >> trip.due_s;
    for (std::string road; words >> road;) {
      const WayIndex way = way_of_road(network, graph, road);
      if (!trip.route.empty()) {
        const WayIndex connection = between(graph, trip.route.back(), way);
        if (connection == no_way) fail(fmt::format("trip {}: no connection to road {}", trips.size(), road));
        trip.route.push_back(connection);
      }
      trip.route.push_back(way);
    }
    if (trip.route.empty()) fail(fmt::format("trip {} has no road", trips.size()));
  }
  if (trips.empty()) fail(path + " has no trips");
  return trips;
}

TownVehicle driven_by_somebody(Random& random) {
  const TrafficParameters all = motorway_traffic(1, 1000.0);
  const VehicleClass& kind = all.classes.front();
  const double bell = (random.uniform() + random.uniform() + random.uniform()) / 3.0;
  const double temperament = 0.5 + kind.temperament_spread * (bell - 0.5) * 1.5;
  TownVehicle car;
  car.model = kind.model;
  car.driver = driver_in_town(kind.middle, temperament);
  car.law = FollowingLaw(car.driver.following);
  car.urge = 1.15 - 0.3 * std::clamp(temperament, 0.0, 1.0);
  car.outside = false;
  return car;
}

/// True where nobody is on the first metres of a way; he comes in with the speed that the room ahead allows.
bool comes_in(const LaneGraph& graph, const TownState& town, TownVehicle& car) {
  double ahead_m = 100.0;
  for (const TownVehicle& other : town.vehicles)
    if (other.route.front() == car.route.front())
      ahead_m = std::min(ahead_m, other.front_m - other.length_m() - car.length_m());
  if (ahead_m < 8.0) return false;
  car.front_m = car.length_m();
  car.speed_mps = std::min(graph.ways[car.route.front()].limit_mps, std::sqrt(2.0 * 1.2 * (ahead_m - 4.0)));
  return true;
}

/// Takes back another way that somebody has chosen who waited long, as a swarm's vehicles do; who has a claim on it drives on.
void keep_to_trip(const Trip& trip, TownVehicle& car) {
  if (car.route.back() == trip.route.back()) return;
  const auto here = std::ranges::find(trip.route, car.route.front());
  const std::vector<WayIndex> left(here, trip.route.end());
  const std::size_t kept = std::max<std::size_t>(1, car.claims.size());
  if (left.size() >= kept &&
      std::equal(left.begin(), left.begin() + static_cast<std::ptrdiff_t>(kept), car.route.begin()))
    car.route = left;
}

/// So far before the end of its trip that a step does not take it to the end, where a swarm's vehicles come in anew.
bool has_arrived(const LaneGraph& graph, const TownVehicle& car) {
  double end_m = 0.0;
  for (const WayIndex way : car.route) end_m += graph.ways[way].length_m;
  return car.front_m > end_m - 5.0;
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 4) fail("usage: septet-town-trips ROAD.xodr TRIPS STEP_S");
  std::ifstream file(arguments[1], std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  const auto network = road::read_opendrive(text, arguments[1]);
  if (!network) fail(network.error().what);
  const LaneGraph graph = build_lane_graph(*network);
  std::vector<Trip> trips = read_trips(arguments[2], *network, graph);
  const double step_s = std::atof(arguments[3]);
  if (!(step_s > 0.0 && step_s <= 0.5)) fail("STEP_S is to be above 0 and at most 0.5");
  Random random(1, 1);
  const TrafficParameters nobody = motorway_traffic(0, 1e6);
  TownState town;
  std::vector<std::size_t> waiting;
  std::size_t next = 0, arrived = 0;
  double updates = 0.0, longest_stand_s = 0.0, driven_cpu_s = 0.0;
  constexpr double most_s = 2.0 * 3600.0;
  while (arrived < trips.size() && town.time_s < most_s) {
    while (next < trips.size() && trips[next].due_s <= town.time_s) waiting.push_back(next++);
    std::erase_if(waiting, [&](std::size_t k) {
      TownVehicle car = driven_by_somebody(random);
      car.id = static_cast<ParticipantId>(k);
      car.route = trips[k].route;
      if (!comes_in(graph, town, car)) return false;
      trips[k].entered_s = town.time_s;
      town.vehicles.push_back(std::move(car));
      return true;
    });
    for (TownVehicle& car : town.vehicles) keep_to_trip(trips[car.id], car);
    const double before_s = cpu_s();
    advance_town(nobody, *network, graph, {}, {}, step_s, random, town);
    driven_cpu_s += cpu_s() - before_s;
    updates += static_cast<double>(town.vehicles.size());
    for (const TownVehicle& car : town.vehicles) longest_stand_s = std::max(longest_stand_s, car.stands_s);
    std::erase_if(town.vehicles, [&](const TownVehicle& car) {
      if (!car.outside && !has_arrived(graph, car)) return false;
      trips[car.id].arrived_s = town.time_s;
      ++arrived;
      return true;
    });
  }
  double sum_s = 0.0;
  for (const Trip& trip : trips)
    if (trip.arrived_s >= 0.0) sum_s += trip.arrived_s - trip.due_s;
  fmt::print(
      "{{\"arrived\": {}, \"mean_s\": {:.3f}, \"updates\": {:.0f}, \"cpu_s\": {:.4f}, \"longest_stand_s\": {:.1f}}}\n",
      arrived, sum_s / static_cast<double>(std::max<std::size_t>(arrived, 1)), updates, driven_cpu_s, longest_stand_s);
}
