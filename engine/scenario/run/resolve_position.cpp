#include "engine/scenario/run/resolve_position.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "engine/road/lane_geometry.hpp"
#include "engine/road/lane_links.hpp"
#include "engine/road/road_locate.hpp"
#include "engine/scenario/run/route.hpp"

namespace septet::scenario {
namespace {

constexpr double pi = std::numbers::pi;

}  // namespace

Placement place_at(const RigidTransform& pose, const road::RoadNetwork& network, const road::RoadPosition* hint,
                   double most_beside_m) {
  Placement placement;
  placement.pose = pose;
  const auto found = road::locate(network, Vec2(pose.position_m), hint);
  if (!found || found->lanes.outside_m > most_beside_m) return placement;
  const int lane = found->lanes.lane != 0 ? found->lanes.lane : found->lanes.lane_any_type;
  if (lane == 0) return placement;
  placement.on_road = true;
  const auto& at = found->position;
  const auto& on = network.roads[at.road];
  const double centre_t = road::lane_borders(on, road::section_at(on, at.s_m), lane, at.s_m).centre_t_m();
  placement.lane = {at.road, lane, at.s_m, at.t_m - centre_t};
  const double turn = road::wrap_angle(heading_rad(pose.orientation) - road::evaluate(network, at).heading_rad);
  placement.along_s = std::abs(turn) <= pi / 2.0;
  placement.heading_offset_rad = placement.along_s ? turn : road::wrap_angle(turn - pi);
  return placement;
}

namespace {

/// Place on a lane, with an orientation relative to its direction of travel or to the world.
std::optional<Placement> place_on_lane(const road::RoadNetwork& network, const road::LanePosition& lane,
                                       const Orientation& orientation) {
  const auto& section = road::section_at(network.roads[lane.road], lane.s_m);
  if (lane.lane == 0 || !section.has_lane(lane.lane)) return std::nullopt;
  Placement placement;
  placement.on_road = true;
  placement.lane = lane;
  const road::LanePoint point = road::evaluate_lane(network, lane);
  const double heading =
      orientation.relative ? point.driving_heading_rad + orientation.heading_rad : orientation.heading_rad;
  const double turn = road::wrap_angle(heading - point.road.heading_rad);
  placement.along_s = std::abs(turn) <= pi / 2.0;
  if (orientation.relative && orientation.heading_rad == 0.0) placement.along_s = road::runs_along_s(network, lane);
  const double lane_heading = placement.along_s == road::runs_along_s(network, lane) ? point.driving_heading_rad
                                                                                     : point.driving_heading_rad + pi;
  placement.heading_offset_rad = road::wrap_angle(heading - lane_heading);
  placement.pose = lane_pose(network, lane, placement.along_s, 0.0, placement.heading_offset_rad);
  return placement;
}

std::optional<Placement> place_on_road(const road::RoadNetwork& network, road::RoadIndex index, double s_m, double t_m,
                                       const Orientation& orientation) {
  const auto& on = network.roads[index];
  const double s = std::clamp(s_m, 0.0, on.length_m);
  const road::LanesAt lanes = road::lanes_at(on, s, t_m);
  const int lane = lanes.lane_any_type != 0 ? lanes.lane_any_type : lanes.lane;
  if (lane == 0) return std::nullopt;
  const double centre_t = road::lane_borders(on, road::section_at(on, s), lane, s).centre_t_m();
  // Road positions face along the road, not along the lane.
  Orientation facing = orientation;
  const road::LanePosition at{index, lane, s, t_m - centre_t};
  if (facing.relative && !road::runs_along_s(network, at)) facing.heading_rad += pi;
  return place_on_lane(network, at, facing);
}

const EntityState* reference_of(const ScenarioState& state, EntityIndex entity) {
  if (entity >= state.entities.size() || !state.entities[entity].active) return nullptr;
  return &state.entities[entity];
}

/// The waypoints that lie on a road.
std::vector<Waypoint> resolved(const road::RoadNetwork& network, const ScenarioState& state,
                               const std::vector<Position>& positions) {
  std::vector<Waypoint> waypoints;
  for (const Position& position : positions) {
    const auto placement = resolve_position(network, state, position);
    if (placement && placement->on_road) waypoints.push_back({placement->lane, placement->along_s});
  }
  return waypoints;
}

struct Resolve {
  const road::RoadNetwork& network;
  const ScenarioState& state;

  std::optional<Placement> operator()(std::monostate) const { return std::nullopt; }

  std::optional<Placement> operator()(const WorldPosition& position) const {
    RigidTransform pose{position.position_m,
                        orientation_from_angles(position.heading_rad, position.pitch_rad, position.roll_rad)};
    if (!position.height_m) {
      if (const auto surface = road::surface_at(network, Vec2(pose.position_m))) pose.position_m.z = surface->height_m;
    }
    return place_at(pose, network);
  }

