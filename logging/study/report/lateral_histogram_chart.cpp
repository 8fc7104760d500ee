#include "logging/study/report/lateral_histogram_chart.hpp"

#include <fmt/core.h>

#include "engine/document/chart.hpp"

namespace septet::logging {

std::string lateral_histogram_svg(const LateralPositionHistogram& histogram, std::string_view title) {
  using Histogram = LateralPositionHistogram;
  // Mirrored, so that the left-hand line is at the left, as the driver sees it.
  document::BarChart chart{
      .title = std::string(title),
      .x_label = "offset from the lane's centre, in lane widths",
      .y_label = "% of samples",
      .bars = {},
      .x_low = 0.5,
      .x_high = -0.5,
      .x_ticks = {{0.5, "½ left line"}, {0.25, "¼"}, {0.0, "centre"}, {-0.25, "−¼"}, {-0.5, "right line −½"}},
      .level = document::Level{25.0, "the paper's centre bar: almost 25 %"}};
  for (std::size_t i = 0; i < Histogram::bins; ++i) {
    const double percent = 100.0 * histogram.fraction(i);
    chart.bars.push_back({Histogram::edge(i), Histogram::edge(i + 1), percent, i == Histogram::bins / 2,
                          fmt::format("{:+.3f} to {:+.3f}: {} samples, {:.1f} %", Histogram::edge(i),
                                      Histogram::edge(i + 1), histogram.counts[i], percent)});
  }
  return document::to_svg(chart);
}

}  // namespace septet::logging
