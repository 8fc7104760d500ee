#pragma once
/// A driver behind the HID interface like a person: sees a const Snapshot and the road, acts on the controls.
///
///     SimulatedDriverCar car(parameters, seed, network);
///     CarConnection connection(car.opener(), {});
///     each tick: car.drive(snapshot, dt_s); CarReading reading = connection.poll(now_s);
///
/// Same parameters, seed and snapshots: same controls. Eyes, hands and feet are in the files beside this one; README.md
/// gives each part's source. Threads: one at a time.

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "car-io/simulated_driver/ambulance_tracks.hpp"
#include "car-io/simulated_driver/course.hpp"
#include "car-io/simulated_driver/driver_parameters.hpp"
#include "car-io/simulated_driver/driver_view.hpp"
#include "car-io/simulated_driver/gears.hpp"
#include "car-io/simulated_driver/lane_choice.hpp"
#include "car-io/simulated_driver/mirrors.hpp"
#include "car-io/simulated_driver/pedals.hpp"
#include "car-io/simulated_driver/steering.hpp"
#include "car-io/simulated_driver/warning.hpp"
#include "car-io/simulated_hid_device.hpp"
#include "engine/core/random.hpp"
#include "engine/world/driver_input.hpp"

namespace septet::car_io {

/// The driver's memory between ticks.
struct SimulatedDriver {
  SimulatedDriver(DriverParameters parameters_in, std::uint64_t seed)
      : parameters(std::move(parameters_in)),
        hands_random(seed, 1),
        foot_random(seed, 2),
        head_random(seed, 3),
        eyes_random(seed, 4) {}

  DriverParameters parameters;
  Random hands_random, foot_random, head_random, eyes_random;
  std::optional<traffic::Corridor> corridor;
  std::optional<road::RoadPosition> place;  ///< Hint for the next look.
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
  WarningState warning;
  bool plays = false;  ///< Has noticed that this is a game.
  std::uint8_t sequence = 0;
};

/// The controls `dt_s` later. Off every road the driver brakes to a stop.
DriverInput advance(SimulatedDriver& driver, const road::RoadNetwork& network, const Snapshot& snapshot, double dt_s);

/// The driver in a car that speaks HID. The network must live as long.
class SimulatedDriverCar {
 public:
  SimulatedDriverCar(DriverParameters parameters, std::uint64_t seed, const road::RoadNetwork& network);
  /// Looks, acts, and sends one input report.
  void drive(const Snapshot& snapshot, double dt_s);
  OpenHidDevice opener() const { return port_.opener(); }
  SimulatedHidPort& port() { return port_; }

 private:
  SimulatedDriver driver_;
  const road::RoadNetwork* network_;
  SimulatedHidPort port_;
};

}  // namespace septet::car_io
