#pragma once
/// A driver who sees a const Snapshot and the road, and moves the controls like a person.
///
///     SimulatedDriver driver(parameters, seed);
///     each tick: DriverInput input = advance(driver, network, snapshot, dt_s);
///
/// Same parameters, seed and snapshots: same controls. Eyes, hands and feet are in the files beside this one; README.md
/// gives each part's source. Threads: one at a time.

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "engine/core/random.hpp"
#include "engine/driver/ambulance_tracks.hpp"
#include "engine/driver/course.hpp"
#include "engine/driver/driver_parameters.hpp"
#include "engine/driver/driver_view.hpp"
#include "engine/driver/gears.hpp"
#include "engine/driver/junction_gaps.hpp"
#include "engine/driver/known_world.hpp"
#include "engine/driver/lane_choice.hpp"
#include "engine/driver/mirrors.hpp"
#include "engine/driver/pedals.hpp"
#include "engine/driver/route_ahead.hpp"
#include "engine/driver/steering.hpp"
#include "engine/driver/warning.hpp"
#include "engine/world/driver_input.hpp"

namespace septet::driver {

/// The driver's memory between ticks.
struct SimulatedDriver {
  SimulatedDriver(DriverParameters parameters_in, std::uint64_t seed)
      : parameters(std::move(parameters_in)),
        hands_random(seed, 1),
        foot_random(seed, 2),
        head_random(seed, 3),
        eyes_random(seed, 4) {}

  DriverParameters parameters;
  std::vector<traffic::ApproachView> views;  ///< As learned last.
  Random hands_random, foot_random, head_random, eyes_random;
  std::optional<traffic::Corridor> corridor;
  std::optional<road::RoadPosition> place;  ///< Hint for the next look.
  KnownWorld known;
  std::vector<SeenVehicle> vehicles;
  ReactionDelay<std::vector<SeenVehicle>> foot_eyes;
  std::vector<SeenVehicle> minded;  ///< Vehicles that the foot acts upon: as seen a reaction time ago.
  double now_s = 0.0;
  double next_look_around_s = 0.0;
  SteeringState steering;
  PedalState pedals;
  GearState gears;
  MirrorState mirrors;
  LaneState lanes;
  TracksState tracks;
  CourseState course;
  RouteAhead route;  ///< Where he is told one.
  JunctionState junction;
  WarningState warning;
  bool plays = false;  ///< Has noticed that this is a game.
  std::uint8_t sequence = 0;
};

/// Tells the driver from where junctions are in view from now on: at first, and when walls have gone or come back.
void learn_views(SimulatedDriver& driver, const road::RoadNetwork& network, std::vector<traffic::ApproachView> views);

/// The controls `dt_s` later. Off every road the driver brakes to a stop.
DriverInput advance(SimulatedDriver& driver, const road::RoadNetwork& network, const Snapshot& snapshot, double dt_s);

}  // namespace septet::driver
