#include "engine/traffic/lateral.hpp"

#include <algorithm>
#include <cmath>

namespace septet::traffic {
namespace {

/// Reduces a slope where a whole movement takes as long as before, and so more metres.
double gains_speed(const CorridorTraffic& traffic, std::size_t i, double slope) {
  const double speed = traffic.speed_mps[i];
  return slope * traffic.acceleration_mps2[i] / (speed * speed);
}

}  // namespace

double shortest_change_m(double length_m, Turning turning) {
  // A lorry's tail sweeps out as it turns in: it takes more of the road's length.
  const double at_ease_m = 10.0 + 3.0 * length_m;
  return turning == Turning::at_ease ? at_ease_m : std::max(13.5, 0.7 * at_ease_m);
}

double change_length_m(const CorridorTraffic& traffic, std::size_t i, double speed_mps) {
  return std::max(traffic.change_shortest_m[i], speed_mps * traffic.driver[i].lane_change.duration_s);
}

void begin_change(CorridorTraffic& traffic, std::size_t i, double offset_m, double slope, Turning turning) {
  traffic.change_part[i] = 0.0;
  traffic.change_shortest_m[i] = shortest_change_m(traffic.length_m[i], turning);
  traffic.change_offset_m[i] = offset_m;
  traffic.change_run_m[i] = slope * change_length_m(traffic, i, traffic.speed_mps[i]);
}

Lateral lateral(const CorridorTraffic& traffic, std::size_t i) {
  Lateral lateral{traffic.aside_m[i]};
  const double speed = traffic.speed_mps[i];
  const double away = traffic.aside_m[i] - traffic.aside_target_m[i];
  if (traffic.aside_mps[i] != 0.0 || away != 0.0) {
    // The critically damped shift of make_way.cpp, by the distance driven.
    const double by_way = 1.0 / std::max(speed, slowest_aside_mps);
    lateral.slope = traffic.aside_mps[i] * by_way;
    lateral.curvature_per_m = -(2.0 * traffic.aside_mps[i] + away / aside_time_s) / aside_time_s * by_way * by_way;
    if (speed > slowest_aside_mps) lateral.curvature_per_m -= gains_speed(traffic, i, lateral.slope);
  }
  const double u = traffic.change_part[i];
  if (u >= 1.0) return lateral;
  // Hermite: from an offset and a run (slope times length) to zero.
  const double begun = traffic.change_offset_m[i], run = traffic.change_run_m[i];
  const double rest = 1.0 - u, cube = rest * rest * rest;
  const double length = change_length_m(traffic, i, speed), by_way = 1.0 / length;
  lateral.offset_m += cube * (begun * (1.0 + u * (3.0 + 6.0 * u)) + run * u * (1.0 + 3.0 * u));
  const double slope = rest * rest * by_way * (run * (1.0 + u * (2.0 - 15.0 * u)) - begun * 30.0 * u * u);
  lateral.slope += slope;
  if (length > traffic.change_shortest_m[i]) lateral.curvature_per_m -= gains_speed(traffic, i, slope);
  lateral.curvature_per_m += rest * u * by_way * by_way * (run * (60.0 * u - 36.0) - begun * 60.0 * (1.0 - 2.0 * u));
  return lateral;
}

double to_line_m(const CorridorTraffic& traffic, std::size_t i) {
  return std::max(0.0, 0.5 * traffic.table.lane_width_m - traffic.half_width_m[i]);
}

Across across(const CorridorTraffic& traffic, std::size_t i) {
  const auto [offset, slope, curvature] = lateral(traffic, i);
  const VehicleModel& model = vehicle_models()[traffic.model[i]];
  return {-traffic.lane[i] * traffic.table.lane_width_m + offset + slope * model.centre_x_m(),
          traffic.half_width_m[i] + 0.5 * traffic.length_m[i] * std::abs(slope)};
}

Across across_then(const CorridorTraffic& traffic, std::size_t i) {
  return {-traffic.lane[i] * traffic.table.lane_width_m + traffic.aside_target_m[i], traffic.half_width_m[i]};
}

double lateral_m(const CorridorTraffic& traffic, std::size_t i) {
  return -traffic.lane[i] * traffic.table.lane_width_m + lateral(traffic, i).offset_m;
}

}  // namespace septet::traffic
