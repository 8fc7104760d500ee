#include "engine/traffic/fundamental_diagram.hpp"

#include <algorithm>
#include <cmath>

#include "engine/traffic/ring.hpp"

namespace septet::traffic {
namespace {

constexpr double flow_per_h(double density_per_km, double speed_mps) { return density_per_km * speed_mps * 3.6; }

FlowPoint measure(const RingOptions& options, double density_per_km) {
  const auto network = ring_road(options.length_m, options.lanes);
  const double vehicles = density_per_km * options.length_m / 1000.0 * options.lanes;
  const auto count = static_cast<std::uint32_t>(std::max(1.0, std::round(vehicles)));
  TrafficState state = dense_ring(network, options.lanes, count, options.seed);
  const TrafficParameters parameters = motorway_traffic(0, options.length_m);
  Random random(options.seed);
  const auto drive = [&](double seconds, auto&& after_step) {
    for (double time = 0.0; time < seconds; time += options.step_s) {
      advance(parameters, network, {}, options.step_s, random, state);
      after_step(state.corridors[0]);
    }
  };
  drive(options.settling_s, [](const CorridorTraffic&) {});
  double number = 0.0, sum = 0.0, squares = 0.0;
  drive(options.measuring_s, [&](const CorridorTraffic& traffic) {
    for (const double speed : traffic.speed_mps) {
      number += 1.0;
      sum += speed;
      squares += speed * speed;
    }
  });
  FlowPoint point;
  point.density_per_km = count / (options.length_m / 1000.0 * options.lanes);
  point.speed_mps = sum / number;
  point.flow_per_h = flow_per_h(point.density_per_km, point.speed_mps);
  point.deviation_mps = std::sqrt(std::max(0.0, squares / number - point.speed_mps * point.speed_mps));
  return point;
}

}  // namespace

std::vector<FlowPoint> fundamental_diagram(const RingOptions& options, std::span<const double> densities_per_km) {
  std::vector<FlowPoint> points;
  for (const double density : densities_per_km) points.push_back(measure(options, density));
  return points;
}

FlowPoint equilibrium_flow(const FollowingParameters& driver, double vehicle_length_m, double density_per_km) {
  FlowPoint point;
  point.density_per_km = density_per_km;
  point.speed_mps = idm_equilibrium_speed(driver, 1000.0 / density_per_km - vehicle_length_m);
  point.flow_per_h = flow_per_h(density_per_km, point.speed_mps);
  return point;
}

}  // namespace septet::traffic
