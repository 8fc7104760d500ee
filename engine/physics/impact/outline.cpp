#include "engine/physics/impact/outline.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <tuple>

namespace septet::impact {
namespace {

constexpr double least_apart_m = 1e-9;     ///< Nearer points give no direction.
constexpr double least_left_m = 0.02;      ///< Of an outline, along any cut.
constexpr double same_way_cosine = 0.999;  ///< Ways within 2.5 degrees share a cut.
constexpr double least_front_cosine = 0.5;

/// A convex polygon, its corners counter-clockwise, relative to an origin near both outlines: far from the world's
/// origin numbers have fewer digits.
struct Polygon {
  std::array<Vec2, 6 + std::tuple_size_v<decltype(Cuts::each)>> corners;
  std::size_t count = 0;

  double reach(const Vec2& way) const {
    double most = -INFINITY;
    for (std::size_t i = 0; i < count; ++i) most = std::max(most, glm::dot(corners[i], way));
    return most;
  }
  const Vec2& after(std::size_t i) const { return corners[i + 1 < count ? i + 1 : 0]; }
};

/// What is left of the polygon where way · p ≤ offset; at least its corner that lies farthest back.
Polygon clipped(const Polygon& polygon, const Cut& cut) {
  Polygon left;
  std::size_t last = 0;
  for (std::size_t i = 0; i < polygon.count; ++i) {
    const Vec2 &here = polygon.corners[i], &next = polygon.after(i);
    const double out = glm::dot(here, cut.way) - cut.offset_m, out_next = glm::dot(next, cut.way) - cut.offset_m;
    if (glm::dot(here, cut.way) < glm::dot(polygon.corners[last], cut.way)) last = i;
    if (out <= 0.0) left.corners[left.count++] = here;
    if ((out <= 0.0) != (out_next <= 0.0)) left.corners[left.count++] = here + out / (out - out_next) * (next - here);
  }
  if (left.count == 0) left.corners[left.count++] = polygon.corners[last];
  return left;
}

/// The outline less `rim_m` all round: with its rounding, its core.
Polygon polygon_of(const Outline& outline, const Vec2& origin_m, double rim_m) {
  const Vec2 half = glm::max(outline.half_m - rim_m, Vec2(0.0));
  Polygon polygon;
  polygon.count = 4;
  polygon.corners[0] = half;
  polygon.corners[1] = Vec2(-half.x, half.y);
  polygon.corners[2] = -half;
  polygon.corners[3] = Vec2(half.x, -half.y);
  for (std::size_t i = 0; i < outline.cuts.count; ++i) {
    const Cut& cut = outline.cuts.each[i];
    polygon = clipped(polygon, {cut.way, cut.offset_m - rim_m});
  }
  const Vec2 centre = outline.centre_m - origin_m, left = left_of(outline.forward);
  for (std::size_t i = 0; i < polygon.count; ++i)
    polygon.corners[i] = centre + polygon.corners[i].x * outline.forward + polygon.corners[i].y * left;
  return polygon;
}
Polygon core_of(const Outline& outline, const Vec2& origin_m) { return polygon_of(outline, origin_m, outline.round_m); }

struct Axis {
  Vec2 normal{1.0, 0.0};  ///< From the first to the second.
  double gap = -INFINITY;
};

/// True where both outlines may be met along this normal.
bool faces(const Outline& first, const Outline& second, const Vec2& normal) {
  return (first.front == Vec2(0.0) || glm::dot(first.front, normal) >= least_front_cosine) &&
         (second.front == Vec2(0.0) || glm::dot(second.front, -normal) >= least_front_cosine);
}

struct WidestAxes {
  Axis any, met;  ///< Of all normals, and of those along which both may be met.
};

/// The axis along which the cores are farthest apart, or overlap least.
WidestAxes widest_axes(const Outline& first, const Outline& second, const Polygon& a, const Polygon& b) {
  WidestAxes widest;
  const auto look = [&](const Vec2& normal) {
    const Axis axis{normal, -b.reach(-normal) - a.reach(normal)};
    if (axis.gap > widest.any.gap) widest.any = axis;
    if (axis.gap > widest.met.gap && faces(first, second, normal)) widest.met = axis;
  };
  for (const Vec2& way : {first.forward, left_of(first.forward), second.forward, left_of(second.forward)}) {
    look(way);
    look(-way);
  }
  const auto look_at_cuts = [&](const Outline& outline, double sign) {
    for (std::size_t i = 0; i < outline.cuts.count; ++i) {
      const Vec2& way = outline.cuts.each[i].way;
      look(sign * (way.x * outline.forward + way.y * left_of(outline.forward)));
    }
  };
  look_at_cuts(first, 1.0);
  look_at_cuts(second, -1.0);
  return widest;
}

struct Pair {
  Vec2 on_first, on_second;
};

Vec2 nearest_on_edge(const Vec2& from, const Vec2& to, const Vec2& point) {
  const Vec2 along = to - from;
  const double square = glm::dot(along, along);
  return square > 0.0 ? from + std::clamp(glm::dot(point - from, along) / square, 0.0, 1.0) * along : from;
}

/// Of two polygons apart, the nearest points: a corner of one is among them.
Pair nearest_points(const Polygon& a, const Polygon& b) {
  Pair best{};
  double least = INFINITY;
  const auto take = [&](const Vec2& on_first, const Vec2& on_second) {
    const Vec2 between = on_second - on_first;
    if (const double d = glm::dot(between, between); d < least) {
      least = d;
      best = {on_first, on_second};
    }
  };
  for (std::size_t i = 0; i < a.count; ++i)
    for (std::size_t k = 0; k < b.count; ++k) {
      take(a.corners[i], nearest_on_edge(b.corners[k], b.after(k), a.corners[i]));
      take(nearest_on_edge(a.corners[i], a.after(i), b.corners[k]), b.corners[k]);
    }
  return best;
}

struct Stretch {
  double from = INFINITY, to = -INFINITY;
  void hold(double at) {
    from = std::min(from, at);
    to = std::max(to, at);
  }
};

/// Along `tangent`, the part of the outline whose distance along `outwards` from `origin` is not below −depth.
Stretch front_stretch(const Outline& outline, const Vec2& origin_m, const Vec2& outwards, const Vec2& tangent,
                      double depth) {
  const Polygon whole = polygon_of(outline, origin_m, 0.0);
  Stretch stretch;
  for (std::size_t i = 0; i < whole.count; ++i) {
    const Vec2 &here = whole.corners[i], &next = whole.after(i);
    const double in = glm::dot(here, outwards) + depth, after = glm::dot(next, outwards) + depth;
    if (in >= 0.0) stretch.hold(glm::dot(here, tangent));
    if ((in >= 0.0) != (after >= 0.0)) stretch.hold(glm::dot(here + in / (in - after) * (next - here), tangent));
  }
  return stretch;
}

}  // namespace

Outline box_outline(const Vec2& centre_m, const Vec2& forward, const Vec2& half_m, double round_m) {
  return {centre_m, forward, half_m, std::clamp(round_m, 0.0, std::min(half_m.x, half_m.y))};
}

Outline post_outline(const Vec2& centre_m, double radius_m) {
  return {centre_m, Vec2(1.0, 0.0), Vec2(radius_m), radius_m};
}

Outline wall_outline(const Vec2& from_m, const Vec2& to_m, double radius_m) {
  const Vec2 along_m = to_m - from_m;
  const double length_m = glm::length(along_m);
  const Vec2 forward = length_m > 0.0 ? along_m / length_m : Vec2(1.0, 0.0);
  return {0.5 * (from_m + to_m), forward, Vec2(0.5 * length_m + radius_m, radius_m), radius_m};
}

double reach_m(const Outline& outline, const Vec2& way) {
  return core_of(outline, outline.centre_m).reach(way) + outline.round_m;
}

double reach_beside_m(const Outline& outline, const Vec2& way, const Vec2& from_m, const Vec2& along, double length_m) {
  const Polygon whole = polygon_of(outline, from_m, 0.0);
  if (whole.reach(along) < 0.0 || whole.reach(-along) < -length_m) return -INFINITY;
  return clipped(clipped(whole, {along, length_m}), {-along, 0.0}).reach(way);
}

void cut_off(const Vec2& way, double depth_m, Outline& outline) {
  if (!(depth_m > 0.0)) return;
  Cut cut{{glm::dot(way, outline.forward), glm::dot(way, left_of(outline.forward))}, 0.0};
  Cuts& cuts = outline.cuts;
  std::size_t at = cuts.count;
  double nearest_cosine = cuts.count < cuts.each.size() ? same_way_cosine : -INFINITY;
  for (std::size_t i = 0; i < cuts.count; ++i)
    if (const double cosine = glm::dot(cuts.each[i].way, cut.way); cosine > nearest_cosine) {
      nearest_cosine = cosine;
      at = i;
    }
  if (at < cuts.count) cut.way = cuts.each[at].way;
  const Vec2 along = cut.way.x * outline.forward + cut.way.y * left_of(outline.forward);
  const double least_m = 2.0 * outline.round_m - reach_m(outline, -along) + least_left_m;
  cut.offset_m = std::max(reach_m(outline, along) - depth_m, least_m);
  cuts.each[at] = cut;
  cuts.count = std::max(cuts.count, at + 1);
}

Meeting nearest(const Outline& first, const Outline& second) {
  const Vec2 origin = first.centre_m;
  const Polygon a = core_of(first, origin), b = core_of(second, origin);
  const WidestAxes widest = widest_axes(first, second, a, b);
  const double round = first.round_m + second.round_m;
  Meeting meeting;
  if (widest.any.gap > 0.0) {
    const Pair pair = nearest_points(a, b);
    const Vec2 between = pair.on_second - pair.on_first;
    const double apart = glm::length(between);
    meeting.place.normal = apart > least_apart_m ? between / apart : widest.any.normal;
    meeting.gap_m = apart - round;
    meeting.place.point_m = pair.on_first + (first.round_m + 0.5 * meeting.gap_m) * meeting.place.normal + origin;
    if (meeting.gap_m > 0.0 || faces(first, second, meeting.place.normal)) return meeting;
  }
  const Axis& axis = widest.met;
  meeting.place.normal = axis.normal;
  meeting.gap_m = axis.gap - round;
  const double front = a.reach(axis.normal) + first.round_m;
  const Vec2 on_axis = (front + 0.5 * meeting.gap_m) * axis.normal;
  const Vec2 tangent = left_of(axis.normal);
  meeting.place.point_m = on_axis + 0.5 * glm::dot(second.centre_m - origin, tangent) * tangent + origin;
  return meeting;
}

std::optional<Meeting> contact_of(const Outline& first, const Outline& second) {
  const Vec2 between = second.centre_m - first.centre_m;
  const double reach_m = glm::length(first.half_m) + glm::length(second.half_m);
  if (glm::dot(between, between) > reach_m * reach_m) return std::nullopt;
  Meeting meeting = nearest(first, second);
  if (meeting.gap_m > 0.0) return std::nullopt;
  meeting.place.point_m = engaged_point_m(first, second, meeting.place, -0.5 * meeting.gap_m);
  return meeting;
}

Vec2 engaged_point_m(const Outline& first, const Outline& second, const Place& place, double depth_m) {
  const Vec2 tangent = left_of(place.normal);
  const Stretch own = front_stretch(first, place.point_m, place.normal, tangent, depth_m);
  const Stretch other = front_stretch(second, place.point_m, -place.normal, tangent, depth_m);
  const double from = std::max(own.from, other.from), to = std::min(own.to, other.to);
  if (!(from <= to)) return place.point_m;
  return place.point_m + 0.5 * (from + to) * tangent;
}

Passing passing(const Outline& first, const Outline& second, const Vec2& way) {
  const double length = glm::length(way);
  Passing past;
  if (!(length > 0.0) || first.front != Vec2(0.0) || second.front != Vec2(0.0)) return past;
  const Vec2 across = left_of(way) / length;
  const Polygon a = core_of(first, first.centre_m), b = core_of(second, first.centre_m);
  const Stretch own{-a.reach(-across) - first.round_m, a.reach(across) + first.round_m},
      other{-b.reach(-across) - second.round_m, b.reach(across) + second.round_m};
  const double to_left = own.to - other.from, to_right = other.to - own.from;
  const double narrower = std::min(own.to - own.from, other.to - other.from);
  past.narrower_m = narrower;
  past.aside_m = std::max(0.0, std::min(to_left, to_right));
  past.aside = to_left < to_right ? across : -across;
  if (past.aside_m < narrower) past.depth_m = past.aside_m * narrower / (narrower - past.aside_m);
  return past;
}

}  // namespace septet::impact
