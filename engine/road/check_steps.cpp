#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <pugixml.hpp>

#include "engine/road/cross_section.hpp"
#include "engine/road/lane_geometry.hpp"
#include "engine/road/rule_checks.hpp"

namespace septet::road {
namespace {

constexpr double least_step_m = 0.05;
constexpr double beside_m = 1e-6;     ///< Before and behind a station, within one record and the next.
constexpr double at_an_end_m = 1e-3;  ///< No vehicle meets a record so near to a road's end.

/// Causes of steps along a road, as elements of the file.
struct StepCause {
  const char* name;
  const char* profile;  ///< Child of the road.
  const char* record;   ///< Child of the profile.
};
constexpr StepCause elevation{"elevation", "elevationProfile", "elevation"};
constexpr StepCause superelevation{"superelevation", "lateralProfile", "superelevation"};
constexpr StepCause crossfall{"crossfall", "lateralProfile", "crossfall"};
constexpr StepCause lane_offset{"laneOffset", "lanes", "laneOffset"};

double world_z_m(const Road& road, double s_m, double t_m) {
  return cross_section_at(road, s_m).place(t_m, surface_offset_m(road, s_m, t_m)).z;
}

/// The element of the record that begins at a station, else the road's.
pugi::xml_node node_at(const pugi::xml_node& road_node, const StepCause& cause, double s_m) {
  for (const pugi::xml_node record : road_node.child(cause.profile).children(cause.record))
    if (std::abs(record.attribute("s").as_double() - s_m) < beside_m) return record;
  return road_node;
}

void add_stations(const CubicProfile& profile, std::vector<double>& stations) {
  for (const CubicRecord& record : profile) stations.push_back(record.s_m);
}

/// Ascending, each once, away from the road's ends: where a record of the surface begins.
std::vector<double> seams_of(const Road& road) {
  std::vector<double> stations;
  for (const CubicProfile* profile :
       {&road.elevation, &road.superelevation, &road.crossfall_left, &road.crossfall_right})
    add_stations(*profile, stations);
  for (const LaneSection& section : road.sections) {
    stations.push_back(section.s_m);
    for (const Lane& lane : section.lanes)
      if (is_drivable(lane.type))
        for (const LaneHeight& height : lane.heights) stations.push_back(height.s_m);
  }
  std::erase_if(stations, [&](double s) { return s < at_an_end_m || s > road.length_m - at_an_end_m; });
  std::ranges::sort(stations);
  // Not std::ranges::unique: clang 14 cannot compile it.
  stations.erase(
      std::unique(stations.begin(), stations.end(), [](double a, double b) { return b - a <= 2.0 * beside_m; }),
      stations.end());
  return stations;
}

double jump_of(const CubicProfile& profile, double s_m) {
  return value_at(profile, s_m + beside_m) - value_at(profile, s_m - beside_m);
}

struct Step {
  double height_m = 0.0, t_m = 0.0;
};

/// The highest step of a drivable lane at a station: at its borders and between them.
Step step_at(const Road& road, double s_m) {
  Step highest;
  const LaneSection& section = section_at(road, s_m + beside_m);
  for (const Lane& lane : section.lanes) {
    if (lane.id == 0 || !is_drivable(lane.type)) continue;
    const LaneBorders borders = lane_borders(road, section, lane.id, s_m + beside_m);
    if (borders.width_m() < 0.1) continue;
    for (const double share : {0.02, 0.5, 0.98}) {  // Just inside: on a border the neighbour may be the one.
      const double t = std::lerp(borders.inner_t_m, borders.outer_t_m, share);
      const LanesAt before = lanes_at(road, s_m - beside_m, t);
      if (before.outside_m > 0.0 || before.lane != before.lane_any_type) continue;  // Cars cannot come here.
      const double step = world_z_m(road, s_m + beside_m, t) - world_z_m(road, s_m - beside_m, t);
      if (std::abs(step) > std::abs(highest.height_m)) highest = {step, t};
    }
  }
  return highest;
}

/// The profile with the largest part of a step.
const StepCause* cause_of(const Road& road, double s_m, double t_m) {
  const double by_elevation = std::abs(jump_of(road.elevation, s_m)),
               by_roll = std::abs(t_m * jump_of(road.superelevation, s_m)),
               by_fall = std::abs(t_m * jump_of(t_m > 0.0 ? road.crossfall_left : road.crossfall_right, s_m));
  const double most = std::max({by_elevation, by_roll, by_fall});
  if (most < 0.5 * least_step_m) return nullptr;
  return most == by_elevation ? &elevation : most == by_roll ? &superelevation : &crossfall;
}

void check_along(const CheckedFile& file, RoadIndex index) {
  const Road& road = file.network.roads[index];
  const pugi::xml_node& road_node = file.road_nodes[index];
  for (const double s : seams_of(road)) {
    const Step step = step_at(road, s);
    if (!(std::abs(step.height_m) > least_step_m)) continue;
    const StepCause* cause = cause_of(road, s, step.t_m);
    file.findings.warning(cause ? node_at(road_node, *cause, s) : road_node,
                          fmt::format("the surface of road {} steps by {:.3f} m at s={:.3f}, t={:.3f}, by its {}",
                                      road.id, step.height_m, s, step.t_m, cause ? cause->name : "lane height"),
                          "let each record begin where the one before ends");
  }
}

/// A face along the road, between two cubics of one profile of its shape.
void check_shapes(const CheckedFile& file, RoadIndex index) {
  const Road& road = file.network.roads[index];
  for (std::size_t i = 1; i < road.shapes.size(); ++i) {
    const LateralShape &before = road.shapes[i - 1], &shape = road.shapes[i];
    if (shape.s_m != before.s_m) continue;
    const double dt = shape.t_m - before.t_m;
    const double step = shape.a - (before.a + dt * (before.b + dt * (before.c + dt * before.d)));
    const RoadExtent extent = road_extent(road, shape.s_m);
    if (!(std::abs(step) > least_step_m) || shape.t_m <= extent.right_t_m || shape.t_m >= extent.left_t_m) continue;
    pugi::xml_node node = file.road_nodes[index];
    for (const pugi::xml_node record : node.child("lateralProfile").children("shape"))
      if (std::abs(record.attribute("s").as_double() - shape.s_m) < beside_m &&
          std::abs(record.attribute("t").as_double() - shape.t_m) < beside_m) {
        node = record;
        break;
      }
    file.findings.warning(node,
                          fmt::format("the surface of road {} steps by {:.3f} m at s={:.3f}, t={:.3f}, by its shape",
                                      road.id, step, shape.s_m, shape.t_m),
                          "let each cubic begin where the one before ends");
  }
}

/// Sideways shift at a station of the lanes that continue: 0 where they are renumbered with the offset.
double sideways_m(const Road& road, double s_m) {
  const LaneSection &before = section_at(road, s_m - beside_m), &after = section_at(road, s_m + beside_m);
  double most = 0.0;
  for (const Lane& lane : before.lanes) {
    if (lane.id == 0 || !is_drivable(lane.type)) continue;
    const std::vector<int> next = &before == &after ? std::vector<int>{lane.id} : lane.successors;
    for (const int id : next) {
      if (id == 0 || !after.has_lane(id)) continue;
      const LaneBorders a = lane_borders(road, before, lane.id, s_m - beside_m),
                        b = lane_borders(road, after, id, s_m + beside_m);
      if (a.width_m() < 0.1 || b.width_m() < 0.1) continue;
      most = std::max(most, std::min(std::abs(a.inner_t_m - b.inner_t_m), std::abs(a.outer_t_m - b.outer_t_m)));
    }
  }
  return most;
}

void check_offset(const CheckedFile& file, RoadIndex index) {
  const Road& road = file.network.roads[index];
  for (const CubicRecord& record : road.lane_offset) {
    const double s = record.s_m;
    if (s < at_an_end_m || s > road.length_m - at_an_end_m) continue;
    if (!(std::abs(jump_of(road.lane_offset, s)) > least_step_m)) continue;
    const double moved_m = sideways_m(road, s);
    if (!(moved_m > least_step_m)) continue;
    file.findings.warning(node_at(file.road_nodes[index], lane_offset, s),
                          fmt::format("the lanes of road {} step sideways by {:.3f} m at s={:.3f}, by its laneOffset",
                                      road.id, moved_m, s),
                          "let each record begin where the one before ends");
  }
}

/// The element of a lane in a section that begins at a station, else the road's.
pugi::xml_node node_of_lane(const pugi::xml_node& road_node, double section_s_m, int id) {
  for (const pugi::xml_node section : road_node.child("lanes").children("laneSection")) {
    if (std::abs(section.attribute("s").as_double() - section_s_m) > beside_m) continue;
    for (const pugi::xml_node lane : section.child(id > 0 ? "left" : "right").children("lane"))
      if (lane.attribute("id").as_int() == id) return lane;
  }
  return road_node;
}

/// Steps of a lane's width, or of its border, within a section. A lane that begins or ends there does not step.
void check_width_steps(const CheckedFile& file, RoadIndex index) {
  constexpr double least_width_m = 0.1;
  const Road& road = file.network.roads[index];
  for (const LaneSection& section : road.sections)
    for (const Lane& lane : section.lanes) {
      if (lane.id == 0 || !is_drivable(lane.type)) continue;
      for (const CubicRecord& record : lane.widths.empty() ? lane.borders : lane.widths) {
        const double s = record.s_m;
        if (s < section.s_m + at_an_end_m || s > section.s_end_m - at_an_end_m) continue;
        const double before_m = lane_borders(road, section, lane.id, s - beside_m).width_m(),
                     after_m = lane_borders(road, section, lane.id, s + beside_m).width_m();
        if (std::min(before_m, after_m) < least_width_m || !(std::abs(after_m - before_m) > least_step_m)) continue;
        file.findings.warning(node_of_lane(file.road_nodes[index], section.s_m, lane.id),
                              fmt::format("lane {} of road {} is {:.3f} m wide before s={:.3f} and {:.3f} m behind it",
                                          lane.id, road.id, before_m, s, after_m),
                              "let each record begin where the one before ends");
      }
    }
}

}  // namespace

void check_steps(const CheckedFile& file) {
  for (RoadIndex index = 0; index < file.network.roads.size(); ++index) {
    if (file.network.roads[index].sections.empty()) continue;
    check_along(file, index);
    check_shapes(file, index);
    check_offset(file, index);
    check_width_steps(file, index);
  }
}

}  // namespace septet::road
