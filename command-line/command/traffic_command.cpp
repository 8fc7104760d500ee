#include "command-line/command/traffic_command.hpp"

#include <algorithm>
#include <iterator>
#include <optional>
#include <string>
#include <vector>

#include <fmt/core.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "engine/document/chart_page.hpp"
#include "engine/document/figure_text.hpp"
#include "engine/document/text_file.hpp"
#include "engine/traffic/fundamental_diagram.hpp"

namespace septet::server {
namespace {

using traffic::FlowPoint;

/// Per km and lane: closer where the flow turns.
constexpr double densities_per_km[] = {2, 5, 8, 10, 12, 14, 16, 18, 20, 22, 24, 27, 30, 35, 40, 50, 60, 75, 90, 110};
/// The plain car of the motorway's mix, for the theory beside the measurement.
const traffic::FollowingParameters plain_driver{32.0, 1.3, 1.5, 2.5, 2.0};
constexpr double plain_length_m = 4.6;

struct Diagram {
  std::vector<FlowPoint> measured, equilibrium;
  std::vector<Figure> figures;
};

const FlowPoint& most_flow(const std::vector<FlowPoint>& points) {
  return *std::ranges::max_element(points, {}, &FlowPoint::flow_per_h);
}

/// Range in which equal plain drivers are string-unstable; empty if they never are.
struct Unstable {
  double from_per_km = 0.0, to_per_km = 0.0;
};
std::optional<Unstable> unstable_densities() {
  std::optional<Unstable> found;
  for (double density = 2.0; density < 150.0; density += 0.5) {
    const double gap_m = 1000.0 / density - plain_length_m;
    if (traffic::idm_stability_margin(plain_driver, gap_m) >= 0.0) continue;
    if (!found) found = Unstable{density, density};
    found->to_per_km = density;
  }
  return found;
}

Diagram measure(const TrafficDiagramOptions& options) {
  traffic::RingOptions ring;
  ring.seed = options.seed;
  ring.lanes = options.lanes;
  Diagram diagram;
  diagram.measured = traffic::fundamental_diagram(ring, densities_per_km);
  for (double density = 2.0; density <= 110.0; density += 1.0)
    diagram.equilibrium.push_back(traffic::equilibrium_flow(plain_driver, plain_length_m, density));
  const FlowPoint &capacity = most_flow(diagram.measured), &ideal = most_flow(diagram.equilibrium);
  const FlowPoint& waves = *std::ranges::max_element(diagram.measured, {}, &FlowPoint::deviation_mps);
  diagram.figures = {{"capacity", capacity.flow_per_h, "vehicles/h/lane"},
                     {"density at capacity", capacity.density_per_km, "vehicles/km/lane"},
                     {"speed at capacity", capacity.speed_mps, "m/s"},
                     {"largest deviation", waves.deviation_mps, "m/s"},
                     {"at density", waves.density_per_km, "vehicles/km/lane"},
                     {"capacity, equal cars", ideal.flow_per_h, "vehicles/h/lane"}};
  if (const auto unstable = unstable_densities()) {
    diagram.figures.push_back({"waves grow from", unstable->from_per_km, "vehicles/km/lane"});
    diagram.figures.push_back({"waves grow up to", unstable->to_per_km, "vehicles/km/lane"});
  }
  return diagram;
}

std::string diagram_json(const TrafficDiagramOptions& options, const Diagram& diagram) {
  return document::figures_json({{"seed", options.seed}, {"lanes", options.lanes}}, diagram.figures);
}

std::string points_csv(const std::vector<FlowPoint>& points) {
  std::string text = "density_per_km,flow_per_h,speed_mps,deviation_mps\n";
  for (const FlowPoint& p : points)
    fmt::format_to(std::back_inserter(text), "{:.3f},{:.1f},{:.4f},{:.4f}\n", p.density_per_km, p.flow_per_h,
                   p.speed_mps, p.deviation_mps);
  return text;
}

std::string diagram_svg(const TrafficDiagramOptions& options, const Diagram& diagram) {
  const auto chart_of = [](const std::vector<FlowPoint>& points, const char* label, double FlowPoint::*value) {
    document::LineChart chart;
    chart.x_label = "density, vehicles/km/lane";
    chart.y_label = label;
    document::Series series;
    for (const FlowPoint& point : points) series.points.push_back({point.density_per_km, point.*value});
    chart.series = {std::move(series)};
    return chart;
  };
  return document::to_svg(document::ChartPage{
      .title = "Traffic: fundamental diagram",
      .lines = {fmt::format("Motorway mix on a ring of 4 km, {} lanes, seed {}", options.lanes, options.seed)},
      .charts = {chart_of(diagram.measured, "flow, vehicles/h/lane", &FlowPoint::flow_per_h),
                 chart_of(diagram.equilibrium, "flow of equal cars in equilibrium", &FlowPoint::flow_per_h),
                 chart_of(diagram.measured, "speed, m/s", &FlowPoint::speed_mps),
                 chart_of(diagram.measured, "deviation of speed, m/s", &FlowPoint::deviation_mps)},
      .notes = document::figure_notes(diagram.figures)});
}

}  // namespace

Expected<int> run_traffic_diagram(const TrafficDiagramOptions& options) {
  const Diagram diagram = measure(options);
  fmt::print("{:>18} {:>16} {:>10} {:>14}\n", "vehicles/km/lane", "vehicles/h/lane", "m/s", "deviation m/s");
  for (const FlowPoint& p : diagram.measured)
    fmt::print("{:>18.1f} {:>16.0f} {:>10.2f} {:>14.2f}\n", p.density_per_km, p.flow_per_h, p.speed_mps,
               p.deviation_mps);
  for (const Figure& figure : diagram.figures)
    fmt::print("  {:<38} {:>10.4g} {}\n", figure.name, figure.value, figure.unit);
  if (options.out.empty()) return 0;
  const auto written =
      document::write_text_files(options.out, {{"traffic-diagram.json", diagram_json(options, diagram)},
                                               {"traffic-diagram.csv", points_csv(diagram.measured)},
                                               {"traffic-diagram.svg", diagram_svg(options, diagram)}});
  if (!written) return tl::unexpected(written.error());
  return 0;
}

}  // namespace septet::server
