#include "engine/roadside/junction_corners.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "engine/road/lane_geometry.hpp"
#include "engine/road/road_locate.hpp"
#include "engine/roadside/lane_levels.hpp"

namespace septet::roadside {
namespace {

constexpr std::size_t points_of_corner = 13;
constexpr double least_pavement_m = 0.5, joined_m = 0.3, longest_m = 80.0, inside_pavement_m = 0.05;

/// Pavement on one side of a road's end.
struct Pavement {
  Vec3 kerb_m, edge_m;
};

/// End of a road at a junction.
struct Arm {
  road::RoadIndex road = 0;
  road::ContactPoint contact = road::ContactPoint::start;
  Vec2 middle_m{0.0}, inwards{1.0, 0.0};
  std::optional<Pavement> right, left;  ///< Sides as seen towards the junction.

  bool operator==(const road::RoadLink& link) const { return link.road == road && link.contact == contact; }
};

double station_of(const road::Road& road, road::ContactPoint contact) {
  return contact == road::ContactPoint::start ? 0.0 : road.length_m;
}

/// The pavement outside of all other lanes of a side; null where there is none.
std::optional<Pavement> pavement_of(const road::RoadNetwork& network, road::RoadIndex index, double s_m, int side) {
  const road::Road& road = network.roads[index];
  const road::LaneSection& section = road::section_at(road, s_m);
  const int count = side > 0 ? section.left_count : section.right_count;
  const double edge_t = road::outer_border_t_m(road, section, side * count, s_m);
  int innermost = count + 1;
  for (int n = count; n >= 1; --n) {
    if (is_walked(section.lane(side * n).type))
      innermost = n;
    else if (road::lane_borders(road, section, side * n, s_m).width_m() > 0.01)
      break;
  }
  if (innermost > count) return std::nullopt;
  const double kerb_t = road::outer_border_t_m(road, section, side * (innermost - 1), s_m);
  if (std::abs(edge_t - kerb_t) < least_pavement_m) return std::nullopt;
  const auto point = [&](double t_m, double inside_t_m) {
    const Vec3 on_lane = road::evaluate(network, {index, s_m, inside_t_m}).position_m;
    return Vec3(Vec2(road::evaluate(network, {index, s_m, t_m}).position_m), on_lane.z);
  };
  return Pavement{point(kerb_t, kerb_t + side * inside_pavement_m), point(edge_t, edge_t - side * inside_pavement_m)};
}

Arm arm_of(const road::RoadNetwork& network, road::RoadIndex index, road::ContactPoint contact) {
  const double s_m = station_of(network.roads[index], contact);
  const road::RoadPoint at = road::evaluate(network, {index, s_m, 0.0});
  const bool along = contact == road::ContactPoint::end;
  Arm arm{index, contact, Vec2(at.position_m), Vec2(std::cos(at.heading_rad), std::sin(at.heading_rad)), {}, {}};
  arm.right = pavement_of(network, index, s_m, along ? -1 : 1);
  arm.left = pavement_of(network, index, s_m, along ? 1 : -1);
  if (!along) arm.inwards = -arm.inwards;
  return arm;
}

/// Curve from a to b that leaves a along `from` and comes to b along `to`: about an arc where the two meet ahead, else
/// straight on as far as it can.
std::vector<Vec2> rounded(const Vec2& a, const Vec2& from, const Vec2& b, const Vec2& to) {
  const double sine = from.x * to.y - from.y * to.x;
  double handle_a = glm::distance(a, b) / 3.0, handle_b = handle_a;
  if (std::abs(sine) > 0.05) {
    const Vec2 way = b - a;
    const double ahead = (way.x * to.y - way.y * to.x) / sine, behind = (from.x * way.y - from.y * way.x) / sine;
    constexpr double of_an_arc = 0.5523;
    handle_a = of_an_arc * std::clamp(ahead, 0.0, longest_m);
    handle_b = of_an_arc * std::clamp(behind, 0.0, longest_m);
  }
  const Vec2 p = a + handle_a * from, q = b - handle_b * to;
  std::vector<Vec2> points;
  for (std::size_t i = 0; i < points_of_corner; ++i) {
    const double t = static_cast<double>(i) / (points_of_corner - 1), u = 1.0 - t;
    points.push_back(u * u * u * a + 3.0 * u * u * t * p + 3.0 * u * t * t * q + t * t * t * b);
  }
  return points;
}

/// Border of a connecting road's lanes that are driven on, from one arm to the other.
std::vector<Vec2> driven_border(const road::RoadNetwork& network, road::RoadIndex index, double side) {
  const road::Road& road = network.roads[index];
  std::vector<Vec2> points;
  for (std::size_t i = 0; i < points_of_corner; ++i) {
    const double s = road.length_m * static_cast<double>(i) / (points_of_corner - 1);
    const road::LaneSection& section = road::section_at(road, s);
    int outermost = 0;
    for (int n = 1; n <= (side > 0 ? section.left_count : section.right_count); ++n)
      if (const int lane = side > 0 ? n : -n; road::is_drivable(section.lane(lane).type)) outermost = lane;
    points.emplace_back(
        road::evaluate(network, {index, s, road::outer_border_t_m(road, section, outermost, s)}).position_m);
  }
  return points;
}

class CornerBuilder {
 public:
  explicit CornerBuilder(const road::RoadNetwork& network) : network_(network), inside_(network.junctions.size()) {
    for (road::RoadIndex index = 0; index < network.roads.size(); ++index)
      if (const road::JunctionIndex junction = network.roads[index].junction; junction != road::no_index)
        inside_[junction].push_back(index);
  }

