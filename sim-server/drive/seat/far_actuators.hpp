#pragma once
/// Fan, shaker and hand wheel of a car on another machine: the newest command goes to its lane (host/remote_car.hpp).

#include <memory>
#include <utility>

#include "sim-server/drive/seat/seat_device.hpp"
#include "sim-server/host/remote_car.hpp"

namespace septet::server {

class FarActuators final : public SeatDevice {
 public:
  explicit FarActuators(std::shared_ptr<RemoteCar> car) : car_(std::move(car)) {}

  bool moves() const override { return true; }
  std::optional<Error> actuate(Tick tick, const car_io::Actuators& actuators) override {
    car_->feedback =
        control::CarFeedback{tick, static_cast<float>(actuators.fan), static_cast<float>(actuators.vibration),
                             static_cast<float>(actuators.vibration_hz), static_cast<float>(actuators.steering)};
    return std::nullopt;
  }

 private:
  std::shared_ptr<RemoteCar> car_;
};

}  // namespace septet::server
