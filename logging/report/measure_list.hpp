#pragma once
/// Every measure of a drive as a line of its own: key, unit, value, of how many samples, and what it means. What tables, JSON and
/// CSV of one drive and of many are made of.

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "logging/report/drive_measures.hpp"

namespace septet::logging {

struct ListedMeasure {
  std::string key;              ///< Of columns and JSON, with its unit at the end: "tlc_trigonometric_smallest_s".
  std::string title;            ///< For people.
  std::string unit;             ///< "s", "m", "1/min", …; empty for a count or a share.
  std::optional<double> value;  ///< Nothing where it is undefined: never 0 instead.
  std::size_t samples = 0;      ///< That it is made of; of counts of events their number.
  std::size_t missing = 0;      ///< That could have been, and have no value; they are not filled in.
  std::string definition;       ///< With source, clause and the options used.
};

/// Always the same keys in the same order.
std::vector<ListedMeasure> list_measures(const DriveMeasures& measures, const MeasureSettings& settings);

}  // namespace septet::logging
