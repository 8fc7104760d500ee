#include "engine/simulation/given_motion.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include <fmt/core.h>
#include <glm/geometric.hpp>

#include "engine/core/printable.hpp"
#include "engine/document/table_line.hpp"
#include "engine/math/angle_units.hpp"
#include "engine/math/gravity.hpp"
#include "engine/math/speed_units.hpp"

namespace septet::simulation {
namespace {

constexpr std::size_t most_rows = 100'000, most_named = 5;
constexpr double least_row_s = 1e-3, most_intervals = 1.5;
/// Slower than this a path has no direction.
constexpr double directed_mps = 0.1;

struct Column {
  std::string_view name;
  double MotionValues::*value = nullptr;
  double unit = 1.0;  ///< Of the column, in the member's.
  double most = 1e7;  ///< Of the column, either way.
};
constexpr std::array<Column, 8> columns{{
    {"time_s", &MotionValues::time_s, 1.0, 1e6},
    {"x_m", &MotionValues::x_m},
    {"y_m", &MotionValues::y_m},
    {"heading_deg", &MotionValues::heading_rad, 1.0 / degrees_per_radian, 1e6},
    {"speed_mps", &MotionValues::speed_mps, 1.0, 120.0},
    {"speed_kmh", &MotionValues::speed_mps, 1.0 / kmh_per_mps, 432.0},
    {"yaw_rate_radps", &MotionValues::yaw_rate_radps, 1.0, 20.0},
    {"yaw_rate_degps", &MotionValues::yaw_rate_radps, 1.0 / degrees_per_radian, 1200.0},
}};

struct ReadColumn {
  const Column* column = nullptr;
  bool is_plus_minus = false;
};

constexpr auto use_columns =
    "use time_s with x_m and y_m (heading_deg), or with speed_kmh or speed_mps (yaw_rate_degps or yaw_rate_radps); the "
    "± of a column is NAME_pm";

Expected<std::vector<ReadColumn>> read_columns(const std::vector<std::string_view>& cells, const std::string& where) {
  std::vector<ReadColumn> read;
  for (std::string_view cell : cells) {
    ReadColumn one;
    if (cell.ends_with("_pm")) {
      one.is_plus_minus = true;
      cell.remove_suffix(3);
    }
    const auto found = std::ranges::find(columns, cell, &Column::name);
    if (found == columns.end())
      return failure(fmt::format("\"{}\" is no column", printable(cell)), where,
                     cells.size() == 1 && cell.find_first_of(";\t") != std::string_view::npos
                         ? "set commas between the columns, and points before the decimals"
                         : use_columns);
    one.column = &*found;
    for (const ReadColumn& other : read)
      if (other.column->value == one.column->value && other.is_plus_minus == one.is_plus_minus)
        return failure(fmt::format("the column {} comes twice", printable(cell)), where, use_columns);
    read.push_back(one);
  }
  const auto has = [&](double MotionValues::*value) {
    return std::ranges::any_of(read,
                               [&](const ReadColumn& one) { return one.column->value == value && !one.is_plus_minus; });
  };
  for (const ReadColumn& one : read)
    if (one.is_plus_minus && !has(one.column->value))
      return failure(fmt::format("{}_pm is the ± of a column that is not there", one.column->name), where, use_columns);
  const bool is_path = has(&MotionValues::x_m) && has(&MotionValues::y_m);
  if (!has(&MotionValues::time_s) || is_path == has(&MotionValues::speed_mps))
    return failure("the columns make neither a path nor a table of speeds", where, use_columns);
  return read;
}

double wrapped(double angle_rad) { return std::remainder(angle_rad, 2.0 * std::numbers::pi); }

/// Slopes of a path at its rows, by the parabola through each row and its neighbours.
void lay_path(GivenMotion& motion) {
  auto& rows = motion.rows;
  const std::size_t last = rows.size() - 1;
  for (MotionRow& row : rows) row.place_m = {row.value.x_m, row.value.y_m};
  const auto step = [&](std::size_t i) { return rows[i + 1].value.time_s - rows[i].value.time_s; };
  const auto slope = [&](std::size_t i) { return (rows[i + 1].place_m - rows[i].place_m) / step(i); };
  for (std::size_t i = 0; i <= last; ++i) {
    if (last == 1) {
      rows[i].velocity_mps = slope(0);
    } else if (i == 0 || i == last) {
      const std::size_t a = i == 0 ? 0 : last - 1, b = i == 0 ? 1 : last - 2;
      rows[i].velocity_mps = slope(a) + (slope(a) - slope(b)) * (step(a) / (step(a) + step(b)));
    } else {
      rows[i].velocity_mps = (slope(i - 1) * step(i) + slope(i) * step(i - 1)) / (step(i - 1) + step(i));
    }
  }
  double heading_rad = rows[0].value.heading_rad;
  if (!motion.has_heading)
    for (const MotionRow& row : rows)
      if (glm::length(row.velocity_mps) > directed_mps) {
        heading_rad = std::atan2(row.velocity_mps.y, row.velocity_mps.x);
        break;
      }
  for (MotionRow& row : rows) {
    double next_rad = row.value.heading_rad;
    if (!motion.has_heading)
      next_rad = glm::length(row.velocity_mps) > directed_mps ? std::atan2(row.velocity_mps.y, row.velocity_mps.x)
                                                              : heading_rad;
    heading_rad += wrapped(next_rad - heading_rad);
    row.heading_rad = heading_rad;
  }
}

/// Motion of an EDR table at a time after a row, from the row's place: speed and yaw rate linear, and so the heading
/// quadratic; the place by Simpson's rule.
PlanMotion integrated(const MotionRow& from, double speed_mps2, double yaw_radps2, double after_s) {
  constexpr int panels = 8;
  const auto heading = [&](double s) {
    return from.heading_rad + from.value.yaw_rate_radps * s + 0.5 * yaw_radps2 * s * s;
  };
  const auto velocity = [&](double s) {
    return (from.value.speed_mps + speed_mps2 * s) * Vec2(std::cos(heading(s)), std::sin(heading(s)));
  };
  Vec2 way{0.0};
  const double panel_s = after_s / panels;
  for (int i = 0; i < panels; ++i) {
    const double s = i * panel_s;
    way += panel_s / 6.0 * (velocity(s) + 4.0 * velocity(s + 0.5 * panel_s) + velocity(s + panel_s));
  }
  return {from.place_m + way, velocity(after_s), heading(after_s), from.value.yaw_rate_radps + yaw_radps2 * after_s};
}

void lay_speeds(GivenMotion& motion) {
  auto& rows = motion.rows;
  rows[0].place_m = Vec2(0.0);
  rows[0].heading_rad = 0.0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    rows[i].velocity_mps = rows[i].value.speed_mps * Vec2(std::cos(rows[i].heading_rad), std::sin(rows[i].heading_rad));
    rows[i].yaw_rate_radps = rows[i].value.yaw_rate_radps;
    if (i + 1 == rows.size()) break;
    const double step_s = rows[i + 1].value.time_s - rows[i].value.time_s;
    const PlanMotion next =
        integrated(rows[i], (rows[i + 1].value.speed_mps - rows[i].value.speed_mps) / step_s,
                   (rows[i + 1].value.yaw_rate_radps - rows[i].value.yaw_rate_radps) / step_s, step_s);
    rows[i + 1].place_m = next.place_m;
    rows[i + 1].heading_rad = next.heading_rad;
  }
}

void lay(GivenMotion& motion) {
  if (motion.is_path)
    lay_path(motion);
  else
    lay_speeds(motion);
}

/// Acceleration from a row to the next, over gravity.
double acceleration_g(const GivenMotion& motion, std::size_t i) {
  const MotionRow &a = motion.rows[i], &b = motion.rows[i + 1];
  const double step_s = b.value.time_s - a.value.time_s;
  if (motion.is_path) return glm::length(b.velocity_mps - a.velocity_mps) / step_s / gravity_mps2;
  const double along = (b.value.speed_mps - a.value.speed_mps) / step_s;
  const double across = std::max(std::abs(a.value.speed_mps * a.value.yaw_rate_radps),
                                 std::abs(b.value.speed_mps * b.value.yaw_rate_radps));
  return std::hypot(along, across) / gravity_mps2;
}

Expected<void> check_possible(const GivenMotion& motion, std::string_view name) {
  std::string lines;
  std::size_t impossible = 0;
  for (std::size_t i = 0; i + 1 < motion.rows.size(); ++i) {
    const double g = acceleration_g(motion, i);
    if (g <= most_tyre_acceleration_g) continue;
    if (++impossible <= most_named)
      lines += fmt::format("{}line {} ({:.1f} g)", lines.empty() ? "" : ", ", motion.rows[i + 1].line, g);
  }
  if (impossible == 0) return {};
  if (impossible > most_named) lines += fmt::format(" and {} more", impossible - most_named);
  return failure(fmt::format("no tyre gives more than {:.1f} g: {}", most_tyre_acceleration_g, lines),
                 std::string(name),
                 "end the table before the contact, from where on the car is free, or mend the rows");
}

/// A recorder writes at even times: an interval longer than `most_intervals` of the median one lacks rows.
Expected<void> check_whole(const GivenMotion& motion, std::string_view name) {
  if (motion.is_path) return {};
  const auto interval_s = [&](std::size_t i) { return motion.rows[i + 1].value.time_s - motion.rows[i].value.time_s; };
  std::vector<double> intervals_s;
  intervals_s.reserve(motion.rows.size() - 1);
  for (std::size_t i = 0; i + 1 < motion.rows.size(); ++i) intervals_s.push_back(interval_s(i));
  // The lower middle: of two intervals the shorter one is the recorder's.
  const auto middle = intervals_s.begin() + static_cast<std::ptrdiff_t>((intervals_s.size() - 1) / 2);
  std::ranges::nth_element(intervals_s, middle);
  for (std::size_t i = 0; i + 1 < motion.rows.size(); ++i)
    if (interval_s(i) > most_intervals * *middle + least_row_s)
      return failure(
          fmt::format("rows are missing: {:g} s from line {} to line {}, where most rows follow after {:g} s",
                      interval_s(i), motion.rows[i].line, motion.rows[i + 1].line, *middle),
          std::string(name), "add them, such as by values between the two with a ± of their own");
  return {};
}

}  // namespace

