#include "engine/roadside/raised_areas.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <numbers>
#include <string>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "engine/math/plane_cells.hpp"
#include "engine/math/polygon.hpp"
#include "engine/road/road_position.hpp"
#include "engine/roadside/mentions.hpp"

namespace septet::roadside {
namespace {

constexpr PlaneCells area_cells{16.0};
constexpr double margin_m = 1.0;
constexpr double stone_m = 0.15;  // Width of a kerb stone where the file gives none.
constexpr double step_m = 2.0;    // Step along a long kerb, so that it bends with its road.
constexpr double lowest_m = 0.005;
constexpr std::size_t most_areas = 50'000, most_corners = 1'000, most_corners_of_all = 500'000, most_cells = 1'000'000;
constexpr double widest_m = 500.0, storey_m = 1.0;

bool says_kerb(std::string text) {
  std::ranges::transform(text, text.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text.find("kerb") != std::string::npos || text.find("curb") != std::string::npos;
}

bool is_raised(const road::RoadObject& object) {
  if (object.type == "trafficIsland") return true;
  if (object.type == "roadMark" || object.type == "crosswalk" || object.type == "parkingSpace") return false;
  return says_kerb(object.type) || says_kerb(object.subtype) || says_kerb(object.name);
}

/// Placement of an object: x along it, z off the road.
struct Stand {
  road::RoadPosition at;
  double up_m = 0.0;
};

class AreaBuilder {
 public:
  AreaBuilder(const road::RoadNetwork& network, std::vector<RaisedArea>& areas, bool& complete)
      : network_(network), areas_(areas), complete_(complete) {}

  void add(road::RoadIndex index, const road::RoadObject& object) {
    is_grown_ = mentions(object.subtype, "grass");
    for (const road::ObjectRepeat& repeat : object.repeats)
      repeat.distance_m > 0.0 ? add_row(index, object, repeat) : add_strip(index, repeat);
    if (!object.repeats.empty()) return;
    const Stand here{{index, object.s_m, object.t_m}, object.z_offset_m};
    if (object.outlines.empty()) add_box(here, object, object.length_m, object.width_m, object.height_m);
    for (const road::Outline& outline : object.outlines) add_outline(here, object, outline);
  }

 private:
  /// `over_m`: height of the top over the road's surface.
  struct Corner {
    Vec3 top_m;
    double over_m;
  };

  Corner on_road(const road::RoadPosition& at, double over_m) const {
    return {road::evaluate(network_, at).position_m + Vec3(0.0, 0.0, over_m), over_m};
  }
  Corner local(const Stand& stand, double heading_rad, double u_m, double v_m, double z_m) const {
    const RigidTransform world = road::world_from_road(road::evaluate(network_, stand.at));
    const double c = std::cos(heading_rad), s = std::sin(heading_rad), over_m = stand.up_m + z_m;
    return {world * Vec3(c * u_m - s * v_m, s * u_m + c * v_m, over_m), over_m};
  }

  void add_area(const road::RoadPosition& at, const std::vector<Corner>& corners) {
    if (corners.size() < 3) return;
    // A query on an area tests each of its sides, and its top is triangulated: the cost grows with the square of its
    // corners.
    if (corners.size() > most_corners || corners.size() > corners_left_) return void(complete_ = false);
    const double most_m = std::ranges::max(corners, {}, &Corner::over_m).over_m;
    if (!(most_m > lowest_m && most_m <= highest_kerb_m)) return;
    RaisedArea area{at.road, at.s_m, {}, Vec2(corners.front().top_m), Vec2(corners.front().top_m), is_grown_};
    for (const Corner& corner : corners) {
      area.top_m.push_back(corner.top_m);
      area.low_m = glm::min(area.low_m, Vec2(corner.top_m));
      area.high_m = glm::max(area.high_m, Vec2(corner.top_m));
    }
    const Vec2 size = area.high_m - area.low_m;
    if (areas_.size() >= most_areas || std::max(size.x, size.y) > widest_m) return void(complete_ = false);
    corners_left_ -= corners.size();
    areas_.push_back(std::move(area));
  }

  void add_box(const Stand& stand, const road::RoadObject& object, double length_m, double width_m, double height_m) {
    std::vector<Corner> corners;
    if (object.radius_m > 0.0) {
      for (int i = 0; i < 16; ++i) {
        const double angle = 2.0 * std::numbers::pi * i / 16.0;
        corners.push_back(local(stand, object.heading_rad, object.radius_m * std::cos(angle),
                                object.radius_m * std::sin(angle), height_m));
      }
    } else if (length_m > 0.0) {
      const double u = 0.5 * length_m, v = 0.5 * (width_m > 0.0 ? width_m : stone_m);
      for (const auto& [x, y] : std::array<std::pair<double, double>, 4>{{{-u, -v}, {u, -v}, {u, v}, {-u, v}}})
        corners.push_back(local(stand, object.heading_rad, x, y, height_m));
    }
    add_area(stand.at, corners);
  }

  void add_row(road::RoadIndex index, const road::RoadObject& object, const road::ObjectRepeat& row) {
    const int count = static_cast<int>(row.length_m / row.distance_m);
    for (int i = 0; i <= count && areas_.size() < most_areas; ++i) {
      const double share = row.length_m > 0.0 ? i * row.distance_m / row.length_m : 0.0;
      const Stand stand{{index, row.s_m + i * row.distance_m, std::lerp(row.t_start_m, row.t_end_m, share)},
                        std::lerp(row.z_offset_start_m, row.z_offset_end_m, share)};
      add_box(stand, object, object.length_m, std::lerp(row.width_start_m, row.width_end_m, share),
              std::lerp(row.height_start_m, row.height_end_m, share));
    }
  }

  void add_strip(road::RoadIndex index, const road::ObjectRepeat& strip) {
    const int count = std::max(1, static_cast<int>(std::ceil(strip.length_m / step_m)));
    const auto corner = [&](int i, double side) {
      const double share = static_cast<double>(i) / count;
      const double width_m = std::lerp(strip.width_start_m, strip.width_end_m, share);
      const double t_m =
          std::lerp(strip.t_start_m, strip.t_end_m, share) + 0.5 * side * (width_m > 0.0 ? width_m : stone_m);
      return on_road({index, strip.s_m + share * strip.length_m, t_m},
                     std::lerp(strip.z_offset_start_m, strip.z_offset_end_m, share) +
                         std::lerp(strip.height_start_m, strip.height_end_m, share));
    };
    for (int i = 0; i < count && areas_.size() < most_areas; ++i)
      add_area({index, strip.s_m + strip.length_m * i / count, 0.0},
               {corner(i, -1.0), corner(i + 1, -1.0), corner(i + 1, 1.0), corner(i, 1.0)});
  }

  void add_outline(const Stand& here, const road::RoadObject& object, const road::Outline& outline) {
    std::vector<Corner> corners;
    for (const road::OutlineCorner& c : outline.corners) {
      const double height_m = c.height_m > 0.0 ? c.height_m : object.height_m;
      corners.push_back(c.in_road_coordinates
                            ? on_road({here.at.road, c.s_or_u_m, c.t_or_v_m}, c.z_m + height_m)
                            : local(here, object.heading_rad, c.s_or_u_m, c.t_or_v_m, c.z_m + height_m));
    }
    if (outline.closed) return add_area(here.at, corners);
    for (std::size_t i = 0; i + 1 < corners.size(); ++i) {
      const Vec2 along = Vec2(corners[i + 1].top_m - corners[i].top_m);
      if (!(glm::length(along) > 1e-6)) continue;
      const Vec3 aside =
          0.5 * (object.width_m > 0.0 ? object.width_m : stone_m) / glm::length(along) * Vec3(-along.y, along.x, 0.0);
      const auto moved = [&](const Corner& corner, double side) {
        return Corner{corner.top_m + side * aside, corner.over_m};
      };
      add_area(here.at, {moved(corners[i], -1.0), moved(corners[i + 1], -1.0), moved(corners[i + 1], 1.0),
                         moved(corners[i], 1.0)});
    }
  }

  const road::RoadNetwork& network_;
  std::vector<RaisedArea>& areas_;
  bool& complete_;
  std::size_t corners_left_ = most_corners_of_all;
  bool is_grown_ = false;
};

RaisedArea area_of(const JunctionCorner& corner) {
  RaisedArea area{corner.road, corner.s_m, corner.kerb_m, Vec2(corner.kerb_m.front()), Vec2(corner.kerb_m.front())};
  area.top_m.insert(area.top_m.end(), corner.edge_m.rbegin(), corner.edge_m.rend());
  for (const Vec3& p : area.top_m) {
    area.low_m = glm::min(area.low_m, Vec2(p));
    area.high_m = glm::max(area.high_m, Vec2(p));
  }
  return area;
}

bool holds(const RaisedArea& area, const Vec2& p) {
  if (p.x < area.low_m.x || p.x > area.high_m.x || p.y < area.low_m.y || p.y > area.high_m.y) return false;
  return is_inside(area.top_m, p);
}

double height_of(const RaisedArea& area, const Vec2& p) {
  double nearest_m = INFINITY, height_m = 0.0;
  for (std::size_t i = 0, before = area.top_m.size() - 1; i < area.top_m.size(); before = i++) {
    const Vec3 &a = area.top_m[before], &b = area.top_m[i];
    const Vec2 along = Vec2(b - a);
    const double square = glm::dot(along, along);
    const double share = square > 0.0 ? std::clamp(glm::dot(p - Vec2(a), along) / square, 0.0, 1.0) : 0.0;
    const double distance_m = glm::distance(p, Vec2(a) + share * along);
    if (distance_m < nearest_m) nearest_m = distance_m, height_m = std::lerp(a.z, b.z, share);
  }
  return height_m;
}

}  // namespace

RaisedAreas::RaisedAreas(const road::RoadNetwork& network) {
  AreaBuilder builder(network, areas_, complete_);
  for (road::RoadIndex index = 0; index < network.roads.size(); ++index)
    for (const road::RoadObject& object : network.roads[index].objects)
      if (is_raised(object)) builder.add(index, object);
  if (areas_.size() == most_areas) complete_ = false;
  corners_ = junction_corners(network);
  for (const JunctionCorner& corner : corners_) areas_.push_back(area_of(corner));
  std::size_t entries = 0;
  for (std::uint32_t i = 0; i < areas_.size(); ++i) {
    if (entries > most_cells) {
      corners_.resize(corners_.size() - std::min(corners_.size(), areas_.size() - i));
      areas_.resize(i);
      complete_ = false;
      break;
    }
    const Vec2 low = areas_[i].low_m - margin_m, high = areas_[i].high_m + margin_m;
    area_cells.for_each(low, high, [&](std::uint64_t key) {
      cells_[key].push_back(i);
      ++entries;
    });
  }
}

double RaisedAreas::ground_at(const Vec2& p, double road_z_m) const {
  double ground_m = road_z_m;
  if (areas_.empty()) return ground_m;
  if (const auto cell = cells_.find(area_cells.key_at(p)); cell != cells_.end())
    for (const std::uint32_t i : cell->second) {
      if (!holds(areas_[i], p)) continue;
      if (const double top_m = height_of(areas_[i], p); top_m < road_z_m + storey_m)
        ground_m = std::max(ground_m, top_m);
    }
  return ground_m;
}

bool RaisedAreas::is_near(const Vec2& p, double reach_m) const {
  if (areas_.empty()) return false;
  const auto cell = cells_.find(area_cells.key_at(p));
  return cell != cells_.end() && std::ranges::any_of(cell->second, [&](std::uint32_t i) {
           const Vec2 apart = glm::max(glm::max(areas_[i].low_m - p, p - areas_[i].high_m), Vec2(0.0));
           return glm::dot(apart, apart) <= reach_m * reach_m;
         });
}

}  // namespace septet::roadside
