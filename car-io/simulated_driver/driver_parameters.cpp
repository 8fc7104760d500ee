#include "car-io/simulated_driver/driver_parameters.hpp"

#include <fmt/core.h>

namespace septet::car_io {
namespace {

/// Looks less often and longer, sees less exactly, keeps more distance, reacts later.
DriverParameters novice() {
  DriverParameters driver{.name = "novice"};
  driver.steering.position_noise_m = 0.23;
  driver.steering.peripheral_share = 0.4;
  driver.steering.heading_noise_rad = 0.0026;
  driver.steering.delay_s = 0.25;
  driver.speed.limit_factor = 0.95;
  driver.speed.time_gap_s = 1.8;
  driver.speed.reaction_time_s = 0.9;
  driver.speed.distance_noise = 0.10;
  driver.lanes.threshold_mps2 = 0.5;
  driver.lanes.signal_s = 2.5;
  driver.lanes.duration_s = 6.0;
  driver.mirrors.interval_s = 14.0;
  driver.mirrors.glance_s = 0.9;
  return driver;
}

DriverParameters experienced() {
  DriverParameters driver{.name = "experienced"};
  driver.steering.position_noise_m = 0.15;
  driver.steering.peripheral_share = 0.8;
  driver.steering.heading_noise_rad = 0.0014;
  driver.speed.limit_factor = 1.05;
  driver.speed.time_gap_s = 1.3;
  driver.speed.reaction_time_s = 0.6;
  driver.speed.distance_noise = 0.04;
  driver.lanes.threshold_mps2 = 0.2;
  driver.mirrors.interval_s = 6.0;
  driver.mirrors.glance_s = 0.55;
  return driver;
}

/// Corrects late and slowly: the lane is kept loosely.
DriverParameters tired() {
  DriverParameters driver{.name = "tired"};
  driver.steering.natural_frequency_radps = 0.45;
  driver.steering.position_noise_m = 0.28;
  driver.steering.position_noise_s = 4.0;
  driver.steering.delay_s = 0.30;
  driver.speed.reaction_time_s = 1.2;
  driver.speed.distance_noise = 0.12;
  driver.mirrors.interval_s = 20.0;
  return driver;
}

}  // namespace

Expected<DriverParameters> find_driver(std::string_view name) {
  for (const DriverParameters& driver : {DriverParameters{}, novice(), experienced(), tired()})
    if (driver.name == name) return driver;
  return failure(fmt::format("there is no simulated driver '{}'", name), "rig, [car] driver",
                 "use one of: plain, novice, experienced, tired");
}

}  // namespace septet::car_io
