#include "engine/scenario/run/path.hpp"

#include <algorithm>
#include <cmath>

#include "engine/road/road_position.hpp"
#include "engine/scenario/run/resolve_position.hpp"

namespace septet::scenario {
namespace {

constexpr double corner_m = 2.0;  ///< Within this distance of a vertex the heading turns.
constexpr double finest_m = 0.1;  ///< Spacing of a curve's points, where that makes no more than most_points.
constexpr double most_points = 20'000.0;
constexpr double same_place_m = 1e-6;

/// True where the file itself gives an orientation there.
bool has_own_heading(const Position& position) {
  return std::visit(
      [](const auto& at) {
        if constexpr (requires { at.orientation; }) return at.orientation.given;
        if constexpr (requires { at.heading_given; }) return at.heading_given;
        return false;
      },
      position);
}

/// The same angle, at most half a turn from another.
double near_angle(double angle_rad, double other_rad) { return other_rad + road::wrap_angle(angle_rad - other_rad); }

struct Corner {
  Vec3 position_m{0.0};
  std::optional<double> heading_rad;
  double time_s = 0.0;
};

double length_m(const Corner& a, const Corner& b) { return glm::length(b.position_m - a.position_m); }

/// The heading of each line from a corner to the next; where two corners coincide (a wait), that of the line before, or
/// else of the next line of non-zero length.
std::vector<double> line_headings(const std::vector<Corner>& corners) {
  std::vector<double> headings;
  std::size_t unknown = 0;
  for (std::size_t i = 0; i + 1 < corners.size(); ++i) {
    const Vec3 along = corners[i + 1].position_m - corners[i].position_m;
    const bool known = glm::length(Vec2(along)) >= same_place_m;
    const double before = headings.empty() ? 0.0 : headings.back();
    headings.push_back(known ? std::atan2(along.y, along.x) : before);
    if (known && unknown == i) std::fill(headings.begin(), headings.end(), headings.back());
    if (!known && unknown == i) ++unknown;
  }
  return headings;
}

/// Points of straight lines between corners. Between corners of one place only time goes on.
Path join_corners(const std::vector<Corner>& corners) {
  Path path;
  double s = 0.0, before = 0.0;
  const auto add = [&](const Corner& a, const Corner& b, double part, double s_m, double heading) {
    before = path.points.empty() ? heading : near_angle(heading, before);
    path.points.push_back(
        {s_m, a.position_m + part * (b.position_m - a.position_m), before, a.time_s + part * (b.time_s - a.time_s)});
  };
  const std::vector<double> headings = line_headings(corners);
  const auto middle = [&](std::size_t left) {
    return headings[left] + 0.5 * road::wrap_angle(headings[left + 1] - headings[left]);
  };
  for (std::size_t i = 0; i + 1 < corners.size(); ++i) {
    const Corner &a = corners[i], &b = corners[i + 1];
    const double length = length_m(a, b);
    const double own = headings[i], turn = std::min(corner_m, length / 2.0);
    const bool first = i == 0, last = i + 2 == corners.size(), moves = length >= same_place_m;
    const double start = a.heading_rad ? *a.heading_rad : first ? own : middle(i - 1);
    const double end = b.heading_rad ? *b.heading_rad : last ? own : middle(i);
    add(a, b, 0.0, s, start);
    if (moves && !a.heading_rad && !first) add(a, b, turn / length, s + turn, own);
    if (moves && !b.heading_rad && !last) add(a, b, 1.0 - turn / length, s + length - turn, own);
    add(a, b, 1.0, s + length, end);
    s += length;
  }
  return path;
}

/// Removes corners that equal the one before in place and time.
void drop_doubles(std::vector<Corner>& corners) {
  const auto same = [](const Corner& a, const Corner& b) {
    return length_m(a, b) < same_place_m && b.time_s <= a.time_s && !b.heading_rad;
  };
  corners.erase(std::unique(corners.begin(), corners.end(), same), corners.end());
}

/// Appends the first corner; the path to it is driven at the mean speed of the others.
void close_ring(std::vector<Corner>& corners) {
  double way = 0.0;
  for (std::size_t i = 0; i + 1 < corners.size(); ++i) way += length_m(corners[i], corners[i + 1]);
  const Corner &first = corners.front(), &last = corners.back();
  const double rest = length_m(last, first);
  if (rest < same_place_m) return;
  Corner end = first;
  end.time_s = last.time_s + (way > 0.0 ? (last.time_s - first.time_s) * rest / way : 0.0);
  corners.push_back(end);
}

struct Lay {
  const road::RoadNetwork& network;
  const ScenarioState& state;
  const EntityState& actor;
  bool closed;

