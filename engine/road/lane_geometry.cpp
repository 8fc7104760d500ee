#include "engine/road/lane_geometry.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "engine/core/check.hpp"

namespace septet::road {
namespace {

struct Border {
  double t_m = 0.0;
  double slope = 0.0;
};

Border next_border(const Lane& lane, const Border& inner, double s_m) {
  const double side = lane.id > 0 ? 1.0 : -1.0;
  if (!lane.widths.empty()) {
    const CubicRecord& width = lane.widths[record_at(lane.widths, s_m)];
    const double value = width.value(s_m);
    // At exactly 0 the lane begins or ends, and its border already runs off.
    if (value < 0.0) return inner;
    return {inner.t_m + side * value, inner.slope + side * width.slope(s_m)};
  }
  if (lane.borders.empty()) return inner;
  const CubicRecord& border = lane.borders[record_at(lane.borders, s_m)];
  const double value = border.value(s_m), sign = value < 0.0 ? -1.0 : 1.0;
  const double t = side * sign * value;
  if (side * (t - inner.t_m) <= 0.0) return inner;
  return {t, side * sign * border.slope(s_m)};
}

Border centre_border(const Road& road, double s_m) {
  if (road.lane_offset.empty()) return {};
  const CubicRecord& offset = road.lane_offset[record_at(road.lane_offset, s_m)];
  return {offset.value(s_m), offset.slope(s_m)};
}

/// Walks one side outwards from the centre line while visit(lane, inner, outer) returns true.
template <class Visit>
void visit_lanes(const Road& road, const LaneSection& section, double s_m, int side, Visit visit) {
  const int count = side > 0 ? section.left_count : section.right_count;
  Border inner = centre_border(road, s_m);
  for (int i = 1; i <= count; ++i) {
    const Lane& lane = section.lane(side * i);
    const Border outer = next_border(lane, inner, s_m);
    if (!visit(lane, inner, outer)) return;
    inner = outer;
  }
}

double lane_height_m(const Road& road, double s_m, double t_m) {
  const LaneSection& section = section_at(road, s_m);
  double height = 0.0;
  const int side = t_m > centre_border(road, s_m).t_m ? 1 : -1;
  visit_lanes(road, section, s_m, side, [&](const Lane& lane, const Border& inner, const Border& outer) {
    const double width = std::abs(outer.t_m - inner.t_m);
    const double inside = side * (t_m - inner.t_m);
    if (inside > width && std::abs(lane.id) < (side > 0 ? section.left_count : section.right_count)) return true;
    if (lane.heights.empty() || width <= 0.0 || s_m < lane.heights.front().s_m) return false;
    const LaneHeight& record = lane.heights[record_at(lane.heights, s_m)];
    height = record.inner_m + (record.outer_m - record.inner_m) * std::clamp(inside / width, 0.0, 1.0);
    return false;
  });
  return height;
}

/// Height of the profile at this station: the cubics of equal s, in the order of t.
double shape_profile_m(const std::vector<LateralShape>& shapes, double profile_s_m, double t_m) {
  const auto first = std::ranges::lower_bound(shapes, profile_s_m, {}, &LateralShape::s_m);
  const auto end = std::ranges::upper_bound(first, shapes.end(), profile_s_m, {}, &LateralShape::s_m);
  const auto next = std::ranges::upper_bound(first, end, t_m, {}, &LateralShape::t_m);
  const LateralShape& shape = next == first ? *first : *std::prev(next);
  const double dt = t_m - shape.t_m;
  return shape.a + dt * (shape.b + dt * (shape.c + dt * shape.d));
}

/// Linear between the profiles before and after s.
double shape_height_m(const std::vector<LateralShape>& shapes, double s_m, double t_m) {
  const auto after = std::ranges::upper_bound(shapes, s_m, {}, &LateralShape::s_m);
  if (after == shapes.begin()) return shape_profile_m(shapes, after->s_m, t_m);
  const double before_s_m = std::prev(after)->s_m;
  const double low = shape_profile_m(shapes, before_s_m, t_m);
  if (after == shapes.end()) return low;
  const double high = shape_profile_m(shapes, after->s_m, t_m);
  return low + (high - low) * (s_m - before_s_m) / (after->s_m - before_s_m);
}

}  // namespace

std::size_t section_index_at(const Road& road, double s_m) {
  SEPTET_CHECK(!road.sections.empty(), "road {} has no lane section", road.id);
  return record_at(road.sections, s_m);
}

LaneBorders lane_borders(const Road& road, const LaneSection& section, int lane, double s_m) {
  LaneBorders borders;
  borders.inner_t_m = borders.outer_t_m = centre_border(road, s_m).t_m;
  borders.inner_slope = borders.outer_slope = centre_border(road, s_m).slope;
  if (lane == 0) return borders;
  visit_lanes(road, section, s_m, lane > 0 ? 1 : -1, [&](const Lane& at, const Border& inner, const Border& outer) {
    borders = {inner.t_m, outer.t_m, inner.slope, outer.slope};
    return at.id != lane;
  });
  return borders;
}

double outer_border_t_m(const Road& road, const LaneSection& section, int lane, double s_m) {
  return lane_borders(road, section, lane, s_m).outer_t_m;
}

double lane_width_m(const RoadNetwork& network, RoadIndex road_index, int lane, double s_m) {
  const Road& road = network.roads[road_index];
  const LaneSection& section = section_at(road, s_m);
  return section.has_lane(lane) ? lane_borders(road, section, lane, s_m).width_m() : 0.0;
}

LaneType lane_type(const RoadNetwork& network, RoadIndex road_index, int lane, double s_m) {
  const LaneSection& section = section_at(network.roads[road_index], s_m);
  return section.has_lane(lane) ? section.lane(lane).type : LaneType::none;
}

double surface_offset_m(const Road& road, double s_m, double t_m) {
  if (road.flat) return 0.0;
  double height = lane_height_m(road, s_m, t_m);
  if (!road.shapes.empty()) height += shape_height_m(road.shapes, s_m, t_m);
  const CubicProfile& crossfall = t_m > 0.0 ? road.crossfall_left : road.crossfall_right;
  if (!crossfall.empty()) height -= std::abs(t_m) * std::tan(value_at(crossfall, s_m));
  return height;
}

RoadExtent road_extent(const Road& road, double s_m) {
  const LaneSection& section = section_at(road, s_m);
  return {outer_border_t_m(road, section, -section.right_count, s_m),
          outer_border_t_m(road, section, section.left_count, s_m)};
}

LanesAt lanes_at(const Road& road, double s_m, double t_m) {
  const LaneSection& section = section_at(road, s_m);
  LanesAt found;
  double nearest_drivable = 1e300, nearest_any = 1e300;
  found.outside_m = 1e300;
  const double centre_t = centre_border(road, s_m).t_m;
  const int own_side = t_m > centre_t ? 1 : -1;
  for (const int side : {own_side, -own_side}) {
    visit_lanes(road, section, s_m, side, [&](const Lane& lane, const Border& inner, const Border& outer) {
      const double low = std::min(inner.t_m, outer.t_m), high = std::max(inner.t_m, outer.t_m);
      if (high <= low) return true;
      const double centre = 0.5 * (low + high);
      const double outside = std::max({low - t_m, t_m - high, 0.0});
      found.outside_m = std::min(found.outside_m, outside);
      // A lane that contains the point beats every other; among the rest the nearest centre wins.
      const double distance = outside == 0.0 ? -1.0 : std::abs(t_m - centre);
      if (distance < nearest_any) {
        nearest_any = distance;
        found.lane_any_type = lane.id;
      }
      if (is_drivable(lane.type) && distance < nearest_drivable) {
        nearest_drivable = distance;
        found.lane = lane.id;
        found.offset_m = t_m - centre;
      }
      return nearest_drivable >= 0.0;
    });
    if (nearest_drivable < 0.0) return found;
  }
  if (found.outside_m == 1e300) found.outside_m = std::abs(t_m - centre_t);
  return found;
}

double speed_limit_mps(const RoadNetwork& network, const LanePosition& position) {
  const Road& road = network.roads[position.road];
  const LaneSection& section = section_at(road, position.s_m);
  if (section.has_lane(position.lane)) {
    const auto& speeds = section.lane(position.lane).speeds;
    if (!speeds.empty() && speeds.front().s_m <= position.s_m) return speeds[record_at(speeds, position.s_m)].limit_mps;
  }
  return road.types.empty() ? 0.0 : road.types[record_at(road.types, position.s_m)].speed_limit_mps;
}

const RoadMark* road_mark_at(const RoadNetwork& network, RoadIndex road_index, int lane, double s_m) {
  const LaneSection& section = section_at(network.roads[road_index], s_m);
  if (!section.has_lane(lane)) return nullptr;
  const auto& marks = section.lane(lane).marks;
  if (marks.empty() || s_m < marks.front().s_m) return nullptr;
  return &marks[record_at(marks, s_m)];
}

const RoadStructure* structure_at(const Road& road, double s_m, RoadStructure::Kind kind) {
  for (const RoadStructure& structure : road.structures)
    if (structure.kind == kind && s_m >= structure.s_m && s_m <= structure.s_m + structure.length_m) return &structure;
  return nullptr;
}

}  // namespace septet::road
