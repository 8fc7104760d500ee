#include "engine/simulation/ground_faces.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include <glm/geometric.hpp>

#include "engine/road/road_locate.hpp"
#include "engine/roadside/ground_beside.hpp"
#include "engine/simulation/wheel_ground.hpp"

namespace septet::simulation {
namespace {

/// Run number of all faces: the hull's impact with them is one. Listed obstacles never have such a number.
constexpr std::uint32_t face_run = 0x7fff'fff0u;
/// The hull passes over lower faces (hull.cpp) and the wheels climb them.
constexpr double least_face_m = 0.22;
/// A rise beyond that to a road that is not joined is overhead.
constexpr double highest_strange_m = 3.5;
constexpr double farthest_foot_m = 8.0;  ///< A wheel found farther away stands on land, far from roads.
constexpr double stretch_half_m = 0.6;   ///< Two corners' stretches never overlap.

bool links_to(const road::RoadLink& link, road::RoadIndex other, const road::RoadNetwork& roads) {
  return link.road == other || (link.junction != road::no_index && roads.roads[other].junction == link.junction);
}

/// True where one can come from one road to the other at once.
bool are_joined(const road::RoadNetwork& roads, road::RoadIndex a, road::RoadIndex b) {
  if (a == b) return true;
  const road::Road &one = roads.roads[a], &other = roads.roads[b];
  return links_to(one.predecessor, b, roads) || links_to(one.successor, b, roads) ||
         links_to(other.predecessor, a, roads) || links_to(other.successor, a, roads) ||
         (one.junction != road::no_index && one.junction == other.junction);
}

bool differs(const road::CubicProfile& profile, double from_s_m, double to_s_m) {
  return profile.size() > 1 && road::record_at(profile, from_s_m) != road::record_at(profile, to_s_m);
}

/// Road or land, where a road is near.
std::optional<road::SurfacePoint> ground_at(const Model& model, const Vec2& p, const road::RoadPosition& hint) {
  const double level_m = road::evaluate(model.roads, hint).position_m.z;
  auto surface = road::surface_at(model.roads, p, &hint, surface_reach_m, level_m);
  if (!surface || !model.obstacles || surface->outside_m <= 0.0) return surface;
  const auto land = roadside::ground_beside(model.roads, model.obstacles->terrain(), p, &surface->position, level_m);
  surface->height_m = land.height_m;
  surface->normal = land.normal;
  return surface;
}

double rise_over_m(const vehicle::WheelGround& floor, const Vec2& p, double height_m) {
  const Vec2 away = p - Vec2(floor.point_m);
  return height_m - (floor.point_m.z - glm::dot(Vec2(floor.normal), away) / floor.normal.z);
}

/// Rise of the ground over the plane on which a wheel stands.
class Rise {
 public:
  Rise(const Model& model, const road::RoadPosition& place, const vehicle::WheelGround& floor)
      : model_(model), place_(place), floor_(floor) {}

  double at(const Vec2& p) const {
    const auto surface = ground_at(model_, p, place_);
    if (!surface) return 0.0;
    const double rise_m = rise_over_m(floor_, p, surface->height_m);
    return rise_m > highest_strange_m && !are_joined(model_.roads, place_.road, surface->position.road) ? 0.0 : rise_m;
  }

