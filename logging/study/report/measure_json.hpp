#pragma once
/// The measures of a drive as JSON: key → value, unit, samples, missing, definition.

#include "engine/document/json.hpp"
#include "logging/study/report/drive_measures.hpp"

namespace septet::logging {

document::Json measures_json(const DriveMeasures& measures, const MeasureSettings& settings);

}  // namespace septet::logging
