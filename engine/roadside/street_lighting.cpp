#include "engine/roadside/street_lighting.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include <glm/geometric.hpp>

#include "engine/math/plane_cells.hpp"
#include "engine/road/lane_geometry.hpp"
#include "engine/road/road_locate.hpp"
#include "engine/roadside/town.hpp"
#include "engine/world/street_lamp.hpp"

namespace septet::roadside {
namespace {

constexpr double least_apart_m = 8.0, clear_of_signal_m = 4.0, row_spacing_m = 30.0, from_end_m = 5.0;
constexpr double from_kerb_m = 0.45, pavement_for_pole_m = 1.5;
constexpr double sample_m = 3.0, candidate_m = 3.0, candidate_reach_m = 32.0;
constexpr double enough_lux = 11.0;
/// Targets for any place of a lane, above those of the standard.
constexpr double least_lux = 6.6, least_of_mean = 0.42;
constexpr PlaneCells light_cells{LampLight::reach_m}, candidate_cells{candidate_reach_m};

bool is_kept_free(road::LaneType type) {
  return type != road::LaneType::none && type != road::LaneType::sidewalk && type != road::LaneType::curb;
}

/// Lateral position of a pole beside the lanes that are driven on: on the pavement there if a pole leaves room on it,
/// else behind it.
double pole_t(const road::Road& road, double s_m, double side) {
  const road::LaneSection& section = road::section_at(road, s_m);
  const int count = side > 0 ? section.left_count : section.right_count;
  const auto outer = [&](int lane) { return road::outer_border_t_m(road, section, lane, s_m); };
  double kerb = outer(0), edge = kerb, pavement_m = 0.0;
  for (int i = 1; i <= count; ++i) {
    const int lane = side > 0 ? i : -i;
    const road::LaneType type = section.lane(lane).type;
    if (type == road::LaneType::none) continue;
    edge = outer(lane);
    if (is_kept_free(type) || type == road::LaneType::curb)
      kerb = edge, pavement_m = 0.0;
    else
      pavement_m += std::abs(edge - outer(side > 0 ? lane - 1 : lane + 1));
  }
  return (pavement_m >= pavement_for_pole_m ? kerb : edge) + side * from_kerb_m;
}

Vec3 lens_of(const StreetLamp& lamp) {
  return lamp.world_from_lamp * Vec3(street_lamp::arm_m, 0.0, street_lamp::height_m);
}

class LampPlan {
 public:
  explicit LampPlan(const RoadShape& roads) : roads_(roads) {
    for (road::RoadIndex index = 0; index < roads_.network().roads.size(); ++index) gather(index);
  }

  std::vector<StreetLamp> made() {
    for (const Candidate& at : crossings_) take(at);
    for (road::RoadIndex index = 0; index < roads_.network().roads.size(); ++index) row(index);
    // Dark lanes first, then lanes that are uneven beside the light of other lanes' lamps.
    for (road::RoadIndex index = 0; index < roads_.network().roads.size(); ++index)
      light_up(index, [](double) { return least_lux; });
    for (road::RoadIndex index = 0; index < roads_.network().roads.size(); ++index)
      light_up(index, [](double mean_lux) { return least_of_mean * mean_lux; });
    return std::move(lamps_);
  }

 private:
  struct Candidate {
    road::RoadIndex road = 0;
    double s_m = 0.0, side = 1.0;
    StreetLamp lamp;
  };

  bool is_lit(road::RoadIndex index, double s_m) const {
    return is_in_town(roads_.network(), index, s_m) &&
           !roads_.structure_at(index, s_m, road::RoadStructure::Kind::tunnel);
  }

  /// Null where a pole may not stand.
  std::optional<Candidate> candidate(road::RoadIndex index, double s_m, double side) const {
    const road::Road& road = roads_.road(index);
    if (!is_lit(index, s_m)) return std::nullopt;
    for (const road::Signal& signal : road.signals)
      if (std::abs(signal.s_m - s_m) < clear_of_signal_m && (signal.t_m > 0.0) == (side > 0.0)) return std::nullopt;
    const road::RoadPoint at = roads_.at(index, s_m, pole_t(road, s_m, side));
    for (const road::Location& location : road::roads_holding(roads_.network(), Vec2(at.position_m)))
      if (is_kept_free(road::lane_type(roads_.network(), location.position.road, location.lanes.lane_any_type,
                                       location.position.s_m)))
        return std::nullopt;
    return Candidate{
        index,
        s_m,
        side,
        {{at.position_m, orientation_from_angles(at.heading_rad - side * 0.5 * std::numbers::pi, 0.0, 0.0)}}};
  }

  void gather(road::RoadIndex index) {
    const road::Road& road = roads_.road(index);
    for (double s = 0.5 * std::fmod(road.length_m, candidate_m); s <= road.length_m; s += candidate_m)
      for (const double side : {1.0, -1.0})
        if (auto found = candidate(index, s, side)) {
          candidates_[candidate_cells.key_at(Vec2(found->lamp.world_from_lamp.position_m))].push_back(*found);
        }
    // Position before the crossing: a pedestrian is seen against the ground that this lamp lights.
    constexpr double before_m = 2.0;
    for (const road::RoadObject& object : road.objects)
      if (object.type == "crosswalk")
        for (const double side : {1.0, -1.0})
          if (const auto found = candidate(index, std::clamp(object.s_m - side * before_m, 0.0, road.length_m), -side))
            crossings_.push_back(*found);
  }

  bool take(const Candidate& at) {
    const Vec2 pole(at.lamp.world_from_lamp.position_m);
    if (lamps_.size() >= most_lamps || light_.stands_near(pole, least_apart_m)) return false;
    lamps_.push_back(at.lamp);
    light_.add(at.lamp);
    return true;
  }

