#include "engine/roadside/standing_objects.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>

#include "engine/roadside/barrier_lines.hpp"
#include "engine/roadside/mentions.hpp"

namespace septet::roadside {
namespace {

constexpr std::size_t most_footprint_corners = 200;

/// Kind of a standing object; null for others, and for those that other files draw.
std::optional<StandingKind> standing_kind_of(const road::RoadObject& object) {
  const std::string& type = object.type;
  constexpr std::array elsewhere{"gantry", "crosswalk", "trafficIsland", "parkingSpace", "patch",
                                 "road",   "roadMark",  "roadSurface",   "none",         "wind"};
  if (object.material || std::ranges::find(elsewhere, type) != elsewhere.end()) return std::nullopt;
  for (const std::string& text : {type, object.subtype, object.name})
    if (mentions(text, "kerb") || mentions(text, "curb")) return std::nullopt;
  if (is_barrier(object)) return runs_along(object) ? std::nullopt : std::optional(StandingKind::block);
  if (type == "building") return StandingKind::building;
  const bool tall = object.height_m >= 3.0 || object.height_m <= 0.0;
  if (type == "streetLamp" ||
      (type == "pole" && tall && (mentions(object.subtype, "lamp") || mentions(object.name, "lamp"))))
    return StandingKind::lamp;
  if (type == "tree") return StandingKind::tree;
  if (type == "vegetation") {
    if (!object.outlines.empty()) return std::nullopt;  // Area of vegetation.
    return object.height_m > 3.0 || mentions(object.subtype, "tree") || mentions(object.name, "tree")
               ? StandingKind::tree
               : StandingKind::bush;
  }
  if (mentions(type, "pole") || mentions(type, "post")) return StandingKind::pole;
  if (type == "obstacle" || type == "bus" || type == "car" || type == "van" || type == "trailer" || type == "train")
    return StandingKind::block;
  return std::nullopt;
}

BuildingUse use_of(const road::RoadObject& object) {
  constexpr std::array<std::pair<std::string_view, BuildingUse>, 9> uses{{{"shop", BuildingUse::shop},
                                                                          {"apartment", BuildingUse::flats},
                                                                          {"flats", BuildingUse::flats},
                                                                          {"house", BuildingUse::house},
                                                                          {"station", BuildingUse::hall},
                                                                          {"school", BuildingUse::hall},
                                                                          {"gymnasium", BuildingUse::hall},
                                                                          {"church", BuildingUse::church},
                                                                          {"tower", BuildingUse::tower}}};
  for (const auto& [word, use] : uses)
    if (mentions(object.subtype, word)) return use;
  return BuildingUse::unknown;
}

/// Corners in anticlockwise order; empty where they span no area.
std::vector<Vec2> against_the_clock(std::vector<Vec2> corners) {
  double twice_area = 0.0;
  for (std::size_t i = 0, before = corners.size() - 1; i < corners.size(); before = i++)
    twice_area += corners[before].x * corners[i].y - corners[i].x * corners[before].y;
  if (!(std::abs(twice_area) > 0.02)) return {};
  if (twice_area < 0.0) std::ranges::reverse(corners);
  return corners;
}

std::vector<Vec2> box_corners(double length_m, double width_m) {
  const double x = 0.5 * length_m, y = 0.5 * width_m;
  return {{-x, -y}, {x, -y}, {x, y}, {-x, y}};
}

/// Outline of a strip along an open line: there on one side, and back on the other.
std::vector<Vec2> strip_along(const std::vector<Vec2>& line, double width_m) {
  std::vector<Vec2> there, back;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const Vec2 way = line[std::min(i + 1, line.size() - 1)] - line[i > 0 ? i - 1 : 0];
    if (!(glm::length(way) > 1e-6)) continue;
    const Vec2 aside = 0.5 * width_m / glm::length(way) * Vec2(-way.y, way.x);
    there.push_back(line[i] - aside);
    back.push_back(line[i] + aside);
  }
  there.insert(there.end(), back.rbegin(), back.rend());
  return there;
}

class ObjectBuilder {
 public:
  explicit ObjectBuilder(const RoadShape& roads) : roads_(roads) {}

  void add(road::RoadIndex index, const road::RoadObject& object, StandingKind kind) {
    for (const road::ObjectRepeat& repeat : object.repeats) add_row(index, object, kind, repeat);
    if (object.repeats.empty())
      place(index, object, kind, object.s_m, object.t_m, object.z_offset_m, object.width_m, object.height_m);
  }
  std::vector<StandingObject> take() { return std::move(objects_); }