 private:
  const Model& model_;
  const road::RoadPosition& place_;
  const vehicle::WheelGround& floor_;
};

struct Edge {
  Vec2 place_m;
  double height_m;
};

/// Place of the step on the path from a low place to a high one.
std::optional<Edge> edge_between(const Rise& rise, Vec2 low_m, Vec2 high_m) {
  double low_rise_m = rise.at(low_m), high_rise_m = rise.at(high_m);
  if (low_rise_m >= least_face_m || high_rise_m < least_face_m) return std::nullopt;
  for (int halving = 0; halving < 14; ++halving) {
    const Vec2 middle_m = 0.5 * (low_m + high_m);
    const double middle_rise_m = rise.at(middle_m);
    const bool low = middle_rise_m < least_face_m;
    (low ? low_m : high_m) = middle_m;
    (low ? low_rise_m : high_rise_m) = middle_rise_m;
  }
  if (high_rise_m - low_rise_m < least_face_m - 0.02) return std::nullopt;  // A ramp.
  return Edge{high_m, high_rise_m};
}

/// The plane of the ground at a place on or beside a road, under a point in plan.
vehicle::WheelGround plane_at(const Model& model, const road::RoadPosition& place, const Vec2& under_m) {
  vehicle::WheelGround wheel;
  const Vec3 point_m = road::evaluate(model.roads, place).position_m;
  wheel.point_m = Vec3(under_m, point_m.z);
  const auto ground = ground_at(model, Vec2(point_m), place);
  if (!ground) return wheel;
  wheel.normal = ground->normal;
  wheel.point_m.z = ground->height_m - glm::dot(Vec2(wheel.normal), under_m - Vec2(point_m)) / wheel.normal.z;
  return wheel;
}

/// The nearest place around a point where the ground continues from `floor`: a wheel that slides along a face takes its
/// ground along.
std::optional<road::RoadPosition> nearest_before_face(const Model& model, const Vec2& p,
                                                      const road::RoadPosition& stood,
                                                      const vehicle::WheelGround& floor) {
  constexpr int ways = 8;
  for (const double away_m : {0.1, 0.2, 0.4, 0.8, 1.6})
    for (int way = 0; way < ways; ++way) {
      const double angle_rad = 2.0 * std::numbers::pi * way / ways;
      const Vec2 there = p + away_m * Vec2(std::cos(angle_rad), std::sin(angle_rad));
      const auto ground = ground_at(model, there, stood);
      if (ground && rise_over_m(floor, there, ground->height_m) < least_face_m) return ground->position;
    }
  return std::nullopt;
}

}  // namespace

bool may_step(const road::Road& road, double s_m, double reach_m) {
  if (!road.flat || s_m < reach_m || s_m > road.length_m - reach_m) return true;
  const double from = s_m - reach_m, to = s_m + reach_m;
  return differs(road.elevation, from, to) || differs(road.superelevation, from, to);
}

bool stays_before_face(const Model& model, const Vec3& centre_m, const road::RoadPosition& stood,
                       road::RoadPosition& place, vehicle::WheelGround& ground) {
  constexpr double least_over_m = 0.05;  // As chassis.cpp tells edges from walls.
  if (centre_m.z - ground.point_m.z > least_over_m) return false;
  const Vec2 foot_m(road::evaluate(model.roads, stood).position_m);
  // A plane that continues farther is no ground; the chassis is lifted out of this one.
  constexpr double farthest_m = 3.0;
  if (glm::distance(foot_m, Vec2(centre_m)) > farthest_m) return false;
  vehicle::WheelGround before = plane_at(model, stood, Vec2(centre_m));
  const double risen_m = ground.point_m.z - before.point_m.z;
  if (risen_m < least_face_m) return false;
  // The ground turns where a bank meets level land, and does not step.
  if (risen_m < highest_strange_m && !edge_between(Rise(model, stood, before), foot_m, Vec2(centre_m))) return false;
  place = stood;
  if (const auto nearer = nearest_before_face(model, Vec2(centre_m), stood, before)) {
    place = *nearer;
    before = plane_at(model, place, Vec2(centre_m));
  }
  ground.point_m = before.point_m;
  ground.normal = before.normal;
  return true;
}

void take_faces_away(const vehicle::HullState& hull, double wheel_radius_m, vehicle::WheelGround& ground) {
  if (std::ranges::find(hull.touches, face_run, &vehicle::HullTouch::run) == hull.touches.end()) return;
  for (auto& edge : ground.edges)
    if (edge && edge->point_m.z - ground.point_m.z > wheel_radius_m) edge.reset();
}

void append_faces(const Model& model, const State& state, const vehicle::Ground& ground,
                  std::vector<Obstacle>& obstacles) {
  if (!state.car_road) return;
  const vehicle::BodyParameters& body = model.car.body;
  const double front_m = body.length_m - body.rear_overhang_m - body.mass_centre_x_m,
               rear_m = -body.rear_overhang_m - body.mass_centre_x_m;
  const Vec2 middle_m(state.car.world_from_body.position_m);
  for (std::size_t i = 0; i < ground.size(); ++i) {
    const road::RoadPosition& place = state.wheel_roads[i];
    const Vec3 arm = state.car.world_from_body.orientation *
                     Vec3(i < 2 ? front_m : rear_m, (i % 2 == 0 ? 0.5 : -0.5) * body.width_m, 0.0);
    const Vec2 corner_m = middle_m + Vec2(arm);
    const Vec3 turning = glm::cross(state.car.world_from_body.orientation * state.car.angular_velocity_radps, arm);
    const Vec2 velocity_mps = Vec2(state.car.velocity_mps) + Vec2(turning);
    const Vec2 foot_m(road::evaluate(model.roads, place).position_m);
    const Vec2 way_m = corner_m + tick_s * velocity_mps - foot_m;
    const double reach_m = glm::length(way_m);
    if (reach_m < 0.1 || reach_m > farthest_foot_m) continue;
    if (!may_step(model.roads.roads[place.road], place.s_m, reach_m + 0.5)) continue;
    const Vec2 outwards = way_m / reach_m;
    const double look_m = reach_m + 0.05;
    const Rise rise(model, place, ground[i]);
    const auto edge = edge_between(rise, foot_m, foot_m + look_m * outwards);
    if (!edge) continue;
    // Direction of the face, from a second path on either side of the first: one of them may begin beyond the face.
    const Vec2 left(-outwards.y, outwards.x);
    Vec2 along = left;
    for (const double side : {1.0, -1.0}) {
      const Vec2 beside_m = foot_m + 0.2 * side * left;
      const auto other = edge_between(rise, beside_m, beside_m + (look_m + 0.6) * outwards);
      if (!other || glm::distance(other->place_m, edge->place_m) < 0.05) continue;
      along = side * glm::normalize(other->place_m - edge->place_m);
      break;
    }
    const Vec2 normal(-along.y, along.x);
    const bool touches =
        std::ranges::any_of(state.hull.touches, [&](const vehicle::HullTouch& touch) { return touch.run == face_run; });
    if (glm::dot(velocity_mps, normal) >= 0.0 && !touches) continue;  // A car that drives off a face does not meet it.
    // Beside the corner, which on a slanted path enters elsewhere than the path crosses the face.
    const Vec2 beside_corner_m = edge->place_m + glm::dot(corner_m - edge->place_m, along) * along;
    const double floor_z_m = ground[i].point_m.z;
    obstacles.push_back({.kind = ObstacleKind::ground_face,
                         .run = face_run,
                         .from_m = beside_corner_m - stretch_half_m * along,
                         .to_m = beside_corner_m + stretch_half_m * along,
                         .radius_m = 0.0,
                         .low_m = floor_z_m - 1.0,
                         .high_m = floor_z_m + edge->height_m,
                         .open_from = false,
                         .open_to = false,
                         .friction = 0.45});  // Friction of concrete.
  }
}

}  // namespace septet::simulation
