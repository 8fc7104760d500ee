#include "command-line/command/manoeuvre_files.hpp"

#include <iterator>

#include <fmt/core.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "engine/document/chart_page.hpp"
#include "engine/document/figure_text.hpp"
#include "engine/math/angle_units.hpp"

namespace septet::server {
namespace {

using vehicle::ManoeuvreReport;
using vehicle::ManoeuvreSample;

struct Quantity {
  const char* label;
  double (*of)(const ManoeuvreSample&);
};

constexpr Quantity time_axis{"time, s", [](const ManoeuvreSample& s) { return s.time_s; }};
constexpr Quantity way_axis{"way ahead, m", [](const ManoeuvreSample& s) { return s.x_m; }};
constexpr Quantity steer{"road wheels, deg", [](const ManoeuvreSample& s) { return s.steer_rad * degrees_per_radian; }};
constexpr Quantity yaw_rate{"yaw rate, deg/s",
                            [](const ManoeuvreSample& s) { return s.yaw_rate_radps * degrees_per_radian; }};
constexpr Quantity lateral{"lateral acceleration, m/s²",
                           [](const ManoeuvreSample& s) { return s.lateral_acceleration_mps2; }};
constexpr Quantity longitudinal{"longitudinal acceleration, m/s²",
                                [](const ManoeuvreSample& s) { return s.longitudinal_acceleration_mps2; }};
constexpr Quantity sideslip{"sideslip, deg",
                            [](const ManoeuvreSample& s) { return s.sideslip_rad * degrees_per_radian; }};
constexpr Quantity roll{"roll, deg", [](const ManoeuvreSample& s) { return s.roll_rad * degrees_per_radian; }};
constexpr Quantity torque{"hand wheel torque, N m", [](const ManoeuvreSample& s) { return s.steering_torque_nm; }};
constexpr Quantity speed{"speed, km/h", [](const ManoeuvreSample& s) { return s.speed_mps * 3.6; }};
constexpr Quantity aside{"way aside, m", [](const ManoeuvreSample& s) { return s.y_m; }};
constexpr Quantity least_load{"least wheel load, kN",
                              [](const ManoeuvreSample& s) { return s.least_wheel_load_n / 1000.0; }};

struct Panel {
  Quantity x, y;
};

std::vector<Panel> panels_of(const std::string& manoeuvre) {
  if (manoeuvre == "steady-circle") return {{lateral, steer}, {lateral, sideslip}, {lateral, roll}, {lateral, torque}};
  if (manoeuvre == "double-lane-change")
    return {{way_axis, aside}, {time_axis, steer}, {time_axis, lateral}, {time_axis, yaw_rate}};
  if (manoeuvre == "stop" || manoeuvre == "coast-down" || manoeuvre == "acceleration")
    return {{time_axis, speed}, {time_axis, longitudinal}, {time_axis, way_axis}, {time_axis, least_load}};
  return {{time_axis, steer}, {time_axis, yaw_rate}, {time_axis, lateral}, {time_axis, sideslip}};
}

}  // namespace

std::string figures_json(const std::string& vehicle, const ManoeuvreReport& report) {
  return document::figures_json(
      {{"vehicle", vehicle}, {"manoeuvre", report.manoeuvre}, {"standard", report.standard}, {"faults", report.faults}},
      report.figures);
}

std::string series_csv(const ManoeuvreReport& report) {
  std::string text =
      "time_s,x_m,y_m,heading_rad,steer_rad,speed_mps,yaw_rate_radps,lateral_acceleration_mps2,"
      "longitudinal_acceleration_mps2,sideslip_rad,roll_rad,steering_torque_nm,least_wheel_load_"
      "n\n";
  auto out = std::back_inserter(text);
  for (const ManoeuvreSample& s : report.series)
    fmt::format_to(out,
                   "{:.3f},{:.4f},{:.4f},{:.6f},{:.6f},{:.5f},{:.6f},{:.5f},{:.5f},{:.6f},{:.6f},{:"
                   ".4f},{:.1f}\n",
                   s.time_s, s.x_m, s.y_m, s.heading_rad, s.steer_rad, s.speed_mps, s.yaw_rate_radps,
                   s.lateral_acceleration_mps2, s.longitudinal_acceleration_mps2, s.sideslip_rad, s.roll_rad,
                   s.steering_torque_nm, s.least_wheel_load_n);
  return text;
}

std::string manoeuvre_svg(const std::string& vehicle, const ManoeuvreReport& report) {
  document::ChartPage page{.title = fmt::format("{}: {}", vehicle, report.manoeuvre),
                           .lines = {report.standard},
                           .charts = {},
                           .notes = document::figure_notes(report.figures)};
  for (const Panel& panel : panels_of(report.manoeuvre)) {
    document::Series series;
    for (const ManoeuvreSample& sample : report.series)
      series.points.push_back({panel.x.of(sample), panel.y.of(sample)});
    document::LineChart& chart = page.charts.emplace_back();
    chart.x_label = panel.x.label;
    chart.y_label = panel.y.label;
    chart.series = {std::move(series)};
  }
  return document::to_svg(page);
}

}  // namespace septet::server
