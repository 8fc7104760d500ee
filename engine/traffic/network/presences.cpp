#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

#include "engine/road/road_locate.hpp"
#include "engine/traffic/network/approach_view.hpp"
#include "engine/traffic/network/town_stages.hpp"
#include "engine/world/participant_sight.hpp"

namespace septet::traffic {
namespace {

/// Of a foreign vehicle's outline, what is taken off at each side: it may reach over a line by that much.
constexpr double over_line_m = 0.45;
constexpr double comes_within_s = 8.0, comes_within_m = 20.0;
constexpr double along_way_cos = 0.5;

void add_own(const LaneGraph& graph, const TownVehicle& vehicle, std::int32_t who, std::vector<Presence>& all) {
  const double length_m = vehicle.length_m();
  double begin_m = 0.0;
  for (std::size_t k = 0; k < vehicle.route.size(); ++k) {
    const Way& way = graph.ways[vehicle.route[k]];
    const double front_m = vehicle.front_m - begin_m;
    const bool claims = k < vehicle.claims.size();
    if (front_m <= 0.0 && !claims && -front_m > comes_within_s * vehicle.speed_mps + comes_within_m) break;
    // Also on the way beyond its claim, where room is kept for it.
    const bool leaves_there = !vehicle.claims.empty() && k == vehicle.claims.size();
    if (front_m > 0.0 || way.in_junction() || claims || leaves_there) {
      Presence presence{vehicle.route[k], who, front_m, front_m - length_m, vehicle.speed_mps};
      presence.claims = claims || (front_m > 0.0 && way.in_junction());
      presence.gives_way = !claims && (vehicle.is_held || vehicle.waits_s > 2.0);
      all.push_back(presence);
    }
    begin_m += way.length_m;
  }
}

/// The stretch of a way that points of an outline lie on.
struct Touch {
  WayIndex way = no_way;
  double low_m = 0.0, high_m = 0.0;
};

double along_way_m(const road::RoadNetwork& network, const Way& way, double s_m) {
  const road::LaneSection& section = network.roads[way.road].sections[way.section];
  const double part = std::clamp((s_m - section.s_m) / std::max(section.s_end_m - section.s_m, 1e-9), 0.0, 1.0);
  return way.length_m * (way.along_s ? part : 1.0 - part);
}

std::vector<Touch> touched_ways(const road::RoadNetwork& network, const LaneGraph& graph,
                                const ForeignVehicle& vehicle) {
  const VehicleModel model = vehicle.shape();
  std::vector<Touch> touched;
  const int along = 2 + static_cast<int>(model.length_m / 2.0);
  const double half_m = std::max(0.1, 0.5 * model.width_m - over_line_m);
  for (int i = 0; i <= along; ++i)
    for (const double y : {-half_m, half_m}) {
      const double x = -model.rear_overhang_m + model.length_m * i / along;
      const Vec3 at = vehicle.world_from_vehicle * Vec3(x, y, 0.0);
      for (const road::Location& place : road::roads_holding(network, {at.x, at.y})) {
        const WayIndex index = way_at(graph, network, place.position.road, place.lanes.lane, place.position.s_m);
        if (index == no_way || place.lanes.lane != place.lanes.lane_any_type) continue;
        const Way& way = graph.ways[index];
        const double m = along_way_m(network, way, place.position.s_m);
        // Below a bridge nobody is on it.
        if (std::abs(place_on_way(graph, way, m).position_m.z - at.z) > road::level_reach_m) continue;
        const auto known = std::ranges::find(touched, index, &Touch::way);
        if (known == touched.end())
          touched.push_back({index, m, m});
        else
          known->low_m = std::min(known->low_m, m), known->high_m = std::max(known->high_m, m);
      }
    }
  return touched;
}

/// The ways to which it may come from the end of `way`, `from_m` beyond its front.
void add_coming(const LaneGraph& graph, WayIndex index, double from_m, int depth, int side, const Presence& as,
                std::vector<Presence>& all) {
  if (depth == 0 || from_m > comes_within_s * as.speed_mps + comes_within_m) return;
  constexpr double turning_rad = 0.5;
  for (const WayIndex next : graph.next_of(graph.ways[index])) {
    const Way& way = graph.ways[next];
    const bool is_entry = way.in_junction() && !graph.ways[index].in_junction();
    const int turns = way.turns_rad > turning_rad ? 1 : way.turns_rad < -turning_rad ? -1 : 0;
    if (is_entry && side != 0 && turns != side) continue;
    if (way.in_junction()) {
      Presence coming = as;
      const double length_m = as.front_m - as.rear_m;
      coming.way = next, coming.front_m = -from_m, coming.rear_m = -from_m - length_m;
      all.push_back(coming);
    }
    add_coming(graph, next, from_m + way.length_m, depth - 1, is_entry ? 0 : side, as, all);
  }
}

void add_foreign(const road::RoadNetwork& network, const LaneGraph& graph, const ForeignVehicle& vehicle,
                 std::int32_t who, double stands_s, std::vector<Presence>& all) {
  const double mps = glm::length(vehicle.velocity_mps);
  const Vec3 heading = vehicle.world_from_vehicle.orientation * Vec3(1.0, 0.0, 0.0);
  const double length_m = vehicle.shape().length_m;
  const bool is_emergency = vehicle.lamps.has(Lamp::siren);
  for (const Touch& touch : touched_ways(network, graph, vehicle)) {
    const Way& way = graph.ways[touch.way];
    const PlaceOnWay place = place_on_way(graph, way, touch.high_m);
    Presence presence{touch.way, who, touch.high_m + 0.3, touch.low_m - 0.3, 0.0};
    // Speed along the traffic: who comes against it is a body that stands.
    presence.speed_mps = std::max(0.0, glm::dot(vehicle.velocity_mps, place.tangent));
    presence.claims = true;
    all.push_back(presence);
    const bool drives_it = !vehicle.adrift && glm::dot(heading, place.tangent) > along_way_cos;
    if (!drives_it) continue;
    const double to_end_m = way.length_m - touch.high_m;
    Presence coming{no_way, who, 0.0, -length_m, mps};
    constexpr double hard_mps2 = 4.0, courtesy_s = 3.0;
    coming.claims = is_emergency || (mps > 1.0 && mps * mps > 2.0 * hard_mps2 * to_end_m);
    coming.gives_way = mps < 0.3 && stands_s > courtesy_s;
    const int side = vehicle.lamps.has(Lamp::indicator_left) == vehicle.lamps.has(Lamp::indicator_right) ? 0
                     : vehicle.lamps.has(Lamp::indicator_left)                                           ? 1
                                                                                                         : -1;
    constexpr int most_ways = 5;
    add_coming(graph, touch.way, to_end_m, most_ways, side, coming, all);
  }
}

void add_foreign_if_high(const ForeignVehicle& vehicle, std::int32_t who, std::vector<HighBody>& high) {
  if (!hides_behind(vehicle.shape())) return;
  Participant body;
  body.model = vehicle.model;
  body.world_from_vehicle = vehicle.world_from_vehicle;
  if (vehicle.box_size_m) set_box_size(*vehicle.box_size_m, body);
  if (const auto box = opaque_box_of(body)) high.push_back({who, does_move(glm::length(vehicle.velocity_mps)), *box});
}

}  // namespace

Presences find_presences(const road::RoadNetwork& network, const LaneGraph& graph,
                         std::span<const ForeignVehicle> foreign, double dt_s, TownState& town) {
  Presences found;
  std::vector<Presence> all;
  for (std::size_t i = 0; i < town.vehicles.size(); ++i)
    if (!town.vehicles[i].outside) {
      add_own(graph, town.vehicles[i], static_cast<std::int32_t>(i), all);
      if (town.vehicles[i].swerve) add_swerve(graph, town.vehicles[i], static_cast<std::int32_t>(i), all);
    }
  town.foreign_stands_s.resize(foreign.size(), 0.0);
  for (std::size_t k = 0; k < foreign.size(); ++k) {
    double& stands_s = town.foreign_stands_s[k];
    stands_s = glm::length(foreign[k].velocity_mps) < 0.3 ? stands_s + dt_s : 0.0;
    add_foreign(network, graph, foreign[k], -1 - static_cast<std::int32_t>(k), stands_s, all);
    add_foreign_if_high(foreign[k], -1 - static_cast<std::int32_t>(k), found.high);
  }
  // Counted by way, then put in its place: the order within a way is that of vehicles.
  found.first.assign(graph.ways.size() + 1, 0);
  for (const Presence& presence : all) ++found.first[presence.way + 1];
  for (std::size_t way = 0; way < graph.ways.size(); ++way) found.first[way + 1] += found.first[way];
  std::vector<std::uint32_t> at(found.first.begin(), found.first.end() - 1);
  found.all.resize(all.size());
  for (const Presence& presence : all) found.all[at[presence.way]++] = presence;
  return found;
}

}  // namespace septet::traffic
