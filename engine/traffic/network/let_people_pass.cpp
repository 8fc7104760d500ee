#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "engine/road/lane_geometry.hpp"
#include "engine/traffic/network/town_stages.hpp"

namespace septet::traffic {
namespace {

constexpr double before_stretch_m = 1.0;  ///< From the line to the crossing.
constexpr double beside_lane_m = 0.6;     ///< Who is that near to a lane is in it.
constexpr double let_pass_mps2 = 2.5;     ///< Braking, at most, for who only waits.
constexpr double nearly_over_m = 0.5,
                 creeps_mps = 2.0;  ///< Of a vehicle whose front is on a stretch: it can still stop.
constexpr double stops_mps2 = 2.0, starts_mps2 = 1.5, over_before_s = 1.0, drives_mps = 2.0;

/// The stretch of a lane at a crossing; `lane` is driven on.
void add_stretch(const road::RoadNetwork& network, const CrossingPlace& place, std::uint32_t crossing, int lane,
                 const LaneGraph& graph, std::vector<std::vector<WalkedStretch>>& by_way) {
  const WayIndex index = way_at(graph, network, place.road, lane, place.s_m);
  if (index == no_way) return;
  const road::Road& road = network.roads[place.road];
  const Way& way = graph.ways[index];
  const road::LaneSection& section = road.sections[way.section];
  const double length_m = std::max(section.s_end_m - section.s_m, 1e-9);
  const auto along_m = [&](double s_m) {
    const double part = std::clamp((s_m - section.s_m) / length_m, 0.0, 1.0);
    return way.length_m * (way.along_s ? part : 1.0 - part);
  };
  const double a = along_m(place.s_m - place.half_m), b = along_m(place.s_m + place.half_m);
  const road::LaneBorders borders = road::lane_borders(road, section, lane, place.s_m);
  const double low_t = std::min(borders.inner_t_m, borders.outer_t_m),
               high_t = std::max(borders.inner_t_m, borders.outer_t_m);
  by_way[index].push_back({crossing, std::min(a, b), std::max(a, b), place.left_t_m - high_t, place.left_t_m - low_t});
}

/// Time in which a vehicle has its rear beyond a place.
double clear_in_s(const TownVehicle& vehicle, double to_m) {
  const double way_m = std::max(0.0, to_m) + vehicle.length_m(), v = vehicle.speed_mps;
  if (v > drives_mps) return way_m / v;
  return (std::sqrt(v * v + 2.0 * starts_mps2 * way_m) - v) / starts_mps2;
}

/// True where a vehicle that comes to a stretch, `line_m` before its line, lets one pass; `line_m` is 0 of one that creeps on the
/// stretch, and lets nobody pass who waits.
bool lets_pass(const TownVehicle& vehicle, const WalkedStretch& stretch, double line_m, double beyond_m,
               const PersonCrossing& person) {
  const double v = vehicle.speed_mps;
  if (person.waits) return line_m > 0.0 && v * v < 2.0 * let_pass_mps2 * std::max(line_m, 0.1);
  const double low_m = stretch.lane_from_m - beside_lane_m, high_m = stretch.lane_to_m + beside_lane_m;
  const bool onwards = person.speed_mps > 0.0;
  if (onwards ? person.at_m > high_m : person.at_m < low_m) return false;
  const double to_lane_m = std::max(0.0, onwards ? low_m - person.at_m : person.at_m - high_m);
  const double comes_s = to_lane_m / std::max(std::abs(person.speed_mps), 0.5);
  return comes_s < clear_in_s(vehicle, beyond_m) + over_before_s;
}

}  // namespace

void mark_crossings(const road::RoadNetwork& network, std::span<const CrossingPlace> places, LaneGraph& graph) {
  std::vector<std::vector<WalkedStretch>> by_way(graph.ways.size());
  for (std::uint32_t crossing = 0; crossing < places.size(); ++crossing) {
    const CrossingPlace& place = places[crossing];
    const road::LaneSection& section = road::section_at(network.roads[place.road], place.s_m);
    for (const road::Lane& lane : section.lanes)
      if (lane.id != 0) add_stretch(network, place, crossing, lane.id, graph, by_way);
  }
  graph.walked.clear();
  for (WayIndex index = 0; index < graph.ways.size(); ++index) {
    auto& stretches = by_way[index];
    std::ranges::sort(stretches, {}, &WalkedStretch::from_m);
    graph.ways[index].walked = {static_cast<std::uint32_t>(graph.walked.size()),
                                static_cast<std::uint32_t>(stretches.size())};
    graph.walked.insert(graph.walked.end(), stretches.begin(), stretches.end());
  }
}

std::span<const PersonCrossing> people_at(const TownState& town, std::uint32_t crossing) {
  const auto first = std::ranges::lower_bound(town.people, crossing, {}, &PersonCrossing::crossing);
  const auto beyond = std::ranges::upper_bound(town.people, crossing, {}, &PersonCrossing::crossing);
  return {first, beyond};
}

double stop_for_people_m(const LaneGraph& graph, const TownState& town, const TownVehicle& vehicle) {
  if (town.people.empty()) return no_leader;
  const double v = vehicle.speed_mps;
  const double looks_m = v * v / (2.0 * stops_mps2) + 0.7 * v + 6.0;
  double begin_m = 0.0;
  for (const WayIndex index : vehicle.route) {
    const Way& way = graph.ways[index];
    if (begin_m - vehicle.front_m > looks_m) break;
    for (const WalkedStretch& stretch : graph.walked_of(way)) {
      const double to_stretch_m = begin_m + stretch.from_m - vehicle.front_m;
      const double beyond_m = begin_m + stretch.to_m - vehicle.front_m;
      const bool creeps_on_it = to_stretch_m < 0.0 && beyond_m > nearly_over_m && v < creeps_mps;
      const double line_m = creeps_on_it ? 0.0 : to_stretch_m - before_stretch_m;
      if ((to_stretch_m < 0.0 && !creeps_on_it) || line_m > looks_m) continue;
      if (std::ranges::any_of(people_at(town, stretch.crossing), [&](const PersonCrossing& person) {
            return lets_pass(vehicle, stretch, line_m, beyond_m, person);
          }))
        return line_m;
    }
    begin_m += way.length_m;
  }
  return no_leader;
}

}  // namespace septet::traffic