 private:
  void add_row(road::RoadIndex index, const road::RoadObject& object, StandingKind kind,
               const road::ObjectRepeat& repeat) {
    // A continuous row of objects is drawn as objects that touch.
    const double step_m = std::max({repeat.distance_m > 0.0 ? repeat.distance_m : object.length_m, 1.0});
    for (double on = 0.0; on <= repeat.length_m + 1e-6 && objects_.size() < most_standing_objects; on += step_m) {
      const double share = repeat.length_m > 0.0 ? on / repeat.length_m : 0.0;
      const auto between = [&](double from, double to) { return std::lerp(from, to, share); };
      const double height_m = between(repeat.height_start_m, repeat.height_end_m);
      const double width_m = between(repeat.width_start_m, repeat.width_end_m);
      place(index, object, kind, repeat.s_m + on, between(repeat.t_start_m, repeat.t_end_m),
            between(repeat.z_offset_start_m, repeat.z_offset_end_m), width_m > 0.0 ? width_m : object.width_m,
            height_m > 0.0 ? height_m : object.height_m);
    }
  }

  void place(road::RoadIndex index, const road::RoadObject& object, StandingKind kind, double s_m, double t_m,
             double up_m, double width_m, double height_m) {
    if (objects_.size() >= most_standing_objects || !(std::abs(t_m) < 1e4)) return;
    const road::RoadPoint at = roads_.at(index, s_m, t_m);
    const double turn = at.heading_rad + object.heading_rad;
    if (!std::isfinite(turn + at.position_m.x + at.position_m.y + at.position_m.z + up_m)) return;
    StandingObject standing;
    standing.kind = kind;
    if (kind == StandingKind::building) standing.use = use_of(object);
    standing.world_from_object = {at.position_m + Vec3(0, 0, std::clamp(up_m, -50.0, 50.0)),
                                  orientation_from_angles(turn, 0.0, 0.0)};
    // Height at the corners alone, as files up to OpenDRIVE 1.3 may give it.
    if (!(height_m > 0.0) && object.repeats.empty() && !object.outlines.empty())
      for (const road::OutlineCorner& corner : object.outlines.front().corners)
        height_m = std::max(height_m, corner.height_m);
    constexpr std::array usual_m{6.0, 6.0, 9.0, 1.5, 4.0, 1.0};
    standing.height_m = height_m > 0.0 ? height_m : usual_m[static_cast<std::size_t>(kind)];
    if (standing.height_m > highest_object_m) return;
    if (kind == StandingKind::lamp) {
      // Arm of the lamp, over the road.
      const double across = at.heading_rad + (t_m > 0.0 ? -0.5 : 0.5) * std::numbers::pi;
      standing.world_from_object.orientation = orientation_from_angles(across, 0.0, 0.0);
    }
    if (kind == StandingKind::pole) standing.radius_m = object.radius_m > 0.0 ? std::min(object.radius_m, 2.0) : 0.06;
    if (kind == StandingKind::building || kind == StandingKind::block) {
      standing.footprint_m = footprint(index, object, standing.world_from_object, width_m);
      if (standing.footprint_m.size() < 3) return;
    }
    objects_.push_back(std::move(standing));
  }

  std::vector<Vec2> footprint(road::RoadIndex index, const road::RoadObject& object, const RigidTransform& stands,
                              double width_m) const {
    std::vector<Vec2> corners;
    if (!object.outlines.empty() && object.repeats.empty()) {
      const RigidTransform object_from_world = inverse(stands);
      const road::Outline& outline = object.outlines.front();
      for (const road::OutlineCorner& corner : outline.corners)
        corners.push_back(corner.in_road_coordinates
                              ? Vec2(object_from_world * roads_.point(index, corner.s_or_u_m, corner.t_or_v_m))
                              : Vec2(corner.s_or_u_m, corner.t_or_v_m));
      if (!outline.closed) corners = strip_along(corners, width_m > 0.0 ? std::min(width_m, 3.0) : 0.3);
    } else if (object.radius_m > 0.0) {
      constexpr int sides = 12;
      for (int i = 0; i < sides; ++i)
        corners.push_back(object.radius_m * Vec2(std::cos(2.0 * std::numbers::pi * i / sides),
                                                 std::sin(2.0 * std::numbers::pi * i / sides)));
    } else {
      corners = box_corners(object.length_m, width_m);
    }
    const auto too_far = [](const Vec2& p) {
      return !(std::abs(p.x) < widest_object_m && std::abs(p.y) < widest_object_m);
    };
    if (corners.size() < 3 || corners.size() > most_footprint_corners || std::ranges::any_of(corners, too_far))
      return {};
    return against_the_clock(std::move(corners));
  }

  const RoadShape& roads_;
  std::vector<StandingObject> objects_;
};

}  // namespace

std::vector<StandingObject> standing_objects(const RoadShape& roads) {
  ObjectBuilder builder(roads);
  for (road::RoadIndex index = 0; index < roads.network().roads.size(); ++index)
    for (const road::RoadObject& object : roads.road(index).objects)
      if (const auto kind = standing_kind_of(object)) builder.add(index, object, *kind);
  return builder.take();
}

bool gives(const road::RoadNetwork& network, StandingKind kind) {
  return std::ranges::any_of(network.roads, [&](const road::Road& road) {
    return std::ranges::any_of(road.objects,
                               [&](const road::RoadObject& object) { return standing_kind_of(object) == kind; });
  });
}

}  // namespace septet::roadside
