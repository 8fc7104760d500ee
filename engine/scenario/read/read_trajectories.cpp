#include <algorithm>

#include <fmt/format.h>

#include "engine/scenario/read/scenario_reading.hpp"

namespace septet::scenario {
namespace {

constexpr double longest_m = 1e5;
constexpr double sharpest_per_m = 100.0;
constexpr double latest_s = 1e6;

PolylineShape read_polyline(Reading& reading, const Element& element) {
  PolylineShape shape;
  for (const Element& vertex : element.children("Vertex")) {
    shape.vertices.push_back({read_position(reading, vertex), vertex.number_or("time", 0.0, 0.0, latest_s)});
  }
  if (shape.vertices.size() < 2) element.error("it has less than two vertices", "add <Vertex>");
  return shape;
}

ClothoidSplineShape read_clothoid(Reading& reading, const Element& element) {
  ClothoidSplineShape::Segment segment;
  segment.start = read_position(reading, element);
  segment.length_m = element.number("length", 0.0, longest_m);
  segment.start_curvature_per_m = element.number("curvature", -sharpest_per_m, sharpest_per_m);
  // Version 1.0 called the curvature's derivative curvatureDot.
  const char* growth = element.has("curvatureDot") ? "curvatureDot" : "curvaturePrime";
  segment.end_curvature_per_m = segment.start_curvature_per_m + segment.length_m * element.number(growth, -1.0, 1.0);
  segment.start_time_s = element.number_or("startTime", 0.0, 0.0, latest_s);
  return {{segment}, element.number_or("stopTime", 0.0, segment.start_time_s, latest_s)};
}

ClothoidSplineShape read_clothoid_spline(Reading& reading, const Element& element) {
  ClothoidSplineShape shape;
  for (const Element& found : element.children("ClothoidSplineSegment")) {
    ClothoidSplineShape::Segment segment;
    if (found.child("PositionStart")) segment.start = read_position_in(reading, found.child("PositionStart"));
    segment.length_m = found.number("length", 0.0, longest_m);
    segment.start_curvature_per_m = found.number("curvatureStart", -sharpest_per_m, sharpest_per_m);
    segment.end_curvature_per_m = found.number("curvatureEnd", -sharpest_per_m, sharpest_per_m);
    segment.heading_offset_rad = found.number_or("hOffset", 0.0);
    const double before = shape.segments.empty() ? 0.0 : shape.segments.back().start_time_s;
    segment.start_time_s = found.number_or("timeStart", before, before, latest_s);
    shape.segments.push_back(segment);
  }
  if (shape.segments.empty()) {
    element.error("it has no segment", "add <ClothoidSplineSegment>");
    return shape;
  }
  const double last = shape.segments.back().start_time_s;
  shape.end_time_s = element.number_or("timeEnd", last, last, latest_s);
  return shape;
}

NurbsShape read_nurbs(Reading& reading, const Element& element) {
  NurbsShape shape;
  shape.order = element.integer("order", 2, 10);
  for (const Element& point : element.children("ControlPoint")) {
    shape.points.push_back({read_position(reading, point), point.number_or("weight", 1.0, 1e-6, 1e6),
                            point.number_or("time", 0.0, 0.0, latest_s)});
  }
  for (const Element& knot : element.children("Knot")) shape.knots.push_back(knot.number("value"));
  const auto order = static_cast<std::size_t>(shape.order);
  const bool good = shape.points.size() >= order && shape.points.size() <= 10'000 &&
                    shape.knots.size() == shape.points.size() + order &&
                    std::is_sorted(shape.knots.begin(), shape.knots.end()) &&
                    shape.knots[order - 1] < shape.knots[shape.points.size()];
  if (good) return shape;
  element.error(fmt::format("{} control points and {} knots make no curve of order {}", shape.points.size(),
                            shape.knots.size(), shape.order),
                "give as many rising knots as control points and order together, and at most 10000 points");
  return {2, {{}, {}}, {0.0, 0.0, 1.0, 1.0}};
}

/// True where a point of the trajectory is to be reached before the one before it.
bool times_fall(const Trajectory& trajectory) {
  const auto fall = [](const auto& points) {
    return !std::is_sorted(points.begin(), points.end(),
                           [](const auto& a, const auto& b) { return a.time_s < b.time_s; });
  };
  if (const auto* polyline = std::get_if<PolylineShape>(&trajectory.shape)) return fall(polyline->vertices);
  const auto* nurbs = std::get_if<NurbsShape>(&trajectory.shape);
  return nurbs != nullptr && fall(nurbs->points);
}

void read_times(const Element& element, FollowTrajectoryAction& action) {
  const Element timing = element.child("TimeReference").child("Timing");
  element.child("TimeReference").child("None");
  if (!timing) return;
  action.timed = true;
  action.from_simulation_start =
      timing.required_word<bool>("domainAbsoluteRelative", {{"absolute", true}, {"relative", false}}, false);
  action.time_scale = timing.number_or("scale", 1.0, 1e-6, 1e6);
  action.time_offset_s = timing.number_or("offset", 0.0, -latest_s, latest_s);
  if (times_fall(action.trajectory)) {
    timing.error("the trajectory's times do not rise from point to point",
                 "give later points later times, or <None/> instead of <Timing>");
  }
}

}  // namespace

Trajectory read_trajectory(Reading& reading, const Element& element) {
  Trajectory trajectory;
  trajectory.name = element.label("name");
  trajectory.closed = element.required_boolean("closed", false);
  const Element shape = element.required("Shape");
  if (const Element found = shape.child("Polyline"))
    trajectory.shape = read_polyline(reading, found);
  else if (const Element clothoid = shape.child("Clothoid"))
    trajectory.shape = read_clothoid(reading, clothoid);
  else if (const Element spline = shape.child("ClothoidSpline"))
    trajectory.shape = read_clothoid_spline(reading, spline);
  else if (const Element nurbs = shape.child("Nurbs"))
    trajectory.shape = read_nurbs(reading, nurbs);
  else if (shape)
    shape.error("it is empty", "add <Polyline>, <Clothoid>, <ClothoidSpline> or <Nurbs>");
  return trajectory;
}

ActionVariant read_follow_trajectory(Reading& reading, const Element& element) {
  FollowTrajectoryAction action;
  // Version 1.0 had the trajectory without a <TrajectoryRef> around it.
  const Element reference = element.child("TrajectoryRef");
  const Element& parent = reference ? reference : element;
  Element trajectory = parent.child("Trajectory");
  trajectory =
      trajectory ? with_declared_parameters(trajectory) : resolve_catalog_reference(reading, parent, {"Trajectory"});
  if (trajectory)
    action.trajectory = read_trajectory(reading, trajectory);
  else if (!parent.child("CatalogReference"))
    element.error("it has no trajectory", "add <TrajectoryRef> with a <Trajectory>");
  action.initial_distance_m = element.number_or("initialDistanceOffset", 0.0, 0.0, longest_m);
  read_times(element, action);
  if (const Element mode = element.child("TrajectoryFollowingMode")) {
    const bool follow = mode.required_word<bool>("followingMode", {{"position", false}, {"follow", true}}, false);
    if (follow) {
      mode.warning("followingMode=\"follow\" is not supported; \"position\" is taken",
                   "expect the trajectory to be met exactly");
    }
  }
  return action;
}

}  // namespace septet::scenario
