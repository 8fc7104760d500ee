#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <string_view>
#include <vector>

#include <glm/geometric.hpp>

#include "engine/geometry/mesh_builder.hpp"
#include "engine/road/lane_geometry.hpp"
#include "engine/roadside/signals.hpp"
#include "engine/scenery/world/world_context.hpp"
#include "engine/scenery/world/world_finish.hpp"

namespace septet::scenery {
namespace {

using geometry::MeshBuilder;
using roadside::SignalForm;

constexpr double paint_lift_m = 0.014, bar_m = 0.5, stop_line_m = 0.5, arrow_length_m = 4.0, parking_line_m = 0.12;
constexpr double piece_m = 2.0;  ///< Length of pieces along a bend or over a crest.

/// Paint of one tile, in road coordinates.
class PaintPen {
 public:
  PaintPen(const WorldContext& world, const RoadTile& tile) : world_(world), tile_(tile) {}

  void quad(double s0, double s1, double t0, double t1, Ground ground) {
    builder_.material = index_of(ground);
    const int pieces = std::max(1, static_cast<int>(std::ceil(std::min((s1 - s0) / piece_m, 200.0))));
    for (int i = 0; i < pieces; ++i) {
      const double a = std::lerp(s0, s1, static_cast<double>(i) / pieces), b = std::lerp(s0, s1, (i + 1.0) / pieces);
      // Texture coordinates of a stripe: across it from one edge to the other.
      const auto v0 = static_cast<float>(a - tile_.s0_m), v1 = static_cast<float>(b - tile_.s0_m);
      builder_.patch(at(a, t1), at(a, t0), at(b, t0), at(b, t1), {{{0, v0}, {1, v0}, {1, v1}, {0, v1}}});
    }
  }

  /// Draws a polygon with corners ahead and to the left of a place, in metres; `ahead` is +1 along s.
  void polygon(double s, double t, double ahead, const std::vector<Vec2>& corners) {
    builder_.material = index_of(Ground::paint);
    std::vector<std::uint32_t> vertices;
    vertices.reserve(corners.size());
    for (const Vec2& corner : corners)
      vertices.push_back(builder_.vertex(at(s + ahead * corner.x, t + ahead * corner.y)));
    double around = 0.0;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Vec2 &a = corners[i], &b = corners[(i + 1) % corners.size()];
      around += a.x * b.y - a.y * b.x;
    }
    if (around < 0.0) std::ranges::reverse(vertices);
    for (std::size_t i = 2; i < vertices.size(); ++i) builder_.triangle(vertices[0], vertices[i - 1], vertices[i]);
  }

  const geometry::PolygonMesh& mesh() const { return builder_.mesh(); }

 private:
  glm::vec3 at(double s, double t) const { return world_.roads.local(tile_, s, t, paint_lift_m); }

  const WorldContext& world_;
  const RoadTile& tile_;
  MeshBuilder builder_;
};

struct Span {
  double low_m = 1e300, high_m = -1e300;
  bool empty() const { return high_m - low_m < 0.05; }
  void add(double value) {
    low_m = std::min(low_m, value);
    high_m = std::max(high_m, value);
  }
};

/// Span from one kerb to the other.
Span carriageway(const road::Road& road, double s_m) {
  Span span;
  const road::LaneSection& section = road::section_at(road, s_m);
  for (const road::Lane& lane : section.lanes) {
    using enum road::LaneType;
    if (lane.id == 0 || lane.type == sidewalk || lane.type == none || lane.type == curb) continue;
    const road::LaneBorders borders = road::lane_borders(road, section, lane.id, s_m);
    span.add(borders.inner_t_m);
    span.add(borders.outer_t_m);
  }
  return span;
}

/// Span in s of the line of this t within a polygon of (s, t).
Span along_within(const std::vector<Vec2>& corners, double t_m) {
  Span span;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec2 &a = corners[i], &b = corners[(i + 1) % corners.size()];
    if ((a.y <= t_m) == (b.y <= t_m)) continue;
    span.add(std::lerp(a.x, b.x, (t_m - a.y) / (b.y - a.y)));
  }
  return span;
}

