#pragma once
/// The reference line of a road in the plan (OpenDRIVE 1.8, §9): a chain of lines, arcs, spirals and cubic curves.
///
/// Everything is a function of s, the arc length. Lines, arcs and spirals are all clothoids κ(ds) = curvature +
/// curvature_rate·ds, integrated from knots that lie at most 1/8 rad of turning apart; cubic curves (poly3, paramPoly3)
/// carry a table from arc length to their parameter. So one evaluation costs tens of nanoseconds and calls no
/// transcendental function.
///
/// Units: metres, radians. Immutable after `append_*`; safe to read from many threads.

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/core/expected.hpp"
#include "engine/math/rigid_transform.hpp"

namespace septet::road {

enum class PlanKind : std::uint8_t { line, clothoid, cubic };

/// Start of a geometry record.
struct PlanStart {
  double s_m = 0.0;
  Vec2 position_m{0.0, 0.0};
  double heading_rad = 0.0;
  double length_m = 0.0;
};

/// u(p), v(p) of a cubic curve in the frame of its start: u along the start's heading, v to the left.
struct CubicCurve {
  std::array<double, 4> u{};
  std::array<double, 4> v{};
};

struct PlanRecord {
  double s_m = 0.0;
  double length_m = 0.0;
  PlanKind kind = PlanKind::line;
  Vec2 start_m{0.0, 0.0};
  Vec2 direction{1.0, 0.0};            ///< Unit tangent at the start (of the local u axis for a cubic curve).
  double curvature_per_m = 0.0;        ///< Clothoid: at the start.
  double curvature_rate_per_m2 = 0.0;  ///< Clothoid: dκ/ds.
  CubicCurve cubic;
  std::uint32_t first_knot = 0;  ///< In PlanCurve::clothoid_knots or ::cubic_knots; knots are evenly spaced in s.
  std::uint32_t knot_count = 0;
  double knot_step_m = 0.0;
};

struct ClothoidKnot {
  Vec2 position_m;
  Vec2 direction;
};

/// The cubic's parameter and its derivative by s at a knot.
struct CubicKnot {
  double parameter = 0.0;
  double parameter_per_m = 0.0;
};

struct PlanCurve {
  std::vector<PlanRecord> records;  ///< Sorted by s_m.
  std::vector<ClothoidKnot> clothoid_knots;
  std::vector<CubicKnot> cubic_knots;
};

struct PlanPoint {
  Vec2 position_m{0.0, 0.0};
  Vec2 direction{1.0, 0.0};      ///< Unit tangent towards increasing s.
  double curvature_per_m = 0.0;  ///< Positive turns left.
};

/// Range of a cubic curve's parameter along the record.
enum class CubicRange : std::uint8_t {
  arc_length,  ///< paramPoly3, pRange="arcLength": p from 0 to the record's length.
  normalized,  ///< paramPoly3, pRange="normalized": p from 0 to 1.
  abscissa,    ///< poly3: p = u, as far as the curve's length reaches the record's.
};

/// Appends a clothoid from `curvature_start_per_m` to `curvature_end_per_m`; both 0 is a line, both equal an arc. Error:
/// a record that turns through more than 1,000 rad.
Expected<void> append_clothoid(PlanCurve& curve, const PlanStart& start, double curvature_start_per_m,
                               double curvature_end_per_m);

/// Appends a cubic curve, run through by arc length in every range; paramPoly3 is stretched so that it is exactly the
/// record's length long. Error: a curve that stands still or whose length is not finite.
Expected<void> append_cubic(PlanCurve& curve, const PlanStart& start, const CubicCurve& cubic, CubicRange range);

/// The point at s, which is clamped to [0, end]; the curve must hold at least one record.
PlanPoint evaluate_plan(const PlanCurve& curve, double s_m);

}  // namespace septet::road
