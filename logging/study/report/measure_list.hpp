#pragma once
/// Every measure of a drive as a line: key, unit, value, number of samples, and definition. Source of the tables, JSON
/// and CSV of one drive and of many.

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "logging/study/report/drive_measures.hpp"

namespace septet::logging {

struct ListedMeasure {
  std::string key;              ///< In columns and JSON, with its unit at the end: "tlc_trigonometric_smallest_s".
  std::string title;            ///< For people.
  std::string unit;             ///< "s", "m", "1/min", …; empty for a count or a share.
  std::optional<double> value;  ///< Empty if undefined: never 0 instead.
  std::size_t samples = 0;      ///< Samples used; for counts of events their number.
  std::size_t missing = 0;      ///< Possible samples without a value; they are not imputed.
  std::string definition;       ///< With source, clause and the options used.
};

/// Always the same keys in the same order.
std::vector<ListedMeasure> list_measures(const DriveMeasures& measures, const MeasureSettings& settings);

}  // namespace septet::logging
