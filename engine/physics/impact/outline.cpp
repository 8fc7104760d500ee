#include "engine/physics/impact/outline.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace septet::impact {
namespace {

constexpr std::array<Vec2, 4> corner_signs{Vec2(1, 1), Vec2(-1, 1), Vec2(-1, -1), Vec2(1, -1)};

/// The rectangle without its rounding, relative to an origin near both outlines: far from the world's origin numbers
/// have fewer digits.
struct Core {
  Vec2 centre, forward, half;

  Vec2 at(const Vec2& local) const { return centre + local.x * forward + local.y * left_of(forward); }
  Vec2 local(const Vec2& point) const {
    return {glm::dot(point - centre, forward), glm::dot(point - centre, left_of(forward))};
  }
  Vec2 nearest_to(const Vec2& point) const { return at(glm::clamp(local(point), -half, half)); }
  double reach(const Vec2& way) const {
    return half.x * std::abs(glm::dot(forward, way)) + half.y * std::abs(glm::dot(left_of(forward), way));
  }
};

Core core_of(const Outline& outline, const Vec2& origin_m) {
  return {outline.centre_m - origin_m, outline.forward, glm::max(outline.half_m - outline.round_m, Vec2(0.0))};
}

struct Axis {
  Vec2 normal{1.0, 0.0};  ///< From the first to the second.
  double gap = -INFINITY;
};

/// The axis along which the cores are farthest apart, or overlap least.
Axis widest_axis(const Core& a, const Core& b) {
  Axis widest;
  const Vec2 between = b.centre - a.centre;
  for (const Vec2& axis : {a.forward, left_of(a.forward), b.forward, left_of(b.forward)}) {
    const double apart = glm::dot(between, axis), gap = std::abs(apart) - a.reach(axis) - b.reach(axis);
    if (gap > widest.gap) widest = {apart < 0.0 ? -axis : axis, gap};
  }
  return widest;
}

struct Pair {
  Vec2 on_first, on_second;
};

/// Of two rectangles apart, the nearest points: a corner of one is among them.
Pair nearest_points(const Core& a, const Core& b) {
  Pair best{};
  double least = INFINITY;
  const auto take = [&](const Vec2& on_first, const Vec2& on_second) {
    const Vec2 between = on_second - on_first;
    if (const double d = glm::dot(between, between); d < least) {
      least = d;
      best = {on_first, on_second};
    }
  };
  for (const Vec2& sign : corner_signs) {
    const Vec2 of_a = a.at(sign * a.half), of_b = b.at(sign * b.half);
    take(of_a, b.nearest_to(of_a));
    take(a.nearest_to(of_b), of_b);
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

/// Along `tangent`, the part of the rectangle whose distance along `outwards` from `origin` is not below −depth.
Stretch front_stretch(const Outline& outline, const Vec2& origin_m, const Vec2& outwards, const Vec2& tangent,
                      double depth) {
  const Core whole{outline.centre_m - origin_m, outline.forward, outline.half_m};
  Stretch stretch;
  for (std::size_t i = 0; i < corner_signs.size(); ++i) {
    const Vec2 here = whole.at(corner_signs[i] * whole.half);
    const Vec2 next = whole.at(corner_signs[(i + 1) % corner_signs.size()] * whole.half);
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

Meeting nearest(const Outline& first, const Outline& second) {
  const Vec2 origin = first.centre_m;
  const Core a = core_of(first, origin), b = core_of(second, origin);
  Axis axis = widest_axis(a, b);
  const double round = first.round_m + second.round_m;
  Meeting meeting;
  if (axis.gap > 0.0) {
    const Pair pair = nearest_points(a, b);
    const Vec2 between = pair.on_second - pair.on_first;
    const double apart = glm::length(between);
    meeting.place.normal = between / apart;
    meeting.gap_m = apart - round;
    meeting.place.point_m = pair.on_first + (first.round_m + 0.5 * meeting.gap_m) * meeting.place.normal + origin;
    return meeting;
  }
  meeting.place.normal = axis.normal;
  meeting.gap_m = axis.gap - round;
  const double front = glm::dot(a.centre, axis.normal) + a.reach(axis.normal) + first.round_m;
  const Vec2 on_axis = (front + 0.5 * meeting.gap_m) * axis.normal;
  const Vec2 tangent = left_of(axis.normal);
  meeting.place.point_m = on_axis + 0.5 * glm::dot(a.centre + b.centre, tangent) * tangent + origin;
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

double passing_depth_m(const Outline& first, const Outline& second, const Vec2& way) {
  const double length = glm::length(way);
  if (!(length > 0.0)) return INFINITY;
  const Vec2 across = left_of(way) / length;
  const Core a = core_of(first, first.centre_m), b = core_of(second, first.centre_m);
  const double own = a.reach(across) + first.round_m, other = b.reach(across) + second.round_m;
  const double overlap = own + other - std::abs(glm::dot(b.centre - a.centre, across));
  const double narrower = 2.0 * std::min(own, other);
  if (overlap <= 0.0) return 0.0;
  return overlap < narrower ? overlap * narrower / (narrower - overlap) : INFINITY;
}

}  // namespace septet::impact
