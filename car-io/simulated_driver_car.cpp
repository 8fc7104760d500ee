#include "car-io/simulated_driver_car.hpp"

#include <utility>

#include "car-io/car_report.hpp"

namespace septet::car_io {

SimulatedDriverCar::SimulatedDriverCar(driver::DriverParameters parameters, std::uint64_t seed,
                                       const road::RoadNetwork& network, const sight::Walls* walls)
    : driver_(std::move(parameters), seed), network_(&network) {
  if (walls) driver_.views = traffic::approach_views(network, *walls);
  port_.plug();
}

void SimulatedDriverCar::drive(const Snapshot& snapshot, double dt_s) {
  port_.send(encode_controls(advance(driver_, *network_, snapshot, dt_s)));
}

}  // namespace septet::car_io
