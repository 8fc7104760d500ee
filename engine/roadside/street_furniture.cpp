#include "engine/roadside/street_furniture.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "engine/core/random.hpp"
#include "engine/road/lane_geometry.hpp"
#include "engine/roadside/town.hpp"

namespace septet::roadside {
namespace {

constexpr double furnished_pavement_m = 2.0, from_road_end_m = 8.0, clear_of_signal_or_crossing_m = 4.0;
constexpr double beside_kerb_m = 0.5, before_edge_m = 0.45;
using enum FurnitureKind;
/// What stands there, by how often.
constexpr std::array standing{bin,     bin,     bin,          bench,   bench,   bollard,    bollard,
                              bollard, cabinet, cycle_stands, planter, planter, letter_box, advertising_column};

bool stands_at_kerb(FurnitureKind kind) { return kind == bin || kind == bollard || kind == cycle_stands; }

class Street {
 public:
  Street(const RoadShape& roads, road::RoadIndex index, std::vector<Furniture>& things)
      : roads_(roads), index_(index), road_(roads.road(index)), things_(things) {}

  void furnish(double side, Random& random) {
    for (double s = from_road_end_m + random.uniform(0.0, 10.0); s < road_.length_m - from_road_end_m;
         s += random.uniform(9.0, 24.0)) {
      const FurnitureKind kind = standing[random.below(standing.size())];
      const auto [kerb_t_m, edge_t_m] = pavement(s, side);
      if (std::abs(edge_t_m - kerb_t_m) < furnished_pavement_m || !is_clear(s)) continue;
      place(kind, s, stands_at_kerb(kind) ? kerb_t_m + side * beside_kerb_m : edge_t_m - side * before_edge_m, side);
    }
    for (double s = from_road_end_m + random.uniform(0.0, 20.0); s < road_.length_m - from_road_end_m;
         s += random.uniform(22.0, 34.0)) {
      place(gully, s, gutter_t_m(s, side) - side * 0.25, side);
      if (side > 0.0) place(manhole, s + 6.0, random.uniform(-1.0, 1.0), side);
    }
  }

 private:
  struct Pavement {
    double kerb_t_m = 0.0, edge_t_m = 0.0;
  };

  Pavement pavement(double s_m, double side) const {
    const road::LaneSection& section = road::section_at(road_, s_m);
    const int count = side > 0 ? section.left_count : section.right_count;
    const auto lane = [&](int n) { return side > 0 ? n : -n; };
    int innermost = count + 1;
    while (innermost > 1 && section.lane(lane(innermost - 1)).type == road::LaneType::sidewalk) --innermost;
    return {road::outer_border_t_m(road_, section, lane(innermost - 1), s_m),
            road::outer_border_t_m(road_, section, lane(count), s_m)};
  }

  /// Where cars' lanes end.
  double gutter_t_m(double s_m, double side) const {
    const road::LaneSection& section = road::section_at(road_, s_m);
    int outermost = 0;
    for (int n = 1; n <= (side > 0 ? section.left_count : section.right_count); ++n) {
      const int lane = side > 0 ? n : -n;
      const road::LaneType type = section.lane(lane).type;
      if (road::is_drivable(type) || type == road::LaneType::parking) outermost = lane;
    }
    return road::outer_border_t_m(road_, section, outermost, s_m);
  }

  bool is_clear(double s_m) const {
    return std::ranges::none_of(road_.signals,
                                [&](const road::Signal& signal) {
                                  return std::abs(signal.s_m - s_m) < clear_of_signal_or_crossing_m;
                                }) &&
           std::ranges::none_of(road_.objects, [&](const road::RoadObject& object) {
             return object.type == "crosswalk" &&
                    std::abs(object.s_m - s_m) < clear_of_signal_or_crossing_m + 0.5 * object.length_m;
           });
  }

  void place(FurnitureKind kind, double s_m, double t_m, double side) {
    if (things_.size() >= most_furniture) return;
    const road::RoadPoint at = roads_.at(index_, s_m, t_m);
    const double heading = at.heading_rad + (side > 0.0 ? 0.0 : std::numbers::pi);
    things_.push_back({kind, {at.position_m, orientation_from_angles(heading, 0.0, 0.0)}});
  }

  const RoadShape& roads_;
  road::RoadIndex index_;
  const road::Road& road_;
  std::vector<Furniture>& things_;
};

}  // namespace

double radius_of(FurnitureKind kind) {
  switch (kind) {
    case gully:
    case manhole:
      return 0.0;
    case bollard:
      return 0.08;
    case advertising_column:
    case planter:
      return 0.55;
    default:
      return 0.3;
  }
}

std::vector<Furniture> street_furniture(const RoadShape& roads, std::uint64_t seed) {
  std::vector<Furniture> things;
  for (road::RoadIndex index = 0; index < roads.network().roads.size(); ++index) {
    const road::Road& road = roads.road(index);
    if (road.junction != road::no_index || road.length_m < 3.0 * from_road_end_m ||
        !is_in_town(roads.network(), index, 0.5 * road.length_m))
      continue;
    for (const double side : {1.0, -1.0}) {
      Random random(seed, 12000 + 2 * static_cast<std::uint64_t>(index) + (side > 0 ? 1 : 0));
      Street(roads, index, things).furnish(side, random);
    }
  }
  return things;
}

}  // namespace septet::roadside
