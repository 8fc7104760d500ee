#include "sim-server/driver_seat.hpp"

#include "car-io/simulated_driver/simulated_driver.hpp"

namespace septet::server {

Expected<DriverSeat> open_driver_seat(const rig::Car& car, const std::string& driver, std::uint64_t seed,
                                      std::shared_ptr<const SimulationModel> model) {
  DriverSeat seat;
  if (!driver.empty() || car.source == rig::CarSource::simulated_driver) {
    const auto parameters = car_io::find_driver(driver.empty() ? car.driver : driver);
    if (!parameters) return tl::unexpected(parameters.error());
    // The driver keeps the model alive: the road in it is what they see.
    const auto person = std::make_shared<car_io::SimulatedDriverCar>(*parameters, seed, model->roads);
    seat.car = std::make_unique<car_io::CarConnection>(person->opener(), car_io::CarConnectionOptions{});
    seat.look = [person, model](const Snapshot& snapshot) { person->drive(snapshot, 1.0 / tick_rate_hz); };
    return seat;
  }
  if (car.source == rig::CarSource::keyboard) return seat;
  const auto layout = car_io::find_car_layout(car.layout);
  if (!layout) return tl::unexpected(layout.error());
  const car_io::HidAddress address{car.vendor_id, car.product_id, car.serial};
  // A missing device is noticed before the drive begins; one that is lost during it is opened again.
  if (const auto device = car_io::open_hid_device(address); !device) return tl::unexpected(device.error());
  seat.car = std::make_unique<car_io::CarConnection>([address] { return car_io::open_hid_device(address); },
                                                     car_io::CarConnectionOptions{*layout});
  return seat;
}

}  // namespace septet::server