/// Draws bars along the road, half a metre wide and apart.
void draw_crossing(PaintPen& pen, const RoadTile& tile, const std::vector<Vec2>& corners, const Span& across) {
  Span t;
  for (const Vec2& corner : corners) t.add(corner.y);
  const double low = std::max(t.low_m, across.low_m), high = std::min(t.high_m, across.high_m);
  if (!(high - low > bar_m) || high - low > 200.0) return;
  const int bars = std::max(1, static_cast<int>(std::lround((high - low) / (2.0 * bar_m))));
  const double margin = 0.5 * (high - low - (2 * bars - 1) * bar_m);
  for (int i = 0; i < bars; ++i) {
    const double t0 = low + margin + 2.0 * i * bar_m, t1 = std::min(t0 + bar_m, high);
    Span s = along_within(corners, 0.5 * (t0 + t1));
    s = {std::max(s.low_m, tile.s0_m), std::min(s.high_m, tile.s1_m)};
    if (!s.empty() && s.high_m - s.low_m < 100.0) pen.quad(s.low_m, s.high_m, std::max(t0, low), t1, Ground::mark);
  }
}

std::vector<Vec2> corners_of(const road::RoadObject& object) {
  std::vector<Vec2> corners;
  const double cosine = std::cos(object.heading_rad), sine = std::sin(object.heading_rad);
  const auto add_local = [&](double u_m, double v_m) {
    corners.emplace_back(object.s_m + cosine * u_m - sine * v_m, object.t_m + sine * u_m + cosine * v_m);
  };
  if (object.outlines.empty()) {
    const double u = 0.5 * object.length_m, v = 0.5 * object.width_m;
    for (const Vec2& corner : {Vec2(-u, -v), Vec2(u, -v), Vec2(u, v), Vec2(-u, v)}) add_local(corner.x, corner.y);
    return corners;
  }
  for (const road::OutlineCorner& corner : object.outlines.front().corners) {
    if (corner.in_road_coordinates)
      corners.emplace_back(corner.s_or_u_m, corner.t_or_v_m);
    else
      add_local(corner.s_or_u_m, corner.t_or_v_m);
  }
  return corners;
}

/// Draws a line of paint from one place of (s, t) to another.
void draw_line(PaintPen& pen, const Vec2& from, const Vec2& to, double width_m) {
  const double length_m = glm::length(to - from);
  if (!(length_m > 0.05) || length_m > 100.0) return;
  const Vec2 along = (to - from) / length_m, aside = 0.5 * width_m * Vec2(-along.y, along.x);
  const Vec2 before = -0.5 * width_m * along, behind = to - from + 0.5 * width_m * along;
  pen.polygon(from.x, from.y, 1.0, {before - aside, behind - aside, behind + aside, before + aside});
}

/// Draws the outline but for the side nearest to the road's axis, which is the entrance.
void draw_parking_space(PaintPen& pen, const std::vector<Vec2>& corners) {
  if (corners.size() < 3 || corners.size() > 20) return;
  const auto off_axis = [&](std::size_t i) { return std::abs(corners[i].y + corners[(i + 1) % corners.size()].y); };
  std::size_t open = 0;
  for (std::size_t i = 1; i < corners.size(); ++i)
    if (off_axis(i) < off_axis(open)) open = i;
  for (std::size_t i = 0; i < corners.size(); ++i)
    if (i != open) draw_line(pen, corners[i], corners[(i + 1) % corners.size()], parking_line_m);
}

