#include "logging/report/measure_table.hpp"

#include <algorithm>

#include <fmt/core.h>

#include "engine/document/markup.hpp"

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
  rows.add("Lane changes", fmt::format("{}", measures.lane_changes.size()),
           fmt::format("{} to the left, {} to the right. Dated where the reference point crosses "
                       "the line; counted once it is {:g} m beyond.",
                       to_left, static_cast<long>(measures.lane_changes.size()) - to_left,
                       settings.lane_changes.hysteresis_m));
  rows.add("Time between lane changes", seconds(measures.between_lane_changes_s),
           "Simulated time over the number of lane changes.");

  std::string areas;
  for (const GlanceArea& area : settings.glances.areas)
    areas += fmt::format("{}{} {}", areas.empty() ? "" : ", ",
                         std::ranges::count(measures.glances, area.name, &Glance::area), area.name);
  rows.add("Mirror glances", fmt::format("{}", measures.glances.size()),
           fmt::format("{}. From the head's heading at 10 Hz; at least {:g} s inside a mirror's area.", areas,
                       settings.glances.minimum_s));
  rows.add("Time between glances", seconds(measures.between_glances_s),
           "Simulated time over the number of mirror glances.");

  const auto headway = fmt::format(
      "Front bumper to front bumper over own speed (SAE J2944 time headway), above 1 m/s, while at "
      "most {:g} s: {:.1f} s of driving.",
      settings.longest_following_headway_s, measures.following_s);
  rows.add("Time headway, median", seconds(measures.time_headway_median_s, 2), headway);
  rows.add("Time headway, smallest", seconds(measures.time_headway_smallest_s, 2), "Of the same samples.");
  return "<h2>Measures and what they "
         "mean</h2>\n<table><tr><th>Measure</th><th>Value</th><th>Definition</th></tr>\n" +
         rows.html() + "</table>\n";
}

}  // namespace septet::logging