  template <class Relative>
  std::optional<Placement> relative(const Relative& position, bool own_axes) const {
    const EntityState* reference = reference_of(state, position.entity);
    if (reference == nullptr) return std::nullopt;
    const RigidTransform& from = reference->world_from_entity;
    const Orientation& o = position.orientation;
    const Quat turn = orientation_from_angles(o.heading_rad, o.pitch_rad, o.roll_rad);
    RigidTransform pose{own_axes ? from * position.delta_m : from.position_m + position.delta_m,
                        o.relative ? from.orientation * turn : turn};
    if (const auto surface = road::surface_at(network, Vec2(pose.position_m)); surface && position.delta_m.z == 0.0) {
      pose.position_m.z = surface->height_m;
    }
    return place_at(pose, network);
  }
  std::optional<Placement> operator()(const RelativeWorldPosition& position) const { return relative(position, false); }
  std::optional<Placement> operator()(const RelativeObjectPosition& position) const { return relative(position, true); }

  std::optional<Placement> operator()(const RoadCoordinates& position) const {
    const auto index = road::find_road(network, position.road);
    if (!index || position.s_m > network.roads[*index].length_m + 1e-6) return std::nullopt;
    return place_on_road(network, *index, position.s_m, position.t_m, position.orientation);
  }

  std::optional<Placement> operator()(const RelativeRoadPosition& position) const {
    const EntityState* reference = reference_of(state, position.entity);
    if (reference == nullptr || !reference->on_road) return std::nullopt;
    const auto& lane = reference->lane;
    return place_on_road(network, lane.road, lane.s_m + position.ds_m, lateral_t_m(network, lane) + position.dt_m,
                         position.orientation);
  }

  std::optional<Placement> operator()(const LaneCoordinates& position) const {
    const auto index = road::find_road(network, position.road);
    if (!index || position.s_m > network.roads[*index].length_m + 1e-6) return std::nullopt;
    return place_on_lane(network, {*index, position.lane, position.s_m, position.offset_m}, position.orientation);
  }

  std::optional<Placement> operator()(const RelativeLanePosition& position) const {
    const EntityState* reference = reference_of(state, position.entity);
    if (reference == nullptr || !reference->on_road) return std::nullopt;
    road::LanePosition lane = reference->lane;
    lane.lane = lane_beside(lane_of(network, *reference), reference->along_s, position.lanes_to_the_left);
    lane.offset_m = position.offset_m;
    if (!road::section_at(network.roads[lane.road], lane.s_m).has_lane(lane.lane)) return std::nullopt;
    const double ahead = position.along_lane || reference->along_s ? position.ds_m : -position.ds_m;
    const Progress there = go_along(network, lane, reference->along_s, ahead);
    if (there.left_over_m != 0.0) return std::nullopt;
    return place_on_lane(network, there.lane, position.orientation);
  }

  std::optional<Placement> operator()(const RoutePosition& position) const {
    if (const EntityState* entity = reference_of(state, position.entity)) {
      Placement placement;
      placement.on_road = entity->on_road;
      placement.lane = entity->lane;
      placement.along_s = entity->along_s;
      placement.pose = entity->world_from_entity;
      return placement;
    }
    const auto planned = planned_route(*position.route);
    if (planned->waypoints.empty()) return std::nullopt;
    const Waypoint& first = planned->waypoints.front();
    Progress there = go_along(network, first.lane, first.along_s, position.path_s_m, planned->roads);
    if (there.left_over_m > 1e-6) return std::nullopt;
    if (position.t_m) {
      return place_on_road(network, there.lane.road, there.lane.s_m, *position.t_m, position.orientation);
    }
    there.lane.lane = position.lane.value_or(there.lane.lane);
    there.lane.offset_m = position.offset_m;
    return place_on_lane(network, there.lane, position.orientation);
  }

