#include "car-io/simulated_driver_car.hpp"

#include <algorithm>
#include <utility>

#include "car-io/car_report.hpp"

namespace septet::car_io {

SimulatedDriverCar::SimulatedDriverCar(driver::DriverParameters parameters, std::uint64_t seed,
                                       const road::RoadNetwork& network, const sight::Walls* walls)
    : driver_(std::move(parameters), seed), network_(&network), walls_(walls) {
  learn_views();
  port_.plug();
}

void SimulatedDriverCar::learn_views() {
  if (walls_) driver::learn_views(driver_, *network_, traffic::approach_views(*network_, *walls_, gone_));
}

void SimulatedDriverCar::drive(const Snapshot& snapshot, double dt_s, std::span<const std::uint32_t> gone) {
  if (!std::ranges::equal(gone, gone_)) {
    gone_.assign(gone.begin(), gone.end());
    learn_views();
  }
  port_.send(encode_controls(advance(driver_, *network_, snapshot, dt_s)));
}

}  // namespace septet::car_io
