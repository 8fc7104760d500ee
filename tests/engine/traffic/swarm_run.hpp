#pragma once
/// A swarm on the shipped motorway: a driver follows an ambulance through it.

#include "engine/road/opendrive_reader.hpp"
#include "tests/engine/traffic/bodies.hpp"
#include "tests/engine/traffic/ring_road.hpp"
#include "tests/shipped_files.hpp"

namespace septet::traffic {

struct SwarmRun {
  double ambulance_mps = 0.0;
  double traffic_mps = 0.0;  ///< Mean of vehicles within 400 m of the ambulance.
  double least_near = 1e9;   ///< Number of these.
  int overlaps = 0;          ///< Among traffic.
  int overlaps_with_driver = 0;
  int overlaps_with_ambulance = 0;
  double nearest_jump_m = 1e9;  ///< From the driver to the nearest place where a vehicle was removed or inserted.
};

/// On the line between the two left-most lanes both drive at this speed, the driver 45 m behind;
/// measured from 15 s on.
inline SwarmRun follow_ambulance(const TrafficParameters& parameters, double speed_mps, double seconds,
                                 std::uint64_t seed) {
  const auto network =
      road::read_opendrive(shipped_text("scenarios/motorway-ambulance/motorway.xodr"), "motorway.xodr");
  REQUIRE(network.has_value());
  const Corridor corridor = build_corridor(*network, {0, -3, 1000.0, 0.0});
  const auto vehicle_at = [&](double x_m, std::string_view model) {
    ForeignVehicle vehicle;
    vehicle.model = model_named(model);
    road::LanePosition place = position_at(corridor, x_m, 3);
    place.offset_m = -1.875;
    vehicle.world_from_vehicle = road::world_from_lane(road::evaluate_lane(*network, place));
    vehicle.velocity_mps = vehicle.world_from_vehicle.orientation * Vec3(speed_mps, 0.0, 0.0);
    return vehicle;
  };
  const auto of = [](const ForeignVehicle& vehicle) {
    Participant participant;
    participant.model = vehicle.model;
    participant.world_from_vehicle = vehicle.world_from_vehicle;
    return outline(participant);
  };
  std::vector<ForeignVehicle> foreign(2);
  const auto place_foreign_at = [&](double x_m) {
    foreign[0] = vehicle_at(x_m, "volvo-s80");
    foreign[1] = vehicle_at(x_m + 50.0, "ambulance");
    foreign[1].lamps.set(Lamp::beacon, true);
  };
  double x_m = 1050.0;
  place_foreign_at(x_m);
  Random random(seed, 1);
  TrafficState state = populate(parameters, *network, foreign, random);
  const CorridorTraffic& traffic = state.corridors[0];
  SwarmRun run;
  run.ambulance_mps = speed_mps;
  double sum = 0.0, number = 0.0;
  std::vector<Participant> participants;
  std::vector<double> was_x_m;
  std::vector<std::int16_t> was_lane;
  std::vector<ParticipantId> was_id;
  constexpr double tick_s = 1.0 / 30.0;
  for (int tick = 0; tick * tick_s < seconds; ++tick) {
    x_m += speed_mps * tick_s;
    place_foreign_at(x_m);
    advance(parameters, *network, foreign, tick_s, random, state);
    for (std::size_t i = 0; i < was_x_m.size() && i < traffic.size(); ++i) {
      const bool came_or_left = (was_lane[i] == 0) != (traffic.lane[i] == 0);
      if (traffic.id[i] != was_id[i] || (!came_or_left && std::abs(traffic.x_m[i] - was_x_m[i]) < 10.0)) continue;
      if (was_lane[i] != 0) run.nearest_jump_m = std::min(run.nearest_jump_m, std::abs(was_x_m[i] - x_m));
      if (traffic.lane[i] != 0) run.nearest_jump_m = std::min(run.nearest_jump_m, std::abs(traffic.x_m[i] - x_m));
    }
    was_x_m = traffic.x_m, was_lane = traffic.lane, was_id = traffic.id;
    if (tick * tick_s < 15.0) continue;
    double near = 0.0;
    for (std::size_t i = 0; i < traffic.size(); ++i) {
      if (traffic.lane[i] == 0 || std::abs(traffic.x_m[i] - x_m - 50.0) > 400.0) continue;
      sum += traffic.speed_mps[i];
      near += 1.0;
    }
    number += near;
    run.least_near = std::min(run.least_near, near);
    if (tick % 6 != 0) continue;
    participants.clear();
    append_participants(state, *network, participants);
    run.overlaps += overlapping_pairs(participants);
    for (const Participant& other : participants) {
      run.overlaps_with_driver += overlap(outline(other), of(foreign[0]));
      run.overlaps_with_ambulance += overlap(outline(other), of(foreign[1]));
    }
  }
  run.traffic_mps = sum / number;
  return run;
}

/// 333 vehicles within 1,000 m, one in ten on the other side: 30 per km and lane.
inline TrafficParameters dense_swarm() {
  TrafficParameters parameters = motorway_traffic(333, 1000.0);
  parameters.opposite_share = 0.1;
  return parameters;
}

}  // namespace septet::traffic