  std::vector<JunctionCorner> made() {
    for (road::JunctionIndex junction = 0; junction < network_.junctions.size(); ++junction)
      if (network_.junctions[junction].kind == road::Junction::Kind::common) add(junction);
    return std::move(corners_);
  }

 private:
  /// Ends of roads at a junction, against the clock.
  std::vector<Arm> arms_of(road::JunctionIndex junction) const {
    std::vector<Arm> arms;
    for (const road::RoadIndex index : inside_[junction])
      for (const road::RoadLink& link : {network_.roads[index].predecessor, network_.roads[index].successor})
        if (link.road != road::no_index && std::ranges::none_of(arms, [&](const Arm& arm) { return arm == link; }))
          arms.push_back(arm_of(network_, link.road, link.contact));
    Vec2 middle(0.0);
    for (const Arm& arm : arms) middle += arm.middle_m / static_cast<double>(arms.size());
    std::ranges::sort(arms, {}, [&](const Arm& arm) {
      const Vec2 out = arm.middle_m - middle;
      return std::atan2(out.y, out.x);
    });
    return arms;
  }

  void add(road::JunctionIndex junction) {
    const std::vector<Arm> arms = arms_of(junction);
    if (arms.size() < 2) return;
    for (std::size_t i = 0; i < arms.size(); ++i) {
      const Arm &arm = arms[i], &next = arms[(i + 1) % arms.size()];
      if (arm.right && next.left) add(junction, arm, next);
    }
  }

  void add(road::JunctionIndex junction, const Arm& arm, const Arm& next) {
    const Pavement &from = *arm.right, &to = *next.left;
    if (glm::distance(Vec2(from.kerb_m), Vec2(to.kerb_m)) > longest_m) return;
    const std::vector<Vec2> kerb = kerb_of(junction, arm, next);
    const std::vector<Vec2> edge = rounded(Vec2(from.edge_m), arm.inwards, Vec2(to.edge_m), -next.inwards);
    JunctionCorner corner{arm.road, station_of(network_.roads[arm.road], arm.contact), {}, {}};
    for (std::size_t i = 0; i < points_of_corner; ++i) {
      const double share = static_cast<double>(i) / (points_of_corner - 1);
      const double z = glm::mix(from.kerb_m.z, to.kerb_m.z, share);
      corner.kerb_m.emplace_back(kerb[i], z);
      corner.edge_m.emplace_back(edge[i], glm::mix(from.edge_m.z, to.edge_m.z, share));
    }
    if (is_clear(corner)) corners_.push_back(std::move(corner));
  }

  /// The kerb from the arm's right side to the left one of the next.
  std::vector<Vec2> kerb_of(road::JunctionIndex junction, const Arm& arm, const Arm& next) const {
    const Vec2 begin(arm.right->kerb_m), end(next.left->kerb_m);
    for (const road::RoadIndex index : inside_[junction]) {
      const road::Road& road = network_.roads[index];
      const bool there = arm == road.predecessor && next == road.successor,
                 back = arm == road.successor && next == road.predecessor;
      if (!there && !back) continue;
      std::vector<Vec2> border = driven_border(network_, index, there ? -1.0 : 1.0);
      if (back) std::ranges::reverse(border);
      if (glm::distance(border.front(), begin) < joined_m && glm::distance(border.back(), end) < joined_m) {
        border.front() = begin;
        border.back() = end;
        return border;
      }
    }
    return rounded(begin, arm.inwards, end, -next.inwards);
  }

  /// True if no lane that is driven on lies under the pavement.
  bool is_clear(const JunctionCorner& corner) const {
    constexpr double beside_kerb = 0.1;
    for (std::size_t i = 0; i < points_of_corner; ++i)
      for (const double share : {beside_kerb, 0.5, 1.0}) {
        const Vec3 p = glm::mix(corner.kerb_m[i], corner.edge_m[i], share);
        for (const road::Location& location : road::roads_holding(network_, Vec2(p))) {
          const road::RoadPosition& at = location.position;
          if (road::is_drivable(road::lane_type(network_, at.road, location.lanes.lane_any_type, at.s_m)) &&
              std::abs(road::evaluate(network_, at).position_m.z - p.z) < 1.0)
            return false;
        }
      }
    return true;
  }

  const road::RoadNetwork& network_;
  std::vector<std::vector<road::RoadIndex>> inside_;  ///< Connecting roads of each junction.
  std::vector<JunctionCorner> corners_;
};

}  // namespace

std::vector<JunctionCorner> junction_corners(const road::RoadNetwork& network) { return CornerBuilder(network).made(); }

}  // namespace septet::roadside