Expected<GivenMotion> read_motion(std::string_view text, std::string_view name) {
  std::vector<ReadColumn> header;
  GivenMotion motion;
  document::TableLines lines(text);
  while (const auto line = lines.next()) {
    const std::string where = fmt::format("{}:{}", name, line->number);
    const auto& cells = line->cells;
    if (header.empty()) {
      auto read = read_columns(cells, where);
      if (!read) return tl::unexpected(read.error());
      header = std::move(*read);
      for (const ReadColumn& one : header) {
        motion.is_path |= one.column->value == &MotionValues::x_m;
        motion.has_heading |= one.column->value == &MotionValues::heading_rad && !one.is_plus_minus;
      }
      continue;
    }
    if (cells.size() != header.size())
      return failure(fmt::format("{} numbers for {} columns", cells.size(), header.size()), where,
                     "give each column one");
    MotionRow row{.line = line->number};
    for (std::size_t i = 0; i < cells.size(); ++i) {
      const Column& column = *header[i].column;
      const auto value = document::number_in<double>(cells[i]);
      const double least = header[i].is_plus_minus ? 0.0 : -column.most;
      if (!value || !(*value >= least && *value <= column.most))
        return failure(
            fmt::format("{}{} is \"{}\"", column.name, header[i].is_plus_minus ? "_pm" : "", printable(cells[i])),
            where, fmt::format("give a number from {:g} to {:g}", least, column.most));
      MotionValues& values = header[i].is_plus_minus ? row.plus_minus : row.value;
      values.*column.value = *value * column.unit;
    }
    if (!motion.rows.empty() && row.value.time_s < motion.rows.back().value.time_s + least_row_s)
      return failure(fmt::format("time_s {} follows {}", row.value.time_s, motion.rows.back().value.time_s), where,
                     "give ascending times, a millisecond apart at least");
    if (motion.rows.size() == most_rows)
      return failure(fmt::format("has more than {} rows", most_rows), where, "give fewer");
    motion.rows.push_back(row);
  }
  if (motion.rows.size() < 2)
    return failure("has fewer than two rows of motion", std::string(name),
                   "name the columns in the first line, then give one line for each time");
  const double first_s = motion.rows.front().value.time_s;
  for (MotionRow& row : motion.rows) row.value.time_s -= first_s;
  if (auto whole = check_whole(motion, name); !whole) return tl::unexpected(whole.error());
  lay(motion);
  if (auto possible = check_possible(motion, name); !possible) return tl::unexpected(possible.error());
  return motion;
}