  std::optional<Corner> corner(const Position& position, double time_s) const {
    const auto placement = resolve_position(network, state, position);
    if (!placement) return std::nullopt;
    Corner result{placement->pose.position_m, std::nullopt, time_s};
    if (has_own_heading(position)) result.heading_rad = heading_rad(placement->pose.orientation);
    return result;
  }

  /// Vertices or control points in sequence; none precedes the one before in time.
  template <class Points>
  std::optional<std::vector<Corner>> corners_of(const Points& points) const {
    std::vector<Corner> corners;
    for (const auto& point : points) {
      const double before = corners.empty() ? point.time_s : corners.back().time_s;
      const auto found = corner(point.position, std::max(point.time_s, before));
      if (!found) return std::nullopt;
      corners.push_back(*found);
    }
    return corners;
  }

  std::optional<Path> operator()(const PolylineShape& shape) const {
    auto corners = corners_of(shape.vertices);
    if (!corners) return std::nullopt;
    if (closed && !corners->empty()) close_ring(*corners);
    drop_doubles(*corners);
    if (corners->size() < 2) return std::nullopt;
    return join_corners(*corners);
  }

  std::optional<Path> operator()(const ClothoidSplineShape& shape) const {
    double length = 0.0;
    for (const auto& segment : shape.segments) length += segment.length_m;
    const double step = std::max(finest_m, length / most_points);
    Path path;
    Vec3 at = actor.world_from_entity.position_m;
    double heading = heading_rad(actor.world_from_entity.orientation), s = 0.0;
    for (std::size_t i = 0; i < shape.segments.size(); ++i) {
      const auto& segment = shape.segments[i];
      if (segment.start) {
        const auto placement = resolve_position(network, state, *segment.start);
        if (!placement) return std::nullopt;
        at = placement->pose.position_m;
        heading = near_angle(heading_rad(placement->pose.orientation), heading);
      }
      heading += segment.heading_offset_rad;
      const bool last = i + 1 == shape.segments.size();
      const double end_s = last ? shape.end_time_s : shape.segments[i + 1].start_time_s;
      add_clothoid(segment, end_s, step, s, at, heading, path);
    }
    if (path.points.size() < 2 || path.length_m() <= 0.0) return std::nullopt;
    return path;
  }

  std::optional<Path> operator()(const NurbsShape& shape) const {
    const auto placed = corners_of(shape.points);
    if (!placed) return std::nullopt;
    const std::vector<Corner>& control = *placed;
    const auto degree = static_cast<std::size_t>(shape.order - 1);
    const std::size_t spans = control.size() - degree;
    const std::size_t steps = std::min(static_cast<std::size_t>(most_points) / spans, std::size_t{200}) * spans;
    const double first = shape.knots[degree], last = shape.knots[control.size()];
    std::vector<Corner> corners;
    for (std::size_t i = 0; i <= steps; ++i) {
      const double u = first + (last - first) * static_cast<double>(i) / static_cast<double>(steps);
      corners.push_back(spline_at(shape, control, degree, u));
    }
    drop_doubles(corners);
    if (corners.size() < 2) return std::nullopt;
    return smooth(corners);
  }

 private:
  /// A segment from (at, heading) on, which it moves to its end; evenly in time. Each step is an arc of the segment's
  /// curvature at its middle, whose chord has the clothoid's direction there.
  static void add_clothoid(const ClothoidSplineShape::Segment& segment, double end_s, double most_m, double& s,
                           Vec3& at, double& heading, Path& path) {
    const double length = segment.length_m;
    const auto steps = static_cast<std::size_t>(std::max(std::ceil(length / most_m), 1.0));
    const double step = length / static_cast<double>(steps);
    const double growth = length > 0.0 ? (segment.end_curvature_per_m - segment.start_curvature_per_m) / length : 0.0;
    const double start = heading;
    const auto curvature_at = [&](double way) { return segment.start_curvature_per_m + growth * way; };
    const auto heading_at = [&](double way) {
      return start + way * (segment.start_curvature_per_m + 0.5 * growth * way);
    };
    path.points.push_back({s, at, heading, segment.start_time_s});
    for (std::size_t i = 1; i <= steps; ++i) {
      const double half = (static_cast<double>(i) - 0.5) * step;
      const double bend = 0.5 * step * curvature_at(half), middle = heading_at(half);
      const double chord = std::abs(bend) > 1e-6 ? step * std::sin(bend) / bend : step;
      at += chord * Vec3(std::cos(middle), std::sin(middle), 0.0);
      const double part = static_cast<double>(i) / static_cast<double>(steps);
      path.points.push_back({s + part * length, at, heading_at(part * length),
                             segment.start_time_s + part * (end_s - segment.start_time_s)});
    }
    s += length;
    heading = path.points.back().heading_rad;
  }