  void row(road::RoadIndex index) {
    const road::Road& road = roads_.road(index);
    if (road.junction != road::no_index) return;
    const double first = std::min(from_end_m, 0.5 * road.length_m), length = road.length_m - 2.0 * first;
    const auto steps = static_cast<int>(std::ceil(length / row_spacing_m));
    double side = 1.0;
    for (int i = 0; i <= steps; ++i) {
      const double s = first + (steps > 0 ? length * i / steps : 0.0);
      side = -side;
      // Lamps of a road beside it or across it serve both.
      if (light_.lux(roads_.at(index, s, road::outer_border_t_m(road, road::section_at(road, s), 0, s)).position_m) >
          enough_lux)
        continue;
      for (const double tried : {side, -side})
        if (const auto at = candidate(index, s, tried); at && take(*at)) break;
    }
  }

  /// Places near both edges of a lane, along the whole stretch of its section.
  std::vector<Vec3> places_on(road::RoadIndex index, std::size_t section_index, int lane) const {
    const road::Road& road = roads_.road(index);
    const road::LaneSection& section = road.sections[section_index];
    const double begin = section.s_m,
                 end = section_index + 1 < road.sections.size() ? road.sections[section_index + 1].s_m : road.length_m;
    const auto steps = std::max(1, static_cast<int>(std::ceil((end - begin) / sample_m)));
    std::vector<Vec3> places;
    for (int i = 0; i < steps; ++i) {
      const double s = begin + (end - begin) * (i + 0.5) / steps;
      if (!is_lit(index, s)) continue;
      const road::LaneBorders borders = road::lane_borders(road, section, lane, s);
      for (const double share : {1.0 / 6.0, 5.0 / 6.0})
        places.push_back(roads_.at(index, s, std::lerp(borders.inner_t_m, borders.outer_t_m, share)).position_m);
    }
    return places;
  }

  /// Adds lamps where a lane that is driven on is darker than `least` of its mean.
  void light_up(road::RoadIndex index, const auto& least) {
    const road::Road& road = roads_.road(index);
    for (std::size_t n = 0; n < road.sections.size(); ++n) {
      const road::LaneSection& section = road.sections[n];
      for (int lane = -section.right_count; lane <= section.left_count; ++lane) {
        if (lane == 0 || !road::is_drivable(section.lane(lane).type)) continue;
        const std::vector<Vec3> places = places_on(index, n, lane);
        double mean_lux = 0.0;
        for (const Vec3& ground : places) mean_lux += light_.lux(ground) / static_cast<double>(places.size());
        for (const Vec3& ground : places)
          while (light_.lux(ground) < least(mean_lux) && add_best(ground)) {
          }
      }
    }
  }

  /// Adds the free lamp near by that gives the most light there, if that is worth one.
  bool add_best(const Vec3& ground_m) {
    constexpr double worth_lux = 0.5;
    const Candidate* best = nullptr;
    double most_lux = worth_lux;
    const Vec2 reach(candidate_reach_m), p(ground_m);
    candidate_cells.for_each(p - reach, p + reach, [&](std::uint64_t key) {
      const auto cell = candidates_.find(key);
      if (cell == candidates_.end()) return;
      for (const Candidate& at : cell->second) {
        if (light_.stands_near(Vec2(at.lamp.world_from_lamp.position_m), least_apart_m)) continue;
        const Vec3 way = lens_of(at.lamp) - ground_m;
        if (way.z <= 0.5) continue;
        const double lux = street_lamp::ground_lux(way.z, way.x * way.x + way.y * way.y);
        if (lux > most_lux) best = &at, most_lux = lux;
      }
    });
    return best && take(*best);
  }

  const RoadShape& roads_;
  std::unordered_map<std::uint64_t, std::vector<Candidate>> candidates_;
  std::vector<Candidate> crossings_;
  LampLight light_;
  std::vector<StreetLamp> lamps_;
};

}  // namespace

LampLight::LampLight(const std::vector<StreetLamp>& lamps) {
  for (const StreetLamp& lamp : lamps) add(lamp);
}

void LampLight::add(const StreetLamp& lamp) {
  const Vec2 pole(lamp.world_from_lamp.position_m);
  cells_[light_cells.key_at(pole)].push_back(static_cast<std::uint32_t>(lamps_.size()));
  lamps_.push_back({pole, lens_of(lamp)});
}

double LampLight::lux(const Vec3& ground_m) const {
  double sum = 0.0;
  const Vec2 p(ground_m), reach(reach_m);
  light_cells.for_each(p - reach, p + reach, [&](std::uint64_t key) {
    const auto cell = cells_.find(key);
    if (cell == cells_.end()) return;
    for (const std::uint32_t number : cell->second) {
      const Vec3 way = lamps_[number].lens_m - ground_m;
      const double aside_m2 = way.x * way.x + way.y * way.y;
      if (way.z > 0.5 && aside_m2 < reach_m * reach_m) sum += street_lamp::ground_lux(way.z, aside_m2);
    }
  });
  return sum;
}

bool LampLight::stands_near(const Vec2& p, double distance_m) const {
  bool found = false;
  const Vec2 reach(distance_m);
  light_cells.for_each(p - reach, p + reach, [&](std::uint64_t key) {
    const auto cell = cells_.find(key);
    if (cell == cells_.end()) return;
    for (const std::uint32_t number : cell->second) found |= glm::distance(lamps_[number].pole_m, p) < distance_m;
  });
  return found;
}

std::vector<StreetLamp> planned_lamps(const RoadShape& roads) { return LampPlan(roads).made(); }

}  // namespace septet::roadside