 private:
  std::shared_ptr<const PlannedRoute> planned_route(const Route& route) const {
    if (route.index < state.routes.size() && state.routes[route.index]) return state.routes[route.index];
    auto waypoints = resolved(network, state, route.waypoints);
    std::size_t lanes_left = most_lanes_of_route;
    auto roads = plan_route(network, waypoints, lanes_left);
    return std::make_shared<const PlannedRoute>(PlannedRoute{std::move(waypoints), std::move(roads)});
  }
};

}  // namespace

std::optional<Placement> resolve_position(const road::RoadNetwork& network, const ScenarioState& state,
                                          const Position& position) {
  return std::visit(Resolve{network, state}, position);
}

std::string why_nowhere(const Scenario& scenario, const road::RoadNetwork& network, const ScenarioState& state,
                        const Position& position) {
  const auto off_road = [&](const std::string& id, double s_m) -> std::string {
    const auto index = road::find_road(network, id);
    if (!index) return fmt::format("no road has the id \"{}\"", id);
    const double length_m = network.roads[*index].length_m;
    if (s_m <= length_m + 1e-6) return {};
    return fmt::format("s = {} m lies beyond road {}, which is {:.3f} m long", s_m, id, length_m);
  };
  if (const auto* lane = std::get_if<LaneCoordinates>(&position)) {
    if (std::string off = off_road(lane->road, lane->s_m); !off.empty()) return off;
    return fmt::format("road {} has no lane {} at s = {} m", lane->road, lane->lane, lane->s_m);
  }
  if (const auto* at = std::get_if<RoadCoordinates>(&position)) {
    if (std::string off = off_road(at->road, at->s_m); !off.empty()) return off;
    return fmt::format("no lane of road {} lies at s = {} m, t = {} m", at->road, at->s_m, at->t_m);
  }
  if (std::holds_alternative<std::monostate>(position)) return "this kind of position is not supported";
  if (std::holds_alternative<RoutePosition>(position)) return "the route does not lead so far, or to that lane";
  return std::visit(
      [&](const auto& relative) -> std::string {
        if constexpr (requires { relative.entity; }) {
          if (relative.entity == no_entity) return "it is relative to no entity";
          const std::string& name = scenario.entities[relative.entity].name;
          const bool placed = state.entities[relative.entity].active;
          return placed ? fmt::format("so far from {} there is no lane", name)
                        : fmt::format("it is relative to {}, which has no place itself", name);
        }
        return "there is no lane";
      },
      position);
}

double lateral_t_m(const road::RoadNetwork& network, const road::LanePosition& lane) {
  const auto& on = network.roads[lane.road];
  return road::lane_borders(on, road::section_at(on, lane.s_m), lane.lane, lane.s_m).centre_t_m() + lane.offset_m;
}

int lane_of(const road::RoadNetwork& network, const EntityState& entity) {
  const int lane =
      road::lanes_at(network.roads[entity.lane.road], entity.lane.s_m, lateral_t_m(network, entity.lane)).lane_any_type;
  return lane != 0 ? lane : entity.lane.lane;
}

int lane_beside(int lane, bool along_s, int count) {
  const int step = along_s ? count : -count;
  const int beside = lane + step;
  if (step == 0 || ((lane > 0) == (beside > 0) && beside != 0)) return beside;
  return beside + (step > 0 ? 1 : -1);
}

RigidTransform lane_pose(const road::RoadNetwork& network, const road::LanePosition& lane, bool along_s, double slope,
                         double heading_offset_rad) {
  const road::LanePoint point = road::evaluate_lane(network, lane);
  const double facing = along_s == road::runs_along_s(network, lane) ? 0.0 : pi;
  RigidTransform pose = road::world_from_lane(point);
  pose.orientation = pose.orientation * glm::angleAxis(facing + std::atan(slope) + heading_offset_rad, Vec3(0, 0, 1));
  return pose;
}

Progress go_along(const road::RoadNetwork& network, const road::LanePosition& lane, bool along_s, double distance_m,
                  std::span<const road::RoadIndex> route) {
  if (distance_m == 0.0) return {lane, along_s, 0.0};
  distance_m = std::clamp(distance_m, -1e5, 1e5);  // Far enough for any road; never without end round a ring.
  const bool natural = along_s == road::runs_along_s(network, lane);
  const road::Advanced advanced =
      road::advance(network, lane, natural ? distance_m : -distance_m, choose_way(network, route));
  return {advanced.position, distance_m >= 0.0 ? advanced.towards_increasing_s : !advanced.towards_increasing_s,
          advanced.remaining_m};
}

std::vector<std::shared_ptr<const PlannedRoute>> plan_routes(const road::RoadNetwork& network,
                                                             const Scenario& scenario) {
  const ScenarioState nobody_anywhere;
  const auto is_named = [](const Position& position) {
    return std::holds_alternative<LaneCoordinates>(position) || std::holds_alternative<RoadCoordinates>(position) ||
           std::holds_alternative<WorldPosition>(position);
  };
  std::vector<std::shared_ptr<const PlannedRoute>> planned;
  std::size_t lanes_left = most_lanes_of_scenario;
  for (const auto& route : scenario.routes) {
    auto& added = planned.emplace_back();
    const auto& positions = route->waypoints;
    if (!std::all_of(positions.begin(), positions.end(), is_named)) continue;
    auto waypoints = resolved(network, nobody_anywhere, positions);
    auto roads = plan_route(network, waypoints, lanes_left);
    added = std::make_shared<const PlannedRoute>(PlannedRoute{std::move(waypoints), std::move(roads)});
  }
  return planned;
}

std::vector<road::RoadIndex> plan_from(const road::RoadNetwork& network, const ScenarioState& state,
                                       const EntityState& entity, const std::vector<Position>& positions) {
  std::vector<Waypoint> waypoints = resolved(network, state, positions);
  if (waypoints.empty() || !entity.on_road) return {};
  std::size_t lanes_left = most_lanes_of_route;
  auto roads = plan_route(network, waypoints, lanes_left);
  const bool on_it = std::find(roads.begin(), roads.end(), entity.lane.road) != roads.end();
  if (on_it && waypoints.size() > 1) return roads;
  waypoints.insert(waypoints.begin(), {entity.lane, entity.along_s});
  return plan_route(network, waypoints, lanes_left);
}

}  // namespace septet::scenario
