#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "engine/document/chart_page.hpp"
#include "engine/document/text_file.hpp"
#include "engine/math/incremental_turn.hpp"
#include "tests/benchmarks/figures/motion_figures.hpp"

namespace septet::figures {
namespace {

using document::Range;
using document::Series;
using document::Stroke;

constexpr double theta_rad = 1.4;
constexpr std::size_t steps = 14;

/// Unit vectors of all steps, as dots on their arc.
document::LineChart arc(double sigma, const std::string& figure) {
  document::LineChart chart;
  chart.title = fmt::format("{}: σ = {}", figure, sigma);
  chart.x_label = "x", chart.y_label = "y";
  auto turn =
      *IncrementalTurn<double, 2>::between({1.0, 0.0}, {std::cos(theta_rad), std::sin(theta_rad)}, steps, sigma);
  Series dots{"steps", {}, Stroke::dots}, circle{"", {}, Stroke::line};
  for (std::size_t n = 0; n <= steps; ++n, turn.advance()) dots.points.push_back({turn.value()[0], turn.value()[1]});
  for (int n = 0; n <= 100; ++n)
    circle.points.push_back({std::cos(theta_rad * n / 100.0), std::sin(theta_rad * n / 100.0)});
  chart.series = {circle, dots};
  chart.x = Range{0.0, 1.05}, chart.y = Range{0.0, 1.05};
  return chart;
}

}  // namespace

Expected<void> draw_turns(const std::filesystem::path& folder) {
  const document::ChartPage page{
      .title = "Turning step by step with a quadratic angle",
      .lines = {"Paper: the step's angle grows evenly with σ = 1 and half as much with σ = 0.5; near 0 it is SLERP.",
                "Here: IncrementalTurn, no trigonometry in the loop; σ below 0 slows down."},
      .charts = {arc(1.0, "Figure 1"), arc(0.5, "Figure 2"), arc(0.0, "Figure 3"), arc(-1.0, "Slowing down")},
      .notes = {}};
  return document::write_text_file(folder / "turning.svg", document::to_svg(page));
}

}  // namespace septet::figures
