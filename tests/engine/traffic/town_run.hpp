#pragma once
/// A town's traffic, driven and watched: who overlaps whom, who stands, who brakes how hard, who runs a red light.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>

#include "engine/traffic/network/town.hpp"
#include "engine/traffic/network/town_stages.hpp"
#include "engine/traffic/traffic.hpp"

namespace septet::traffic {

struct TownRun {
  std::uint32_t asked = 0, least_there = 0;
  std::set<std::pair<ParticipantId, ParticipantId>> overlaps;  ///< Pairs whose outlines lay over each other.
  double longest_stand_s = 0.0;
  double driven_m = 0.0, vehicle_s = 0.0;
  double hardest_braking_mps2 = 0.0;
  std::uint32_t hard_brakings = 0;  ///< Begun, above 4 m/s².
  double most_sideways_mps2 = 0.0;
  std::set<road::RoadIndex> roads;  ///< On which somebody was.
  std::uint32_t reds = 0;           ///< Stop lines passed while their light was red.
  std::uint32_t lit_lines = 0;      ///< Stop lines passed at a light that was lit.

  double mean_mps() const { return driven_m / std::max(vehicle_s, 1.0); }
};

/// True where the rectangles of two participants on the ground overlap, each `less_m` smaller at every side.
inline bool outlines_overlap(const Participant& a, const Participant& b, double less_m = 0.0) {
  const auto axes_of = [](const Participant& p) {
    const Vec3 x = p.world_from_vehicle.orientation * Vec3(1, 0, 0),
               y = p.world_from_vehicle.orientation * Vec3(0, 1, 0);
    return std::array<Vec2, 2>{glm::normalize(Vec2(x)), glm::normalize(Vec2(y))};
  };
  const auto middle_of = [&](const Participant& p, const Vec2& x) {
    return Vec2(p.world_from_vehicle.position_m) + vehicle_models()[p.model].centre_x_m() * x;
  };
  const auto axes_a = axes_of(a), axes_b = axes_of(b);
  const VehicleModel &model_a = vehicle_models()[a.model], &model_b = vehicle_models()[b.model];
  const Vec2 apart = middle_of(b, axes_b[0]) - middle_of(a, axes_a[0]);
  if (std::abs(a.world_from_vehicle.position_m.z - b.world_from_vehicle.position_m.z) > 3.0) return false;
  const auto reach = [&](const VehicleModel& model, const std::array<Vec2, 2>& axes, const Vec2& axis) {
    return (0.5 * model.length_m - less_m) * std::abs(glm::dot(axes[0], axis)) +
           (0.5 * model.width_m - less_m) * std::abs(glm::dot(axes[1], axis));
  };
  for (const Vec2& axis : {axes_a[0], axes_a[1], axes_b[0], axes_b[1]})
    if (std::abs(glm::dot(apart, axis)) > reach(model_a, axes_a, axis) + reach(model_b, axes_b, axis)) return false;
  return true;
}

/// Distance of a front from the stop line of the light that it comes to; none if it comes to no light on its way.
inline std::optional<double> before_light_m(const LaneGraph& graph, const TownVehicle& vehicle, WayIndex& on) {
  double begin_m = 0.0;
  for (const WayIndex index : vehicle.route) {
    const Way& way = graph.ways[index];
    begin_m += way.length_m;
    if (begin_m < vehicle.front_m) continue;
    on = index;
    if (!way.has_light) return std::nullopt;
    return begin_m - way.line_before_m - vehicle.front_m;
  }
  return std::nullopt;
}

/// The lights at a time; they are asked for each half second.
using LightsAt = std::function<std::vector<TrafficLight>(double)>;

/// Drives `seconds` of it. `watch` sees every half second.
inline TownRun run_town(const road::RoadNetwork& network, const LaneGraph& graph, const TrafficParameters& parameters,
                        double seconds, std::uint64_t seed, double dt_s, std::span<const ForeignVehicle> foreign = {},
                        const std::function<void(const TownState&, const std::vector<Participant>&)>& watch = {},
                        const LightsAt& lights_at = {}) {
  Random random(seed, 1);
  TownState town = populate_town(parameters, network, graph, foreign, random);
  TownRun run{parameters.count, parameters.count, {}, 0, 0, 0, 0, 0, 0, {}, 0, 0};
  std::vector<Participant> participants;
  std::map<ParticipantId, bool> brakes;
  std::vector<TrafficLight> lights;
  std::vector<LightState> states;
  std::map<ParticipantId, WayIndex> before_line;  ///< Who was before the line of a light a step ago, and of which way.
  const auto steps = static_cast<int>(seconds / dt_s), each = std::max(1, static_cast<int>(std::round(0.5 / dt_s)));
  for (int step = 0; step < steps; ++step) {
    if (lights_at && step % each == 0) lights = lights_at(town.time_s), states = light_states(network, lights);
    advance_town(parameters, network, graph, lights, foreign, dt_s, random, town);
    for (const TownVehicle& vehicle : town.vehicles) {
      if (vehicle.outside) {
        before_line.erase(vehicle.id);
        continue;
      }
      WayIndex on = no_way;
      const std::optional<double> line_m = before_light_m(graph, vehicle, on);
      const auto was = before_line.find(vehicle.id);
      if (was != before_line.end() && (!line_m || *line_m <= 0.0 || on != was->second)) {
        const Way& way = graph.ways[was->second];
        const LightState shown = states.empty() ? LightState::dark : states[2 * way.road + (way.along_s ? 0 : 1)];
        run.lit_lines += shown != LightState::dark;
        run.reds += shown == LightState::red;
        before_line.erase(was);
      }
      if (line_m && *line_m > 0.0) before_line[vehicle.id] = on;
      run.driven_m += vehicle.speed_mps * dt_s;
      run.vehicle_s += dt_s;
      run.longest_stand_s = std::max(run.longest_stand_s, vehicle.stands_s);
      const double braking = -vehicle.acceleration_mps2;
      run.hardest_braking_mps2 = std::max(run.hardest_braking_mps2, vehicle.speed_mps > 0.5 ? braking : 0.0);
      bool& is_hard = brakes[vehicle.id];
      const bool was_hard = std::exchange(is_hard, braking > 4.0 && vehicle.speed_mps > 0.5);
      run.hard_brakings += is_hard && !was_hard;
    }
    if (step % each != 0) continue;
    participants.clear();
    append_participants(graph, town, participants);
    run.least_there = std::min(run.least_there, static_cast<std::uint32_t>(participants.size()));
    for (const TownVehicle& vehicle : town.vehicles)
      if (!vehicle.outside) run.roads.insert(graph.ways[vehicle.route.front()].road);
    for (std::size_t i = 0; i < participants.size(); ++i) {
      const Participant& a = participants[i];
      const Vec3 left = a.world_from_vehicle.orientation * Vec3(0, 1, 0);
      run.most_sideways_mps2 = std::max(run.most_sideways_mps2, std::abs(glm::dot(a.acceleration_mps2, left)));
      for (std::size_t j = i + 1; j < participants.size(); ++j) {
        const Vec3 apart = a.world_from_vehicle.position_m - participants[j].world_from_vehicle.position_m;
        if (glm::dot(apart, apart) < 20.0 * 20.0 && outlines_overlap(a, participants[j]))
          run.overlaps.emplace(a.id, participants[j].id);
      }
    }
    if (watch) watch(town, participants);
  }
  return run;
}

}  // namespace septet::traffic
