#pragma once
/// A simulated driver in the seat: before each tick it looks at the world and moves the controls of its HID device.

#include <cstdint>
#include <memory>
#include <span>
#include <utility>

#include "car-io/simulated_driver_car.hpp"
#include "engine/simulation/model.hpp"
#include "sim-server/drive/seat/seat_device.hpp"

namespace septet::server {

class SimulatedPerson final : public SeatDevice {
 public:
  /// The driver keeps the model alive, whose road they see.
  SimulatedPerson(const driver::DriverParameters& parameters, std::uint64_t seed,
                  std::shared_ptr<const simulation::Model> model)
      : model_(std::move(model)),
        car_(parameters, seed, model_->roads, model_->obstacles ? &model_->obstacles->walls() : nullptr) {}

  /// Opens its device, which is read like a real one.
  car_io::OpenHidDevice opener() const { return car_.opener(); }

  bool drives() const override { return true; }
  void see(const Snapshot& before, std::span<const std::uint32_t> gone) override;

 private:
  std::shared_ptr<const simulation::Model> model_;
  car_io::SimulatedDriverCar car_;
};

}  // namespace septet::server
