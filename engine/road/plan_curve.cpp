#include "engine/road/plan_curve.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "engine/core/check.hpp"
#include "engine/math/plane_vector.hpp"
#include "engine/road/cubic_record.hpp"

namespace septet::road {
namespace {

constexpr double max_turn_per_knot_rad = 0.125;
constexpr double max_turn_rad = 1000.0;
constexpr double cubic_knot_spacing_m = 0.5;
constexpr std::size_t min_cubic_knots = 64, max_cubic_knots = 16384;

// Gauss–Legendre nodes and weights on [0, 1], four points.
constexpr double gauss_node[4] = {0.06943184420297371, 0.33000947820757187, 0.6699905217924281, 0.9305681557970263};
constexpr double gauss_weight[4] = {0.17392742256872692, 0.32607257743127307, 0.32607257743127307, 0.17392742256872692};

/// (cos φ, sin φ) for |φ| ≤ 1/4, by Taylor's series: the error is below 1e-12 there, 3e-14 at 1/8.
Vec2 small_turn(double phi) {
  const double q = phi * phi;
  const double cosine = 1.0 - q * (1.0 / 2 - q * (1.0 / 24 - q * (1.0 / 720 - q / 40320)));
  const double sine = phi * (1.0 - q * (1.0 / 6 - q * (1.0 / 120 - q / 5040)));
  return {cosine, sine};
}

/// Advances from a knot by `step_m` along a clothoid that has `curvature` at the knot; the heading turns by less than
/// 1/4 rad.
ClothoidKnot walk_clothoid(const ClothoidKnot& knot, double curvature, double rate, double step_m) {
  Vec2 moved(0.0), turn(1.0, 0.0);
  if (rate == 0.0) {
    // An arc: chord and turn from (sin φ)/φ and (1 − cos φ)/φ, as precise as small_turn.
    const double phi = curvature * step_m, q = phi * phi;
    const double sine = 1.0 - q * (1.0 / 6 - q * (1.0 / 120 - q / 5040));
    const double versine = phi * (1.0 / 2 - q * (1.0 / 24 - q * (1.0 / 720 - q / 40320)));
    moved = {sine, versine};
    turn = {1.0 - phi * versine, phi * sine};
  } else {
    const auto turn_at = [&](double u) { return small_turn(u * (curvature + 0.5 * rate * u)); };
    for (int i = 0; i < 4; ++i) moved += gauss_weight[i] * turn_at(gauss_node[i] * step_m);
    turn = turn_at(step_m);
  }
  moved *= step_m;
  const Vec2 left = left_of(knot.direction);
  return {knot.position_m + moved.x * knot.direction + moved.y * left, turn.x * knot.direction + turn.y * left};
}

double polynomial(const std::array<double, 4>& k, double p) { return k[0] + p * (k[1] + p * (k[2] + p * k[3])); }
double derivative(const std::array<double, 4>& k, double p) { return k[1] + p * (2.0 * k[2] + p * 3.0 * k[3]); }
double second_derivative(const std::array<double, 4>& k, double p) { return 2.0 * k[2] + 6.0 * k[3] * p; }

double speed(const CubicCurve& cubic, double p) { return std::hypot(derivative(cubic.u, p), derivative(cubic.v, p)); }

double arc_length(const CubicCurve& cubic, double p0, double p1) {
  double sum = 0.0;
  for (int i = 0; i < 4; ++i) sum += gauss_weight[i] * speed(cubic, p0 + gauss_node[i] * (p1 - p0));
  return sum * (p1 - p0);
}

PlanRecord record_from(const PlanStart& start) {
  PlanRecord record;
  record.s_m = start.s_m;
  record.length_m = start.length_m;
  record.start_m = start.position_m;
  record.direction = {std::cos(start.heading_rad), std::sin(start.heading_rad)};
  return record;
}

PlanPoint evaluate_clothoid(const PlanCurve& curve, const PlanRecord& record, double ds) {
  const auto last = static_cast<double>(record.knot_count - 1);
  const double nearest = std::clamp(std::floor(ds / record.knot_step_m), 0.0, last);
  const ClothoidKnot& knot = curve.clothoid_knots[record.first_knot + static_cast<std::uint32_t>(nearest)];
  const double u = nearest * record.knot_step_m;
  const double curvature = record.curvature_per_m + record.curvature_rate_per_m2 * u;
  const ClothoidKnot end = walk_clothoid(knot, curvature, record.curvature_rate_per_m2, ds - u);
  return {end.position_m, end.direction, record.curvature_per_m + record.curvature_rate_per_m2 * ds};
}

/// The parameter at ds: cubic Hermite interpolation between two knots.
double parameter_at(const PlanCurve& curve, const PlanRecord& record, double ds) {
  const double x = ds / record.knot_step_m;
  const double index = std::clamp(std::floor(x), 0.0, static_cast<double>(record.knot_count - 2));
  const CubicKnot* knot = &curve.cubic_knots[record.first_knot + static_cast<std::uint32_t>(index)];
  const double h = record.knot_step_m, w = x - index;
  const double rise = knot[1].parameter - knot[0].parameter;
  const double m0 = knot[0].parameter_per_m * h, m1 = knot[1].parameter_per_m * h;
  return knot[0].parameter + w * (m0 + w * (3.0 * rise - 2.0 * m0 - m1 + w * (m0 + m1 - 2.0 * rise)));
}

PlanPoint evaluate_cubic(const PlanCurve& curve, const PlanRecord& record, double ds) {
  const CubicCurve& cubic = record.cubic;
  const double p = parameter_at(curve, record, ds);
  const Vec2 left = left_of(record.direction);
  const double du = derivative(cubic.u, p), dv = derivative(cubic.v, p);
  const double norm = std::sqrt(du * du + dv * dv);
  const double bend = du * second_derivative(cubic.v, p) - dv * second_derivative(cubic.u, p);
  return {record.start_m + polynomial(cubic.u, p) * record.direction + polynomial(cubic.v, p) * left,
          (du * record.direction + dv * left) / norm, bend / (norm * norm * norm)};
}

/// Parameters and cumulative arc lengths at even steps of the parameter.
struct ArcLengthTable {
  std::vector<double> parameter, length_m;
};

Expected<ArcLengthTable> tabulate(const CubicCurve& cubic, double parameter_end, std::size_t steps) {
  ArcLengthTable table{{0.0}, {0.0}};
  table.parameter.reserve(steps + 1);
  table.length_m.reserve(steps + 1);
  for (std::size_t i = 0; i < steps; ++i) {
    const double p0 = parameter_end * static_cast<double>(i) / static_cast<double>(steps);
    const double p1 = parameter_end * static_cast<double>(i + 1) / static_cast<double>(steps);
    const double step = arc_length(cubic, p0, p1);
    const double slowest = std::min(speed(cubic, p0), speed(cubic, p1));
    if (!(slowest * parameter_end > 1e-6) || !std::isfinite(step) || step > 1e7) {
      return failure("the cubic curve stands still or runs off to infinity", "",
                     "give coefficients whose derivative is never 0 within the record");
    }
    table.parameter.push_back(p1);
    table.length_m.push_back(table.length_m.back() + step);
  }
  return table;
}

/// The parameter at which the curve is `length_m` long, by Newton's method from the table.
double invert(const CubicCurve& cubic, const ArcLengthTable& table, double length_m) {
  const auto after = std::upper_bound(table.length_m.begin() + 1, table.length_m.end() - 1, length_m);
  const auto i = static_cast<std::size_t>(after - table.length_m.begin()) - 1;
  const double p0 = table.parameter[i], p1 = table.parameter[i + 1];
  double p = p0 + (p1 - p0) * (length_m - table.length_m[i]) / (table.length_m[i + 1] - table.length_m[i]);
  for (int iteration = 0; iteration < 3; ++iteration) {
    const double error = table.length_m[i] + arc_length(cubic, p0, p) - length_m;
    p = std::clamp(p - error / speed(cubic, p), p0, p1);
  }
  return p;
}

}  // namespace

Expected<void> append_clothoid(PlanCurve& curve, const PlanStart& start, double curvature_start_per_m,
                               double curvature_end_per_m) {
  PlanRecord record = record_from(start);
  const double sharpest = std::max(std::abs(curvature_start_per_m), std::abs(curvature_end_per_m));
  const double turn = sharpest * start.length_m;
  if (!(turn <= max_turn_rad)) {
    return failure(fmt::format("the curve turns through up to {:.6g} rad", turn), "",
                   fmt::format("keep curvature times length below {}", max_turn_rad));
  }
  if (sharpest == 0.0) {
    curve.records.push_back(record);
    return {};
  }
  record.kind = PlanKind::clothoid;
  record.curvature_per_m = curvature_start_per_m;
  record.curvature_rate_per_m2 = (curvature_end_per_m - curvature_start_per_m) / start.length_m;
  record.first_knot = static_cast<std::uint32_t>(curve.clothoid_knots.size());
  record.knot_count = static_cast<std::uint32_t>(std::max(1.0, std::ceil(turn / max_turn_per_knot_rad)));
  record.knot_step_m = start.length_m / record.knot_count;
  ClothoidKnot knot{record.start_m, record.direction};
  for (std::uint32_t i = 0; i < record.knot_count; ++i) {
    curve.clothoid_knots.push_back(knot);
    const double curvature = record.curvature_per_m + record.curvature_rate_per_m2 * i * record.knot_step_m;
    knot = walk_clothoid(knot, curvature, record.curvature_rate_per_m2, record.knot_step_m);
    knot.direction = glm::normalize(knot.direction);
  }
  curve.records.push_back(record);
  return {};
}

Expected<void> append_cubic(PlanCurve& curve, const PlanStart& start, const CubicCurve& cubic, CubicRange range) {
  PlanRecord record = record_from(start);
  record.kind = PlanKind::cubic;
  record.cubic = cubic;
  const std::size_t steps = std::clamp(static_cast<std::size_t>(std::min(start.length_m / cubic_knot_spacing_m, 1e6)),
                                       min_cubic_knots, max_cubic_knots);
  // As a function of u a curve of some length reaches no farther than that in u.
  const double parameter_end = range == CubicRange::normalized ? 1.0 : start.length_m;
  const auto table = tabulate(cubic, parameter_end, steps);
  if (!table) return tl::unexpected(table.error());
  const double stretch = range == CubicRange::abscissa ? 1.0 : table->length_m.back() / start.length_m;

  record.first_knot = static_cast<std::uint32_t>(curve.cubic_knots.size());
  record.knot_count = static_cast<std::uint32_t>(steps + 1);
  record.knot_step_m = start.length_m / static_cast<double>(steps);
  for (std::size_t i = 0; i <= steps; ++i) {
    const double p = invert(cubic, *table, stretch * record.knot_step_m * static_cast<double>(i));
    curve.cubic_knots.push_back({p, stretch / speed(cubic, p)});
  }
  curve.records.push_back(record);
  return {};
}

PlanPoint evaluate_plan(const PlanCurve& curve, double s_m) {
  SEPTET_CHECK(!curve.records.empty(), "a reference line without geometry");
  const PlanRecord& record = curve.records[record_at(curve.records, s_m)];
  // Written so that a NaN becomes the start of the record and never an index.
  const double ds = s_m > record.s_m ? std::min(s_m - record.s_m, record.length_m) : 0.0;
  switch (record.kind) {
    case PlanKind::line:
      return {record.start_m + ds * record.direction, record.direction, 0.0};
    case PlanKind::clothoid:
      return evaluate_clothoid(curve, record, ds);
    case PlanKind::cubic:
      break;
  }
  return evaluate_cubic(curve, record, ds);
}

}  // namespace septet::road