/// Draws one space, or a row of them along its repeats.
void draw_parking(PaintPen& pen, const RoadTile& tile, const road::RoadObject& object, double road_length_m) {
  const std::vector<Vec2> corners = corners_of(object);
  const auto draw_at = [&](double s_m, double t_m) {
    const double kept_m = std::clamp(s_m, 0.0, std::nextafter(road_length_m, 0.0));
    if (kept_m < tile.s0_m || kept_m >= tile.s1_m) return;
    std::vector<Vec2> moved = corners;
    for (Vec2& corner : moved) corner += Vec2(s_m - object.s_m, t_m - object.t_m);
    draw_parking_space(pen, moved);
  };
  if (object.repeats.empty()) draw_at(object.s_m, object.t_m);
  for (const road::ObjectRepeat& row : object.repeats) {
    const double step_m = std::max(row.distance_m > 0.0 ? row.distance_m : object.length_m, 1.0);
    const double skipped = std::floor((tile.s0_m - row.s_m) / step_m);
    for (double on_m = std::max(0.0, skipped * step_m); on_m <= row.length_m + 1e-6 && row.s_m + on_m <= tile.s1_m;
         on_m += step_m)
      draw_at(row.s_m + on_m, std::lerp(row.t_start_m, row.t_end_m, row.length_m > 0.0 ? on_m / row.length_m : 0.0));
  }
}

std::vector<Vec2> corners_of(const road::Road& road, const road::Signal& signal) {
  const double depth = std::clamp(signal.value > 0.0 ? signal.value : 4.0, 2.0, 10.0),
               width = signal.width_m > 0.0 ? signal.width_m : 50.0;
  // Begins at its station, away from the road's nearer end.
  const double s0 = std::clamp(signal.s_m < 0.5 * road.length_m ? signal.s_m : signal.s_m - depth, 0.0,
                               std::max(0.0, road.length_m - depth));
  return {{s0, signal.t_m - 0.5 * width},
          {s0 + depth, signal.t_m - 0.5 * width},
          {s0 + depth, signal.t_m + 0.5 * width},
          {s0, signal.t_m + 0.5 * width}};
}

/// Span of the lanes that lead up to a signal and that it is valid for.
Span lanes_towards(const road::Road& road, const road::Signal& signal) {
  const int along = roadside::direction_of(road, signal);
  const bool right_hand = road.rule == road::TrafficRule::right_hand;
  const road::LaneSection& section = road::section_at(road, signal.s_m);
  Span t;
  for (const road::Lane& lane : section.lanes) {
    if (!road::is_drivable(lane.type) || lane.id == 0 || ((lane.id < 0) == right_hand) != (along > 0)) continue;
    const bool valid =
        (signal.from_lane == 0 && signal.to_lane == 0) || (lane.id >= std::min(signal.from_lane, signal.to_lane) &&
                                                           lane.id <= std::max(signal.from_lane, signal.to_lane));
    if (!valid) continue;
    const road::LaneBorders borders = road::lane_borders(road, section, lane.id, signal.s_m);
    t.add(borders.inner_t_m);
    t.add(borders.outer_t_m);
  }
  return t;
}

/// Draws a line across the lanes that lead up to it.
void draw_stop_line(PaintPen& pen, const road::Road& road, const road::Signal& signal) {
  const Span t = lanes_towards(road, signal);
  if (!t.empty())
    pen.quad(signal.s_m - 0.5 * stop_line_m, signal.s_m + 0.5 * stop_line_m, t.low_m + 0.08, t.high_m - 0.08,
             Ground::paint);
}

/// Line before which the lanes that lead up to a sign wait: bars across them.
void draw_waiting_line(PaintPen& pen, const road::Road& road, const road::Signal& sign) {
  constexpr double bar_across_m = 0.5, gap_m = 0.25, deep_m = 0.3;
  const Span t = lanes_towards(road, sign);
  if (t.empty() || t.high_m - t.low_m > 100.0) return;
  for (double low = t.low_m + 0.1; low + bar_across_m <= t.high_m; low += bar_across_m + gap_m)
    pen.quad(sign.s_m - 0.5 * deep_m, sign.s_m + 0.5 * deep_m, low, low + bar_across_m, Ground::paint);
}

