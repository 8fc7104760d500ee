#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "engine/road/lane_geometry.hpp"
#include "engine/road/road_elements.hpp"
#include "engine/road/road_limits.hpp"

namespace septet::road {
namespace {

/// Limit for one road; places between them are not examined.
constexpr std::size_t most_stations = 1000;

/// Stations at which the surface is examined: at both ends of each record of the plan and of each lane section, and
/// between.
std::vector<double> stations_of(const Road& road) {
  constexpr int parts = 8;
  std::vector<double> stations;
  const auto add = [&](double from, double to) {
    // Just inside, where the record or the section itself holds.
    for (int i = 0; i <= parts; ++i) stations.push_back(from + (to - from) * (1e-6 + (1.0 - 2e-6) * i / parts));
  };
  for (const PlanRecord& record : road.plan.records) {
    if (stations.size() > most_stations) return stations;
    add(record.s_m, std::min(record.s_m + record.length_m, road.length_m));
  }
  for (const LaneSection& section : road.sections) {
    if (stations.size() > 2 * most_stations) return stations;
    add(section.s_m, section.s_end_m);
  }
  return stations;
}

}  // namespace

void check_surface(XmlFindings& findings, const pugi::xml_node& road_node, const Road& road) {
  if (road.plan.records.empty() || road.sections.empty()) return;
  bool folds = false;
  for (const double s : stations_of(road)) {
    const RoadExtent extent = road_extent(road, s);
    const double curvature = evaluate_plan(road.plan, s).curvature_per_m;
    for (const double t : {extent.right_t_m, extent.left_t_m}) {
      const double height = surface_offset_m(road, s, t);
      if (!(std::abs(height) <= tallest_m)) {
        findings.error(road_node,
                       fmt::format("the surface stands {:.4g} m above the road at s={:.3f}, t={:.3f}", height, s, t),
                       "check lane heights, crossfall and shapes");
        return;
      }
      if (folds || 1.0 - curvature * t > 0.0) continue;
      folds = true;
      findings.warning(road_node,
                       fmt::format("the lanes fold over at s={:.3f}: they reach {:.4g} m inside a curve of {:.4g} m", s,
                                   std::abs(t), 1.0 / std::abs(curvature)),
                       "give the curve a larger radius, or narrower lanes");
    }
  }
}

}  // namespace septet::road
