#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <pugixml.hpp>

#include "engine/math/plane_vector.hpp"
#include "engine/road/cubic_range.hpp"
#include "engine/road/road_elements.hpp"
#include "engine/road/road_limits.hpp"
#include "engine/road/road_position.hpp"

namespace septet::road {
namespace {

constexpr double break_m = 0.05, break_rad = 0.01;
/// Roads of test tracks climb a metre and a half in a metre; a steeper one comes from a wrong coefficient.
constexpr double steepest_grade = 2.0;

CubicCurve read_cubic(XmlFindings& findings, const pugi::xml_node& node, bool with_u) {
  static constexpr const char* u_names[4] = {"aU", "bU", "cU", "dU"};
  static constexpr const char* v_names[4] = {"aV", "bV", "cV", "dV"};
  static constexpr const char* names[4] = {"a", "b", "c", "d"};
  CubicCurve curve;
  for (std::size_t i = 0; i < 4; ++i) {
    curve.u[i] = with_u ? findings.number(node, u_names[i]) : (i == 1 ? 1.0 : 0.0);
    curve.v[i] = findings.number(node, with_u ? v_names[i] : names[i]);
  }
  return curve;
}

Expected<void> append_shape(XmlFindings& findings, const pugi::xml_node& geometry, const PlanStart& start,
                            PlanCurve& plan) {
  if (geometry.child("line")) return append_clothoid(plan, start, 0.0, 0.0);
  if (const auto arc = geometry.child("arc")) {
    const double curvature = findings.number(arc, "curvature");
    return append_clothoid(plan, start, curvature, curvature);
  }
  if (const auto spiral = geometry.child("spiral")) {
    const double first = findings.number(spiral, "curvStart");
    return append_clothoid(plan, start, first, findings.number(spiral, "curvEnd"));
  }
  if (const auto poly3 = geometry.child("poly3")) {
    return append_cubic(plan, start, read_cubic(findings, poly3, false), CubicRange::abscissa);
  }
  if (const auto poly3 = geometry.child("paramPoly3")) {
    const std::string_view range = poly3.attribute("pRange").value();
    if (!range.empty() && range != "arcLength" && range != "normalized") {
      findings.warning(poly3, fmt::format("pRange=\"{}\" is unknown; it is taken as normalized", range),
                       "write arcLength or normalized");
    }
    return append_cubic(plan, start, read_cubic(findings, poly3, true),
                        range == "arcLength" ? CubicRange::arc_length : CubicRange::normalized);
  }
  return failure("the geometry has no line, arc, spiral, poly3 or paramPoly3", "", "add one of them");
}

/// True where the last record stays within the bounds of roads.
bool is_in_the_world(const PlanCurve& plan) {
  const PlanRecord& record = plan.records.back();
  for (int i = 0; i <= 8; ++i) {
    // Within the record, whatever the rounding of s.
    const double ds = record.length_m * (1e-3 + 0.998 * i / 8.0);
    const Vec2 p = evaluate_plan(plan, record.s_m + ds).position_m;
    if (!(std::abs(p.x) <= 2.0 * farthest_m && std::abs(p.y) <= 2.0 * farthest_m)) return false;
  }
  return true;
}

/// Reports a record that does not begin at the end of the one before it.
void check_joint(XmlFindings& findings, const pugi::xml_node& geometry, const PlanPoint& end, const PlanRecord& next) {
  // A cubic begins at the place and heading of its own coefficients.
  const bool cubic = next.kind == PlanKind::cubic;
  const auto placed = [&](double along, double across) {
    return along * next.direction + across * Vec2(-next.direction.y, next.direction.x);
  };
  const Vec2 start = next.start_m + (cubic ? placed(next.cubic.u[0], next.cubic.v[0]) : Vec2(0.0));
  const Vec2 direction = cubic ? placed(next.cubic.u[1], next.cubic.v[1]) : next.direction;
  const double gap = glm::distance(end.position_m, start);
  if (gap > break_m) {
    findings.warning(geometry, fmt::format("it begins {:.3f} m from the end of the record before it", gap),
                     "let the records join");
  }
  const double turn =
      std::atan2(end.direction.x * direction.y - end.direction.y * direction.x, glm::dot(end.direction, direction));
  if (std::abs(turn) > break_rad) {
    findings.warning(geometry,
                     fmt::format("its heading differs by {:.4f} rad from the end of the record before it", turn),
                     "let the records join smoothly");
  }
}

void check_roll(XmlFindings& findings, const pugi::xml_node& lateral, const char* what, const CubicProfile& profile,
                double s_end) {
  visit_records(profile, s_end, [&](const CubicRecord& record, double end) {
    const double roll = value_range(record, record.s_m, end).magnitude();
    if (roll <= steepest_roll_rad) return;
    findings.error(lateral, fmt::format("the {} from s={} reaches {:.4g} rad", what, record.s_m, roll),
                   fmt::format("keep it within ±{} rad", steepest_roll_rad));
  });
}

}  // namespace

CubicProfile read_profile(XmlFindings& findings, const pugi::xml_node& parent, const char* element,
                          const char* station_attribute, double s_start_m) {
  CubicProfile profile;
  for (const auto node : parent.children(element)) {
    CubicRecord record{s_start_m + findings.number(node, station_attribute), findings.number_or(node, "a", 0.0),
                       findings.number_or(node, "b", 0.0), findings.number_or(node, "c", 0.0),
                       findings.number_or(node, "d", 0.0)};
    if (!profile.empty() && record.s_m < profile.back().s_m) {
      findings.error(
          node,
          fmt::format("{}={} lies before that of the record before it", station_attribute, record.s_m - s_start_m),
          "sort the records by their station");
      record.s_m = profile.back().s_m;
    }
    profile.push_back(record);
  }
  return profile;
}

void read_plan(XmlFindings& findings, const pugi::xml_node& road_node, const HeaderOffset& offset, Road& road) {
  const auto plan_view = road_node.child("planView");
  double s_end = 0.0;
  for (const auto geometry : plan_view.children("geometry")) {
    PlanStart start;
    start.s_m = findings.number(geometry, "s");
    const Vec2 position(findings.number(geometry, "x", farthest_m), findings.number(geometry, "y", farthest_m));
    start.position_m = turned(position + offset.shift_m, offset.heading_rad);
    start.heading_rad = wrap_angle(findings.number(geometry, "hdg") + offset.heading_rad);
    start.length_m = findings.number(geometry, "length", longest_road_m);
    if (start.length_m == 0.0) {
      findings.warning(geometry, "its length is 0; it is left out", "remove it");
      continue;
    }
    if (start.length_m < 0.0) {
      findings.error(geometry, fmt::format("its length is negative ({} m)", start.length_m), "give a length above 0");
      continue;
    }
    if (!road.plan.records.empty() && start.s_m < road.plan.records.back().s_m) {
      findings.error(geometry, fmt::format("s={} lies before that of the record before it", start.s_m),
                     "sort the records by s");
      continue;
    }
    if (std::abs(start.s_m - s_end) > break_m) {
      findings.warning(geometry, fmt::format("s={} where the records before it end at {:.3f} m", start.s_m, s_end),
                       "let s be the sum of the lengths before it");
    }
    const bool first = road.plan.records.empty();
    const PlanPoint end = first ? PlanPoint{} : evaluate_plan(road.plan, start.s_m);
    if (const auto appended = append_shape(findings, geometry, start, road.plan); !appended) {
      findings.error(geometry, appended.error().what, appended.error().remedy);
      continue;
    }
    if (!is_in_the_world(road.plan)) {
      findings.error(geometry, "its curve leaves the world",
                     fmt::format("keep it within ±{} m; check its coefficients", farthest_m));
      road.plan.records.pop_back();
      continue;
    }
    if (!first) check_joint(findings, geometry, end, road.plan.records.back());
    s_end = start.s_m + start.length_m;
  }
  if (road.plan.records.empty()) {
    if (!plan_view.child("geometry") || !findings.has_error())
      findings.error(road_node, fmt::format("road {} has no geometry", road.id),
                     "add a planView with at least one geometry");
    return;
  }
  if (std::abs(s_end - road.length_m) > break_m) {
    const bool shorter = s_end < road.length_m;
    findings.warning(road_node,
                     fmt::format("length={} but its geometry ends at {:.3f} m{}", road.length_m, s_end,
                                 shorter ? ", where the road is taken to end" : ""),
                     "let the length be the sum of its geometries");
    if (shorter) road.length_m = s_end;
  }
}

void read_elevation(XmlFindings& findings, const pugi::xml_node& road_node, const HeaderOffset& offset, Road& road) {
  road.elevation = read_profile(findings, road_node.child("elevationProfile"), "elevation", "s", 0.0);
  for (CubicRecord& record : road.elevation) record.a += offset.z_m;
  const auto profile = road_node.child("elevationProfile");
  visit_records(road.elevation, road.length_m, [&](const CubicRecord& record, double end) {
    const double height = value_range(record, record.s_m, end).magnitude(),
                 grade = slope_range(record, record.s_m, end).magnitude();
    if (!(height <= highest_m)) {
      findings.error(profile, fmt::format("the elevation from s={} reaches {:.4g} m", record.s_m, height),
                     fmt::format("keep it within ±{} m; check its coefficients", highest_m));
    } else if (grade > steepest_grade) {
      findings.warning(profile, fmt::format("the road from s={} climbs {:.4g} m in a metre", record.s_m, grade),
                       "check the coefficients");
    }
  });
}

void read_lateral(XmlFindings& findings, const pugi::xml_node& road_node, Road& road) {
  const auto lateral = road_node.child("lateralProfile");
  road.superelevation = read_profile(findings, lateral, "superelevation", "s", 0.0);
  check_roll(findings, lateral, "superelevation", road.superelevation, road.length_m);
  for (const auto node : lateral.children("crossfall")) {
    const std::string_view side = node.attribute("side").value();
    const CubicRecord record{findings.number(node, "s"), findings.number_or(node, "a", 0.0),
                             findings.number_or(node, "b", 0.0), findings.number_or(node, "c", 0.0),
                             findings.number_or(node, "d", 0.0)};
    if (side != "right") road.crossfall_left.push_back(record);
    if (side != "left") road.crossfall_right.push_back(record);
  }
  for (const auto node : lateral.children("shape")) {
    road.shapes.push_back({findings.number(node, "s"), findings.number(node, "t"), findings.number_or(node, "a", 0.0),
                           findings.number_or(node, "b", 0.0), findings.number_or(node, "c", 0.0),
                           findings.number_or(node, "d", 0.0)});
  }
  const auto by_station = [](const auto& a, const auto& b) { return a.s_m < b.s_m; };
  std::stable_sort(road.crossfall_left.begin(), road.crossfall_left.end(), by_station);
  std::stable_sort(road.crossfall_right.begin(), road.crossfall_right.end(), by_station);
  std::stable_sort(road.shapes.begin(), road.shapes.end(), [](const LateralShape& a, const LateralShape& b) {
    return a.s_m != b.s_m ? a.s_m < b.s_m : a.t_m < b.t_m;
  });
  check_roll(findings, lateral, "crossfall", road.crossfall_left, road.length_m);
  check_roll(findings, lateral, "crossfall", road.crossfall_right, road.length_m);
  if (const auto surface = lateral.child("crossSectionSurface")) {
    findings.warning(surface, "cross-section surfaces are not honoured", "use superelevation and shape");
  }
}

}  // namespace septet::road
