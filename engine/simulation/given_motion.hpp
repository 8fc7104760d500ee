#pragma once
/// A motion of the driver's car that is known from outside, as an investigation has it: a path, or the table of an event
/// data recorder (EDR). Nobody drives: the car's plan follows the table, its springs the ground, until the table ends or
/// it touches something; from there on it is free, in neutral, and physics moves it.
///
/// The table is CSV; its first line names the columns, in any order:
///
///     time_s, x_m, y_m [, heading_deg]               a path of the car's origin (below the middle of the rear axle);
///                                                    without headings it looks along the path
///     time_s, speed_kmh|speed_mps [, yaw_rate_degps|yaw_rate_radps]
///                                                    an EDR table, from where the scenario puts the car
///
/// A column NAME may have a column NAME_pm beside it, its ± in the same unit. Time counts from the first row. Between
/// rows a path is a cubic with the rows' velocities, and speed and yaw rate are linear. Empty lines and comments (#)
/// are skipped.

#include <cstddef>
#include <string_view>
#include <vector>

#include "engine/core/expected.hpp"
#include "engine/math/rigid_transform.hpp"

namespace septet::simulation {

/// Each value of a row, or its ±.
struct MotionValues {
  double time_s = 0.0;
  double x_m = 0.0, y_m = 0.0, heading_rad = 0.0;  ///< Of a path; the heading without jumps from row to row.
  double speed_mps = 0.0, yaw_rate_radps = 0.0;    ///< Of an EDR table.
};

struct MotionRow {
  MotionValues value, plus_minus;
  std::size_t line = 0;  ///< In its file, from 1 on.
  /// Of the row: on a path its slope, by differences of its neighbours; of an EDR table what integrating to here gives,
  /// from a start at the origin along x.
  Vec2 place_m{0.0}, velocity_mps{0.0};
  double heading_rad = 0.0, yaw_rate_radps = 0.0;
};

struct GivenMotion {
  bool is_path = false;
  bool has_heading = false;     ///< Of a path: given, and not that of its slope.
  std::vector<MotionRow> rows;  ///< Ascending time; at least two.
  double end_s() const { return rows.back().value.time_s; }
};

/// A car in plan: of its origin, counter-clockwise from x. Of an EDR table against its start.
struct PlanMotion {
  Vec2 place_m{0.0}, velocity_mps{0.0};
  double heading_rad = 0.0, yaw_rate_radps = 0.0;
};

/// Largest acceleration that tyres give, over gravity: dry asphalt's 1.0 and the reading error of a table.
inline constexpr double most_tyre_acceleration_g = 1.1;

/// Error: the line, the fault and the remedy; rows that no tyre can bring about (beyond most_tyre_acceleration_g) are
/// named by their lines, and so is a gap in a recorder's table: an interval of more than 1.5 times the median one.
Expected<GivenMotion> read_motion(std::string_view text, std::string_view name);

/// The motion at a time; beyond the table's ends as if it went straight on.
PlanMotion motion_at(const GivenMotion& motion, double time_s);

/// How far a run departs from the table, each as a share of the rows' ±, −1 to 1: a recorder is wrong in the same way
/// in all of its rows.
struct MotionDeviation {
  MotionValues share;
};
GivenMotion deviating(const GivenMotion& motion, const MotionDeviation& deviation);

}  // namespace septet::simulation
