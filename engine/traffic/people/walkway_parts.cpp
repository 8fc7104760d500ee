#include "engine/traffic/people/walkway_parts.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>

#include "engine/road/lane_geometry.hpp"
#include "engine/road/road_position.hpp"

namespace septet::traffic {
namespace {

constexpr double step_m = 2.0, least_pavement_m = 0.8;

/// Borders of the pavement on a side of a road: the one next to the carriageway, and the far one.
struct Band {
  double kerb_t_m = 0.0, edge_t_m = 0.0;

  double middle_t_m() const { return 0.5 * (kerb_t_m + edge_t_m); }
};

/// The outermost lanes of type sidewalk beside each other; empty where there are none, or they are too narrow.
std::optional<Band> band_at(const road::Road& road, double s_m, int side) {
  const road::LaneSection& section = road::section_at(road, s_m);
  const int count = side > 0 ? section.left_count : section.right_count;
  int outer = 0, inner = 0;
  for (int n = count; n >= 1; --n) {
    if (section.lane(side * n).type == road::LaneType::sidewalk) {
      if (outer == 0) outer = n;
      inner = n;
    } else if (outer != 0) {
      break;
    }
  }
  if (outer == 0) return std::nullopt;
  const Band band{road::lane_borders(road, section, side * inner, s_m).inner_t_m,
                  road::lane_borders(road, section, side * outer, s_m).outer_t_m};
  if (std::abs(band.edge_t_m - band.kerb_t_m) < least_pavement_m) return std::nullopt;
  return band;
}

Vec3 ground_at(const road::RoadNetwork& network, const WalkwaySurroundings& around, road::RoadIndex index, double s_m,
               double t_m) {
  Vec3 at = road::evaluate(network, {index, s_m, t_m}).position_m;
  if (around.ground_m) at.z = around.ground_m(Vec2(at), at.z);
  return at;
}

WalkPoint point_of(const road::RoadNetwork& network, const WalkwaySurroundings& around, road::RoadIndex index,
                   double s_m, const Band& band) {
  WalkPoint point;
  const double t = band.middle_t_m(), half = 0.5 * std::abs(band.edge_t_m - band.kerb_t_m);
  point.middle_m = ground_at(network, around, index, s_m, t);
  point.half_m = half;
  const double reach = 0.5 * half;
  point.rises =
      (ground_at(network, around, index, s_m, t + reach).z - ground_at(network, around, index, s_m, t - reach).z) /
      (2.0 * reach);
  return point;
}

/// A crossing at a station from pavement to pavement; empty where one of them is missing.
std::optional<CrossingPart> crossing_at(const road::RoadNetwork& network, const WalkwaySurroundings& around,
                                        road::RoadIndex index, double s_m, double half_m, Crossing::Kind kind) {
  const road::Road& road = network.roads[index];
  const auto left = band_at(road, s_m, 1), right = band_at(road, s_m, -1);
  if (!left || !right) return std::nullopt;
  CrossingPart part;
  Crossing& crossing = part.crossing;
  crossing.kind = kind;
  crossing.place = {index, s_m, half_m, left->kerb_t_m, right->kerb_t_m};
  if (crossing.place.length_m() < 1.0) return std::nullopt;
  constexpr double beside_kerb_m = 0.08, along_m = 1.0;
  std::vector<double> ts{left->middle_t_m(), left->kerb_t_m + beside_kerb_m};
  const double from = left->kerb_t_m - beside_kerb_m, to = right->kerb_t_m + beside_kerb_m;
  const auto count = std::max(1, static_cast<int>(std::ceil((from - to) / along_m)));
  for (int k = 0; k <= count; ++k) ts.push_back(from + (to - from) * k / count);
  ts.push_back(right->kerb_t_m - beside_kerb_m);
  ts.push_back(right->middle_t_m());
  for (const double t : ts) {
    WalkPoint point;
    point.middle_m = ground_at(network, around, index, s_m, t);
    point.half_m = half_m;
    part.walk.line.push_back(point);
  }
  crossing.left_kerb_m = Vec2(road::evaluate(network, {index, s_m, left->kerb_t_m}).position_m);
  crossing.right_kerb_m = Vec2(road::evaluate(network, {index, s_m, right->kerb_t_m}).position_m);
  crossing.left_at_m = left->middle_t_m() - left->kerb_t_m;
  crossing.right_at_m = left->middle_t_m() - right->kerb_t_m;
  return part;
}

/// Half of a crosswalk's extent along its road, by its outline, else its length.
double half_extent_m(const road::RoadObject& object) {
  double low = 1e300, high = -1e300;
  const double cosine = std::cos(object.heading_rad), sine = std::sin(object.heading_rad);
  for (const road::Outline& outline : object.outlines)
    for (const road::OutlineCorner& corner : outline.corners) {
      const double s =
          corner.in_road_coordinates ? corner.s_or_u_m - object.s_m : cosine * corner.s_or_u_m - sine * corner.t_or_v_m;
      low = std::min(low, s), high = std::max(high, s);
    }
  const double extent_m =
      low < high ? high - low : std::abs(cosine) * object.length_m + std::abs(sine) * object.width_m;
  return 0.5 * std::clamp(extent_m, 1.5, 12.0);
}

void add_at_end(const road::RoadNetwork& network, const WalkwaySurroundings& around, road::RoadIndex index, bool at_end,
                std::vector<CrossingPart>& parts) {
  constexpr double before_m = 1.6, half_m = 1.4, crosswalk_within_m = 20.0, widest_m = 9.5;
  const road::Road& road = network.roads[index];
  const road::RoadLink& link = at_end ? road.successor : road.predecessor;
  if (link.junction == road::no_index || road.length_m < 4.0 * before_m) return;
  const double s_m = at_end ? road.length_m - before_m : before_m;
  const bool has_crosswalk = std::ranges::any_of(parts, [&](const CrossingPart& part) {
    return part.crossing.place.road == index && std::abs(part.crossing.place.s_m - s_m) < crosswalk_within_m;
  });
  if (has_crosswalk) return;
  auto part = crossing_at(network, around, index, s_m, half_m, Crossing::Kind::plain);
  if (part && part->crossing.place.length_m() < widest_m) parts.push_back(std::move(*part));
}

}  // namespace

std::vector<CrossingPart> crossing_parts(const road::RoadNetwork& network, const WalkwaySurroundings& around) {
  std::vector<CrossingPart> parts;
  for (road::RoadIndex index = 0; index < network.roads.size(); ++index) {
    const road::Road& road = network.roads[index];
    for (const road::RoadObject& object : road.objects) {
      if (object.type != "crosswalk") continue;
      auto part = crossing_at(network, around, index, std::clamp(object.s_m, 0.0, road.length_m), half_extent_m(object),
                              Crossing::Kind::zebra);
      if (part) parts.push_back(std::move(*part));
    }
    if (road.junction != road::no_index) continue;
    for (const bool at_end : {false, true}) add_at_end(network, around, index, at_end, parts);
  }
  return parts;
}

std::vector<WalkPart> pavement_parts(const road::RoadNetwork& network, const std::vector<CrossingPart>& crossings,
                                     const WalkwaySurroundings& around) {
  std::vector<WalkPart> parts;
  for (road::RoadIndex index = 0; index < network.roads.size(); ++index) {
    const road::Road& road = network.roads[index];
    // Stations: an even step, within each section's ends, and at crossings, where pavements are parted.
    std::vector<std::pair<double, bool>> stations;
    for (const road::LaneSection& section : road.sections) {
      constexpr double inside_m = 1e-3;
      const double from = section.s_m + inside_m, to = std::max(from, section.s_end_m - inside_m);
      const auto count = std::max(1, static_cast<int>(std::ceil((to - from) / step_m)));
      for (int k = 0; k <= count; ++k) stations.emplace_back(from + (to - from) * k / count, false);
    }
    for (const CrossingPart& part : crossings)
      if (part.crossing.place.road == index) stations.emplace_back(part.crossing.place.s_m, true);
    std::ranges::sort(stations);
    for (const int side : {1, -1}) {
      WalkPart part;
      part.in_junction = road.junction != road::no_index;
      const auto finish = [&] {
        if (part.line.size() >= 2) parts.push_back(part);
        part.line.clear();
      };
      double last_m = -1e9;
      for (const auto& [s_m, is_parted] : stations) {
        const auto band = band_at(road, s_m, side);
        if (!band) {
          finish();
          continue;
        }
        constexpr double least_step_m = 0.05;
        if (s_m - last_m < least_step_m && !part.line.empty()) {
          if (!is_parted) continue;
          part.line.pop_back();
        }
        last_m = s_m;
        part.line.push_back(point_of(network, around, index, s_m, *band));
        if (!is_parted) continue;
        const WalkPoint here = part.line.back();
        finish();
        part.line.push_back(here);
      }
      finish();
    }
  }
  return parts;
}

}  // namespace septet::traffic