/// True if the file paints a stop line or a waiting line itself for those who read this sign.
bool has_painted_line(const road::Road& road, const road::Signal& sign) {
  constexpr double near_m = 20.0;
  return std::ranges::any_of(road.signals, [&](const road::Signal& line) {
    return (line.type == "294" || line.type == "341") && std::abs(line.s_m - sign.s_m) < near_m &&
           roadside::direction_of(road, line) == roadside::direction_of(road, sign);
  });
}

void draw_line_of(PaintPen& pen, const road::Road& road, const road::Signal& signal, SignalForm form) {
  if (form == SignalForm::stop_line)
    draw_stop_line(pen, road, signal);
  else if (form == SignalForm::waiting_line)
    draw_waiting_line(pen, road, signal);
  else if (form == SignalForm::board && (signal.type == "205" || signal.type == "206") &&
           !has_painted_line(road, signal))
    signal.type == "205" ? draw_waiting_line(pen, road, signal) : draw_stop_line(pen, road, signal);
}

void draw_arrow(PaintPen& pen, const road::Road& road, const road::Signal& signal) {
  const std::string_view name = signal.name;
  const auto says = [&](std::string_view word) { return name.find(word) != std::string_view::npos; };
  const bool left = says("Left"), right = says("Right"), straight = says("Straight") || (!left && !right);
  const double ahead = roadside::direction_of(road, signal);
  const auto draw = [&](const std::vector<Vec2>& corners) { pen.polygon(signal.s_m, signal.t_m, ahead, corners); };
  constexpr double half = 0.09, tip = 0.5 * arrow_length_m;
  draw({{-tip, half}, {-tip, -half}, {straight ? tip - 1.2 : 0.4, -half}, {straight ? tip - 1.2 : 0.4, half}});
  if (straight) draw({{tip - 1.3, 0.32}, {tip - 1.3, -0.32}, {tip, 0.0}});
  for (const double side : {1.0, -1.0}) {
    if (!(side > 0 ? left : right)) continue;
    draw({{0.1, side * -half}, {0.9, side * 0.45}, {0.6, side * 0.55}, {-0.4, side * half}});
    draw({{1.35, side * 0.75}, {0.9, side * 0.1}, {0.15, side * 0.75}});
  }
}

bool lies_in(const RoadTile& tile, double s_m) { return s_m >= tile.s0_m && s_m < tile.s1_m; }

}  // namespace

void build_road_paint(const WorldContext& world) {
  for (const RoadTile& tile : world.roads.tiles(160.0)) {
    const road::Road& road = world.roads.road(tile.road);
    PaintPen pen(world, tile);
    // Objects at the road's end belong to its last tile.
    const auto here = [&](double s_m) {
      return lies_in(tile, std::clamp(s_m, 0.0, std::nextafter(road.length_m, 0.0)));
    };
    for (const road::Signal& signal : road.signals) {
      const SignalForm form = roadside::form_of(signal);
      if (form == SignalForm::crossing)
        draw_crossing(pen, tile, corners_of(road, signal), carriageway(road, signal.s_m));
      else if (form == SignalForm::arrow && here(signal.s_m))
        draw_arrow(pen, road, signal);
      else if (here(signal.s_m))
        draw_line_of(pen, road, signal, form);
    }
    for (const road::RoadObject& object : road.objects) {
      if (object.type == "crosswalk") draw_crossing(pen, tile, corners_of(object), carriageway(road, object.s_m));
      if (object.type == "parkingSpace") draw_parking(pen, tile, object, road.length_m);
    }
    add_tile_mesh(world, tile, "road paint", pen.mesh(), 0.0f, road_near_m);
  }
}

}  // namespace septet::scenery
