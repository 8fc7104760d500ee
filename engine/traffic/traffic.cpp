#include "engine/traffic/traffic.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/core/check.hpp"
#include "engine/traffic/traffic_stages.hpp"

namespace septet::traffic {

CorridorTraffic empty_corridor(const road::RoadNetwork& network, const road::LanePosition& through) {
  return empty_corridor(network, build_corridor(network, through));
}

CorridorTraffic empty_corridor(const road::RoadNetwork& network, const Corridor& corridor) {
  CorridorTraffic traffic;
  traffic.corridor = corridor;
  traffic.table = make_lane_table(network, traffic.corridor);
  traffic.line = make_line_table(network, traffic.corridor);
  traffic.ways = make_lane_ways(network, traffic.corridor, traffic.table, traffic.line);
  traffic.order.lanes.resize(traffic.table.open.size());
  traffic.order.has_straddlers.resize(traffic.table.open.size());
  return traffic;
}

void add_vehicle(CorridorTraffic& traffic, ParticipantId id, ModelIndex model, const Driver& driver, int lane,
                 double x_m, double speed_mps) {
  const VehicleModel& kind = vehicle_models()[model];
  SEPTET_CHECK(lane >= 0 && lane < static_cast<int>(traffic.order.lanes.size()), "lane {} of {}", lane,
               traffic.order.lanes.size());
  const std::size_t i = traffic.size();
  traffic.id.push_back(id);
  traffic.model.push_back(model);
  traffic.paint.push_back(static_cast<std::uint8_t>(id % 12));
  traffic.driver.push_back(driver);
  traffic.law.emplace_back(driver.following);
  traffic.x_m.push_back(x_m);
  traffic.rolled_m.push_back(x_m);
  traffic.speed_mps.push_back(speed_mps);
  for (auto* array :
       {&traffic.acceleration_mps2, &traffic.change_offset_m, &traffic.change_run_m, &traffic.next_decision_s,
        &traffic.aside_m, &traffic.aside_mps, &traffic.aside_target_m, &traffic.heard_s}) {
    array->push_back(0.0);
  }
  traffic.change_part.push_back(1.0);
  traffic.change_shortest_m.push_back(shortest_change_m(kind.length_m, Turning::at_ease));
  // Drivers take turns.
  traffic.next_decision_s.back() = 0.1 * static_cast<double>(id % 10);
  traffic.lane.push_back(static_cast<std::int16_t>(lane));
  traffic.from_lane.push_back(static_cast<std::int16_t>(lane));
  traffic.lane_end_m.push_back(lane > 0 ? lane_end_m(traffic.table, lane, x_m) : no_leader);
  traffic.length_m.push_back(kind.length_m);
  traffic.half_width_m.push_back(0.5 * kind.width_m);
  traffic.making_way.push_back(MakingWay::no);
  traffic.emergency.push_back(0);
  traffic.neighbour_hints.push_back({});
  if (lane > 0) insert_entry(traffic.order.lanes[static_cast<std::size_t>(lane)], entry_of(traffic, i));
}

namespace {

/// Metres of the vehicle's path a metre of x.
double stretch_of(const road::RoadNetwork& network, const CorridorTraffic& traffic, std::size_t i) {
  if (traffic.lane[i] == 0) return 1.0;
  const LaneWay& way = traffic.ways.lanes[static_cast<std::size_t>(traffic.lane[i])];
  if (way.way_m.empty() && !changes_lane(traffic, i) && traffic.aside_m[i] == 0.0) return way.stretch;
  const double x = std::clamp(wrap_x(traffic.corridor, rear_axle_x_m(traffic, i)), 0.0, traffic.corridor.length_m);
  return path_at(network, traffic, i, x).tangent.stretch;
}

}  // namespace

std::uint32_t move(const road::RoadNetwork& network, CorridorTraffic& traffic, double dt_s) {
  std::uint32_t bad_numbers = 0;
  const bool straight = traffic.ways.straight;
  for (std::size_t i = 0; i < traffic.size(); ++i) {
    if (!std::isfinite(traffic.acceleration_mps2[i])) {
      traffic.acceleration_mps2[i] = 0.0;
      ++bad_numbers;
    }
    const double before = traffic.speed_mps[i], a = traffic.acceleration_mps2[i];
    const double after = before + a * dt_s;
    // A vehicle that stops within the step stops at the end of its braking.
    const double rolled = after >= 0.0 ? 0.5 * (before + after) * dt_s : -0.5 * before * before / a;
    traffic.speed_mps[i] = after > 0.0 ? after : 0.0;
    traffic.rolled_m[i] += rolled;
    double x = traffic.x_m[i] + (straight ? rolled : rolled / stretch_of(network, traffic, i));
    if (traffic.corridor.closed && x >= traffic.corridor.length_m) x -= traffic.corridor.length_m;
    traffic.x_m[i] = x;
  }
  return bad_numbers;
}

}  // namespace septet::traffic
