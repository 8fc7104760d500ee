#include "logging/study/report/measure_json.hpp"

#include <nlohmann/json.hpp>

#include "logging/study/report/measure_list.hpp"

namespace septet::logging {

document::Json measures_json(const DriveMeasures& measures, const MeasureSettings& settings) {
  document::Json json = document::Json::object();
  for (const ListedMeasure& measure : list_measures(measures, settings))
    json[measure.key] = {{"value", measure.value ? document::number(*measure.value) : document::Json(nullptr)},
                         {"unit", measure.unit},
                         {"samples", measure.samples},
                         {"missing", measure.missing},
                         {"definition", measure.definition}};
  return json;
}

}  // namespace septet::logging