PlanMotion motion_at(const GivenMotion& motion, double time_s) {
  const auto& rows = motion.rows;
  const MotionRow &first = rows.front(), &last = rows.back();
  for (const MotionRow* end : {&first, &last}) {
    const double beyond_s = time_s - end->value.time_s;
    if (end == &first ? beyond_s < 0.0 : beyond_s >= 0.0)
      return {end->place_m + beyond_s * end->velocity_mps, end->velocity_mps, end->heading_rad, 0.0};
  }
  const auto after = std::ranges::upper_bound(rows, time_s, {}, [](const MotionRow& row) { return row.value.time_s; });
  const MotionRow &a = *std::prev(after), &b = *after;
  const double step_s = b.value.time_s - a.value.time_s, after_s = time_s - a.value.time_s;
  if (!motion.is_path)
    return integrated(a, (b.value.speed_mps - a.value.speed_mps) / step_s,
                      (b.value.yaw_rate_radps - a.value.yaw_rate_radps) / step_s, after_s);
  const double u = after_s / step_s;
  const Vec2 va = step_s * a.velocity_mps, vb = step_s * b.velocity_mps, way = b.place_m - a.place_m;
  const Vec2 square = 3.0 * way - 2.0 * va - vb, cube = va + vb - 2.0 * way;
  PlanMotion now;
  now.place_m = a.place_m + u * (va + u * (square + u * cube));
  now.velocity_mps = (va + u * (2.0 * square + u * 3.0 * cube)) / step_s;
  now.yaw_rate_radps = (b.heading_rad - a.heading_rad) / step_s;
  now.heading_rad = a.heading_rad + u * (b.heading_rad - a.heading_rad);
  if (!motion.has_heading && glm::length(now.velocity_mps) > directed_mps) {
    // Along the path itself, which bends between its rows.
    now.heading_rad += wrapped(std::atan2(now.velocity_mps.y, now.velocity_mps.x) - now.heading_rad);
    const Vec2 acceleration = (2.0 * square + 6.0 * u * cube) / (step_s * step_s);
    now.yaw_rate_radps = (now.velocity_mps.x * acceleration.y - now.velocity_mps.y * acceleration.x) /
                         glm::dot(now.velocity_mps, now.velocity_mps);
  }
  return now;
}

GivenMotion deviating(const GivenMotion& motion, const MotionDeviation& deviation) {
  GivenMotion other = motion;
  for (MotionRow& row : other.rows)
    for (const Column& column : columns) {
      if (column.name == "speed_kmh" || column.name == "yaw_rate_degps") continue;  // The same members once more.
      row.value.*column.value += deviation.share.*column.value * row.plus_minus.*column.value;
    }
  // Rows keep their order, however large the ± of their times.
  for (std::size_t i = 1; i < other.rows.size(); ++i)
    other.rows[i].value.time_s = std::max(other.rows[i].value.time_s, other.rows[i - 1].value.time_s + least_row_s);
  lay(other);
  return other;
}

}  // namespace septet::simulation