  /// de Boor's algorithm on weighted points; times are interpolated without the weights.
  static Corner spline_at(const NurbsShape& shape, const std::vector<Corner>& control, std::size_t degree, double u) {
    const auto& knots = shape.knots;
    const auto inner = knots.begin() + static_cast<std::ptrdiff_t>(degree + 1);
    const auto after = std::upper_bound(inner, knots.begin() + static_cast<std::ptrdiff_t>(control.size()), u);
    const std::size_t span = degree + static_cast<std::size_t>(after - inner);
    struct Weighted {
      Vec3 position{0.0};
      double weight = 0.0, time = 0.0;
    };
    std::vector<Weighted> points(degree + 1);
    for (std::size_t i = 0; i <= degree; ++i) {
      const std::size_t from = span - degree + i;
      const double weight = shape.points[from].weight;
      points[i] = {weight * control[from].position_m, weight, control[from].time_s};
    }
    for (std::size_t round = 1; round <= degree; ++round) {
      for (std::size_t i = degree; i >= round; --i) {
        const double low = knots[span - degree + i], high = knots[span + 1 + i - round];
        const double part = high > low ? (u - low) / (high - low) : 0.0;
        Weighted& point = points[i];
        const Weighted& before = points[i - 1];
        point = {(1.0 - part) * before.position + part * point.position,
                 (1.0 - part) * before.weight + part * point.weight, (1.0 - part) * before.time + part * point.time};
      }
    }
    const Weighted& found = points[degree];
    return {found.position / found.weight, std::nullopt, found.time};
  }

  /// Points so dense that the chord between the neighbours is the heading.
  static Path smooth(const std::vector<Corner>& corners) {
    Path path;
    double s = 0.0, before = 0.0;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Vec3 along =
          corners[std::min(i + 1, corners.size() - 1)].position_m - corners[i > 0 ? i - 1 : 0].position_m;
      if (i > 0) s += length_m(corners[i - 1], corners[i]);
      if (glm::length(Vec2(along)) >= same_place_m) {
        const double heading = std::atan2(along.y, along.x);
        before = i == 0 ? heading : near_angle(heading, before);
      }
      path.points.push_back({s, corners[i].position_m, before, corners[i].time_s});
    }
    return path;
  }
};

template <class Value>
PathPoint interpolated(const Path& path, double at, Value value) {
  const auto& points = path.points;
  const auto after =
      std::upper_bound(points.begin(), points.end(), at, [&](double x, const PathPoint& p) { return x < value(p); });
  if (after == points.begin()) return points.front();
  if (after == points.end()) return points.back();
  const PathPoint &a = *(after - 1), &b = *after;
  const double part = (at - value(a)) / (value(b) - value(a));
  return {a.s_m + part * (b.s_m - a.s_m), a.position_m + part * (b.position_m - a.position_m),
          a.heading_rad + part * (b.heading_rad - a.heading_rad), a.time_s + part * (b.time_s - a.time_s)};
}

}  // namespace

std::optional<Path> lay_path(const road::RoadNetwork& network, const ScenarioState& state, const EntityState& actor,
                             const Trajectory& trajectory) {
  return std::visit(Lay{network, state, actor, trajectory.closed}, trajectory.shape);
}

PathPoint path_at_station(const Path& path, double s_m) {
  return interpolated(path, s_m, [](const PathPoint& point) { return point.s_m; });
}

PathPoint path_at_time(const Path& path, double time_s) {
  return interpolated(path, time_s, [](const PathPoint& point) { return point.time_s; });
}

}  // namespace septet::scenario
