#include "engine/scenario/run/entity_distance.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace septet::scenario {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr std::size_t most_roads = 100;

std::array<Vec2, 4> corners(const RigidTransform& pose, const BoundingBox& box) {
  std::array<Vec2, 4> result;
  const double y = box.width_m / 2.0;
  const std::array<Vec2, 4> local{{{box.front_m(), box.centre_m.y + y},
                                   {box.rear_m(), box.centre_m.y + y},
                                   {box.rear_m(), box.centre_m.y - y},
                                   {box.front_m(), box.centre_m.y - y}}};
  for (std::size_t i = 0; i < 4; ++i) result[i] = Vec2(pose * Vec3(local[i], 0.0));
  return result;
}

double point_to_segment_m(const Vec2& point, const Vec2& a, const Vec2& b) {
  const Vec2 along = b - a;
  const double length2 = glm::dot(along, along);
  const double part = length2 > 0.0 ? std::clamp(glm::dot(point - a, along) / length2, 0.0, 1.0) : 0.0;
  return glm::length(point - a - part * along);
}

/// True where the point lies inside; a box without an interior, such as a point, contains nothing.
bool contains(const std::array<Vec2, 4>& box, const Vec2& point) {
  for (std::size_t i = 0; i < 4; ++i) {
    const Vec2 edge = box[(i + 1) % 4] - box[i], to = point - box[i];
    if (edge.x * to.y - edge.y * to.x <= 0.0) return false;
  }
  return true;
}

/// True where two sides cross, each at a point within the other.
bool cross(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
  const auto side = [](const Vec2& from, const Vec2& to, const Vec2& point) {
    const Vec2 along = to - from, at = point - from;
    return along.x * at.y - along.y * at.x;
  };
  return side(a, b, c) * side(a, b, d) < 0.0 && side(c, d, a) * side(c, d, b) < 0.0;
}

/// Convex boxes that do not meet are nearest at a corner of one of them; those that do hold a corner, or their sides
/// cross.
double box_distance_m(const std::array<Vec2, 4>& a, const std::array<Vec2, 4>& b) {
  double least = infinite;
  for (std::size_t i = 0; i < 4; ++i) {
    if (contains(a, b[i]) || contains(b, a[i])) return 0.0;
    for (std::size_t k = 0; k < 4; ++k) {
      if (cross(a[i], a[(i + 1) % 4], b[k], b[(k + 1) % 4])) return 0.0;
      least = std::min(
          {least, point_to_segment_m(a[i], b[k], b[(k + 1) % 4]), point_to_segment_m(b[i], a[k], a[(k + 1) % 4])});
    }
  }
  return least;
}

/// Distance between two intervals; 0 where they overlap.
double interval_gap_m(double low_a, double high_a, double low_b, double high_b) {
  return std::max({low_b - high_a, low_a - high_b, 0.0});
}

/// Extent of an object along an axis through `origin`; an object without a box is a point.
std::pair<double, double> extent_m(const RigidTransform& pose, const BoundingBox* box, const Vec3& origin,
                                   const Vec3& axis) {
  if (box == nullptr) {
    const double at = glm::dot(pose.position_m - origin, axis);
    return {at, at};
  }
  double low = infinite, high = -infinite;
  for (const double x : {box->front_m(), box->rear_m()}) {
    for (const double side : {-0.5, 0.5}) {
      const Vec3 corner = pose * Vec3(x, box->centre_m.y + side * box->width_m, 0.0);
      const double at = glm::dot(corner - origin, axis);
      low = std::min(low, at);
      high = std::max(high, at);
    }
  }
  return {low, high};
}

double along_axis_m(const Entity& entity, const EntityState& from, const Target& target, const Vec3& axis,
                    bool freespace) {
  const Vec3& origin = from.world_from_entity.position_m;
  const auto own = extent_m(from.world_from_entity, freespace ? &entity.box : nullptr, origin, axis);
  const auto its = extent_m(target.placement.pose, freespace ? target.box : nullptr, origin, axis);
  return interval_gap_m(own.first, own.second, its.first, its.second);
}

double along_road_m(const road::RoadNetwork& network, const Entity& entity, const EntityState& from,
                    const Target& target, const DistanceMeasure& measure) {
  if (!from.on_road || !target.placement.on_road) return infinite;
  const auto& to = target.placement.lane;
  if (measure.type == DistanceType::lateral) {
    const bool lane = measure.system == CoordinateSystem::lane;
    const double apart =
        lane ? to.offset_m - from.lane.offset_m : lateral_t_m(network, to) - lateral_t_m(network, from.lane);
    const double widths = 0.5 * (entity.box.width_m + (target.box != nullptr ? target.box->width_m : 0.0));
    return measure.freespace ? std::max(0.0, std::abs(apart) - widths) : std::abs(apart);
  }
  const bool along_lanes = measure.system == CoordinateSystem::lane;
  const double ahead = road_distance_m(network, from.lane, from.along_s, to, along_lanes);
  if (!measure.freespace) return std::abs(ahead);
  const double low = ahead + (target.box != nullptr ? target.box->rear_m() : 0.0);
  const double high = ahead + (target.box != nullptr ? target.box->front_m() : 0.0);
  return interval_gap_m(entity.box.rear_m(), entity.box.front_m(), low, high);
}

