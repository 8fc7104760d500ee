#pragma once
/// An ambulance of the traffic itself; in a drive it comes from a scenario, as a foreign vehicle.

#include <optional>

#include "engine/core/check.hpp"
#include "engine/traffic/lane_order.hpp"
#include "engine/traffic/traffic.hpp"
#include "engine/traffic/traffic_stages.hpp"

namespace septet::traffic {

/// Adds an ambulance that drives on the line between the two fastest lanes, past vehicles that make way.
inline void add_emergency_vehicle(CorridorTraffic& traffic, ParticipantId id, double x_m, double speed_mps) {
  const auto model = find_vehicle_model("ambulance");
  SEPTET_CHECK(model.has_value(), "no model for vehicle {}", id);
  const Driver driver{{38.0, 0.8, 2.0, 3.0, 2.0}, {}, 0.0};
  const int lane = traffic.table.lowest + 1;
  add_vehicle(traffic, id, *model, driver, lane, x_m, speed_mps);
  traffic.emergency.back() = 1;
  traffic.aside_m.back() = traffic.aside_target_m.back() = 0.5 * traffic.table.lane_width_m;
  traffic.any_aside = true;
  // It stands in both lanes of its line.
  traffic.from_lane.back() = static_cast<std::int16_t>(lane - 1);
  auto& left = traffic.order.lanes[static_cast<std::size_t>(lane - 1)];
  insert_entry(left, entry_of(traffic, traffic.size() - 1));
}

}  // namespace septet::traffic
