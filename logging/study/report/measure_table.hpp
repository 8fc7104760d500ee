#pragma once
/// The table of measures: name, value, and the definition that makes the value comparable.

#include <string>

#include "logging/study/report/drive_measures.hpp"

namespace septet::logging {

std::string measure_table(const DriveMeasures& measures, const MeasureSettings& settings);

}  // namespace septet::logging