struct Reached {
  road::RoadIndex road;
  road::ContactPoint entered;
  double way_m;
};

/// The roads that begin where this one ends (or begins).
void add_linked(const road::RoadNetwork& network, road::RoadIndex index, road::ContactPoint leaving, double way_m,
                std::vector<Reached>& found) {
  const auto add = [&](road::RoadIndex to, road::ContactPoint contact) {
    const auto same = [&](const Reached& r) { return r.road == to; };
    if (found.size() < most_roads && std::none_of(found.begin(), found.end(), same))
      found.push_back({to, contact, way_m});
  };
  const road::RoadLink& link =
      leaving == road::ContactPoint::end ? network.roads[index].successor : network.roads[index].predecessor;
  if (link.road != road::no_index) add(link.road, link.contact);
  if (link.junction == road::no_index) return;
  for (const auto& connection : network.junctions[link.junction].connections) {
    if (connection.incoming == index) add(connection.connecting, connection.contact);
  }
}

/// Distance between two stations of a road, never negative.
double part_m(const road::RoadNetwork& network, const road::LanePosition& from, double to_s_m, bool along_lanes) {
  return std::abs(along_lanes ? road::length_along_lane_m(network, from, to_s_m) : to_s_m - from.s_m);
}

/// Path length from one end of a road to a position on another.
double way_from_end_m(const road::RoadNetwork& network, road::RoadIndex index, road::ContactPoint leaving,
                      double to_end_m, const road::LanePosition& to, bool along_lanes) {
  std::vector<Reached> reached;
  add_linked(network, index, leaving, to_end_m, reached);
  double least = infinite;
  for (std::size_t i = 0; i < reached.size(); ++i) {
    const Reached at = reached[i];
    const double length = network.roads[at.road].length_m;
    const bool from_start = at.entered == road::ContactPoint::start;
    if (at.road == to.road) {
      least = std::min(least, at.way_m + part_m(network, to, from_start ? 0.0 : length, along_lanes));
      continue;
    }
    add_linked(network, at.road, from_start ? road::ContactPoint::end : road::ContactPoint::start, at.way_m + length,
               reached);
  }
  return least;
}

}  // namespace

double road_distance_m(const road::RoadNetwork& network, const road::LanePosition& from, bool along_s,
                       const road::LanePosition& to, bool along_lanes) {
  double ahead = infinite, behind = infinite;
  const double length = network.roads[from.road].length_m;
  if (from.road == to.road) {
    const double ds = along_s ? to.s_m - from.s_m : from.s_m - to.s_m;
    (ds >= 0.0 ? ahead : behind) = part_m(network, from, to.s_m, along_lanes);
  }
  // On the same road the path round a ring may be the shorter one.
  if (from.road != to.road || network.roads[from.road].successor.road == from.road) {
    const double to_end = way_from_end_m(network, from.road, road::ContactPoint::end,
                                         part_m(network, from, length, along_lanes), to, along_lanes);
    const double to_start = way_from_end_m(network, from.road, road::ContactPoint::start,
                                           part_m(network, from, 0.0, along_lanes), to, along_lanes);
    ahead = std::min(ahead, along_s ? to_end : to_start);
    behind = std::min(behind, along_s ? to_start : to_end);
  }
  return ahead <= behind ? ahead : -behind;
}

double distance_m(const road::RoadNetwork& network, const Entity& entity, const EntityState& from, const Target& target,
                  const DistanceMeasure& measure) {
  const Vec3 apart = target.placement.pose.position_m - from.world_from_entity.position_m;
  if (measure.type == DistanceType::euclidean) {
    if (!measure.freespace) return glm::length(apart);
    const auto own = corners(from.world_from_entity, entity.box);
    if (target.box != nullptr) return box_distance_m(own, corners(target.placement.pose, *target.box));
    std::array<Vec2, 4> point;
    point.fill(Vec2(target.placement.pose.position_m));
    return box_distance_m(own, point);
  }
  const bool lateral = measure.type == DistanceType::lateral;
  const Vec3 axis = lateral ? Vec3(0.0, 1.0, 0.0) : Vec3(1.0, 0.0, 0.0);
  switch (measure.system) {
    case CoordinateSystem::entity:
      return along_axis_m(entity, from, target, from.world_from_entity.orientation * axis, measure.freespace);
    case CoordinateSystem::world:
      return along_axis_m(entity, from, target, axis, measure.freespace);
    case CoordinateSystem::lane:
    case CoordinateSystem::road:
      return along_road_m(network, entity, from, target, measure);
  }
  return infinite;
}

double closing_speed_mps(const EntityState& from, const Placement& target, const Vec3& target_velocity_mps,
                         const DistanceMeasure& measure) {
  const Vec3 apart = target.pose.position_m - from.world_from_entity.position_m;
  Vec3 direction = apart;
  if (measure.type != DistanceType::euclidean) {
    const Vec3 axis = measure.type == DistanceType::lateral ? Vec3(0, 1, 0) : Vec3(1, 0, 0);
    direction = from.world_from_entity.orientation * axis;
    if (glm::dot(direction, apart) < 0.0) direction = -direction;
  }
  const double length = glm::length(direction);
  if (length <= 0.0) return 0.0;
  return glm::dot(from.velocity_mps - target_velocity_mps, direction / length);
}

}  // namespace septet::scenario
