#include <cmath>

#include <fmt/format.h>
#include <pugixml.hpp>

#include "engine/road/rule_checks.hpp"

namespace septet::road {
namespace {

constexpr double tolerated_length_m = 0.001, tolerated_beside_m = 0.01, tolerated_rad = 0.01;

/// Length of the curve over the range of its parameter; the table runs through it at that many metres of curve per
/// metre of road.
double curve_length_m(const PlanCurve& plan, const PlanRecord& record) {
  const double speed = std::hypot(record.cubic.u[1], record.cubic.v[1]);
  return plan.cubic_knots[record.first_knot].parameter_per_m * speed * record.length_m;
}

void check_curve(const CheckedFile& file, const pugi::xml_node& geometry, const PlanCurve& plan,
                 const PlanRecord& record) {
  const double length = curve_length_m(plan, record);
  if (std::abs(length - record.length_m) > tolerated_length_m) {
    const bool by_length = std::string_view(geometry.child("paramPoly3").attribute("pRange").value()) == "arcLength";
    file.findings.warning(geometry, fmt::format("length={} but its curve is {:.4f} m long", record.length_m, length),
                          "give the curve's own length",
                          by_length ? "asam.net:xodr:1.7.0:road.geometry.parampoly3.arclength_range"
                                    : "asam.net:xodr:1.7.0:road.geometry.parampoly3.length_match");
  }
  constexpr std::string_view aligned = "asam.net:xodr:1.7.0:road.geometry.paramPoly3.valid_parameters";
  const auto& [u, v] = record.cubic;
  if (const double beside = std::hypot(u[0], v[0]); beside > tolerated_beside_m) {
    file.findings.warning(geometry,
                          fmt::format("its curve begins {:.4g} m beside where it says that it starts", beside),
                          "let aU and aV be 0", aligned);
  }
  if (const double turn = std::atan2(v[1], u[1]); std::abs(turn) > tolerated_rad) {
    file.findings.warning(geometry, fmt::format("its curve begins {:.4f} rad off the heading that it says", turn),
                          "let bV be 0 and bU be above 0", aligned);
  }
}

}  // namespace

void check_curves(const CheckedFile& file) {
  if (!file.is_at_least(7)) return;
  for (RoadIndex index = 0; index < file.network.roads.size(); ++index) {
    const PlanCurve& plan = file.network.roads[index].plan;
    auto geometry = file.road_nodes[index].child("planView").child("geometry");
    for (const PlanRecord& record : plan.records) {
      // Geometries without length are no records.
      while (geometry && geometry.attribute("length").as_double() <= 0.0) geometry = geometry.next_sibling("geometry");
      if (geometry.child("paramPoly3") && record.kind == PlanKind::cubic) check_curve(file, geometry, plan, record);
      geometry = geometry.next_sibling("geometry");
    }
  }
}

}  // namespace septet::road
