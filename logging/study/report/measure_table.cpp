#include "logging/study/report/measure_table.hpp"

#include <algorithm>
#include <functional>
#include <set>

#include <fmt/core.h>

#include "engine/document/markup.hpp"
#include "logging/study/report/measure_list.hpp"

namespace septet::logging {
namespace {

using document::escaped;

class Rows {
 public:
  void add(std::string_view name, const std::string& value, std::string_view definition) {
    html_ += fmt::format("<tr><td class=\"name\">{}</td><td class=\"value\">{}</td><td>{}</td></tr>\n", escaped(name),
                         escaped(value), escaped(definition));
  }
  const std::string& html() const { return html_; }

 private:
  std::string html_;
};

std::string seconds(const std::optional<double>& value, int decimals = 1) {
  return value ? fmt::format("{:.{}f} s", *value, decimals) : "–";
}

}  // namespace

std::string measure_table(const DriveMeasures& measures, const MeasureSettings& settings) {
  Rows rows;
  rows.add("Speed, mean", fmt::format("{:.1f} km/h", measures.speed_mean_mps * 3.6),
           "Over all samples, standing included.");
  rows.add("Speed, SD", fmt::format("{:.1f} km/h", measures.speed_sd_mps * 3.6), "Divides by N.");
  rows.add("Speed, largest", fmt::format("{:.1f} km/h", measures.speed_largest_mps * 3.6), "Largest sample.");

  const LateralPositionStatistics& position = measures.lateral_position;
  const bool kept_lane = position.samples > 0;
  const double exclude_s = settings.lateral_position.exclude_around_lane_change_s;
  rows.add("Lateral position, mean", kept_lane ? fmt::format("{:+.3f} m", position.mean_m) : "–",
           fmt::format("Positive to the left of the lane's centre. Reference point: the middle of "
                       "the front axle. {} samples; left out: {} within "
                       "{:g} s of a lane change, {} off every lane.",
                       position.samples, position.excluded_lane_change, exclude_s, position.excluded_off_lane));
  rows.add("Lateral position, SD", kept_lane ? fmt::format("{:.3f} m", position.sd_m) : "–",
           fmt::format("SDLP of the same samples, divides by N; {:.3f} m with N − 1.", position.sd_sample_m));

  const auto to_left =
      std::ranges::count_if(measures.lane_changes, [](const LaneChange& c) { return c.lanes_to_left > 0; });
  rows.add("Lane changes", measures.has_lanes() ? fmt::format("{}", measures.lane_changes.size()) : "–",
           fmt::format("{} to the left, {} to the right. Dated where the reference point crosses "
                       "the line; counted once it is {:g} m beyond.",
                       to_left, static_cast<long>(measures.lane_changes.size()) - to_left,
                       settings.lane_changes.hysteresis_m));
  rows.add("Time between lane changes", seconds(measures.between_lane_changes_s),
           "Simulated time over the number of lane changes.");

  std::string areas;
  for (const GlanceArea& area : measures.glance_areas)
    areas += fmt::format("{}{} {}", areas.empty() ? "" : ", ",
                         std::ranges::count(measures.glances, area.name, &Glance::area), area.name);
  rows.add("Mirror glances", measures.head_is_known ? fmt::format("{}", measures.glances.size()) : "not known",
           fmt::format("{}. From the head's heading at 10 Hz; at least {:g} s inside a mirror's area.", areas,
                       settings.glances.minimum_s));
  rows.add("Time between glances", seconds(measures.between_glances_s),
           "Simulated time over the number of mirror glances.");

  // Measures already in the rows above, in everyday units and in more detail.
  static const std::set<std::string, std::less<>> told{"duration_s",
                                                       "distance_m",
                                                       "speed_mean_mps",
                                                       "speed_sd_mps",
                                                       "speed_largest_mps",
                                                       "lateral_position_mean_m",
                                                       "lateral_position_sd_m",
                                                       "lane_changes",
                                                       "between_lane_changes_s",
                                                       "mirror_glances",
                                                       "between_glances_s"};
  for (const ListedMeasure& measure : list_measures(measures, settings)) {
    if (told.contains(measure.key)) continue;
    const std::string value = measure.value ? fmt::format("{:.4g}", *measure.value) : "–";
    const bool is_of_samples = measure.samples + measure.missing > 0;
    rows.add(measure.title, measure.value && !measure.unit.empty() ? value + ' ' + measure.unit : value,
             measure.definition +
                 (is_of_samples ? fmt::format(" N = {}, missing {}.", measure.samples, measure.missing) : ""));
  }
  return "<h2>Measures and what they "
         "mean</h2>\n<table><tr><th>Measure</th><th>Value</th><th>Definition</th></tr>\n" +
         rows.html() + "</table>\n";
}

}  // namespace septet::logging
