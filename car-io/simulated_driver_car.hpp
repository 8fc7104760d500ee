#pragma once
/// The simulated driver (engine/driver) in a car that speaks HID, so that its controls are read as a person's are.
///
///     SimulatedDriverCar car(parameters, seed, network);
///     CarConnection connection(car.opener(), {});
///     each tick: car.drive(snapshot, dt_s); CarReading reading = connection.poll(now_s);
///
/// Threads: one at a time.

#include <cstdint>
#include <span>
#include <vector>

#include "car-io/simulated_hid_device.hpp"
#include "engine/driver/simulated_driver.hpp"
#include "engine/sight/walls.hpp"

namespace septet::car_io {

/// The network must live as long.
class SimulatedDriverCar {
 public:
  /// `walls` hide junctions from the driver; null: nothing does, vans neither. They must live as long.
  SimulatedDriverCar(driver::DriverParameters parameters, std::uint64_t seed, const road::RoadNetwork& network,
                     const sight::Walls* walls = nullptr);
  /// Looks, acts, and sends one input report. `gone`: things whose walls do not stand, ascending.
  void drive(const Snapshot& snapshot, double dt_s, std::span<const std::uint32_t> gone = {});
  OpenHidDevice opener() const { return port_.opener(); }
  SimulatedHidPort& port() { return port_; }

 private:
  void learn_views();

  driver::SimulatedDriver driver_;
  const road::RoadNetwork* network_;
  const sight::Walls* walls_;
  std::vector<std::uint32_t> gone_;
  SimulatedHidPort port_;
};

}  // namespace septet::car_io
