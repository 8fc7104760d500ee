#include <algorithm>
#include <chrono>
#include <thread>

#include <doctest/doctest.h>

#include "car-io/simulated_hid_device.hpp"
#include "sim-server/drive/car_motion.hpp"
#include "sim-server/drive/driver_seat.hpp"
#include "tests/car-io/car_side.hpp"
#include "tests/relative.hpp"
#include "tests/sim-server/shipped_drive.hpp"

namespace septet::server {
namespace {

/// Keeps the last tick's command, so that it can be repeated.
class Repeated final : public SeatDevice {
 public:
  Repeated(std::unique_ptr<SeatDevice> device, std::function<void()>& again) : device_(std::move(device)) {
    again = [this] { device_->actuate(0, newest_); };
  }
  bool moves() const override { return device_->moves(); }
  std::optional<Error> actuate(Tick tick, const car_io::Actuators& actuators) override {
    newest_ = actuators;
    return device_->actuate(tick, actuators);
  }

 private:
  std::unique_ptr<SeatDevice> device_;
  car_io::Actuators newest_;
};

/// A drive whose driver sits at a device that is plugged in. `actuate_again` repeats its last tick's command.
std::unique_ptr<LiveDrive> seated_at(car_io::SimulatedHidPort& port, const rig::CarActuators& limits = {},
                                     std::function<void()>* actuate_again = nullptr) {
  port.plug();
  DriverSeat seat;
  seat.actuators = limits;
  sit_at_device(seat, port.opener(), {});
  if (actuate_again) seat.devices.back() = std::make_unique<Repeated>(std::move(seat.devices.back()), *actuate_again);
  const LoadedDrive drive = shipped_drive("behind-ambulance", "desktop");
  auto live = LiveDrive::start(drive.model, traffic::own_traffic(drive.model->roads, 1), std::move(seat));
  REQUIRE(live.has_value());
  return std::move(*live);
}

}  // namespace

TEST_CASE("an engine that does not run shakes nothing though it is still turned over") {
  const LoadedDrive drive = shipped_drive("behind-ambulance", "desktop");
  simulation::State state;
  state.car = vehicle::standstill(drive.model->car, {}, 10.0);
  state.car.powertrain.engine_radps = 90.0;
  state.car.powertrain.engine_running = true;
  CHECK(car_motion(*drive.model, state).engine_radps == doctest::Approx(90.0));
  state.car.powertrain.engine_running = false;
  CHECK(car_motion(*drive.model, state).engine_radps == 0.0);
}

TEST_CASE("the fan of the car at the server rises with the speed of the drive") {
  car_io::SimulatedHidPort port;
  rig::CarActuators limits;
  limits.fan_full_speed_mps = 70.0;
  std::function<void()> actuate_again;
  const auto live = seated_at(port, limits, &actuate_again);
  DriverInput input;
  input.accelerator = 1.0;
  const auto drive_for = [&](int ticks) {
    for (int i = 0; i < ticks; ++i) {
      ++input.sequence;
      port.send(car_io::encode_controls(input));
      REQUIRE(live->next(std::nullopt).has_value());
    }
    // The writer has a thread and a clock of its own: wait until it has written this speed, which fades unless it is
    // renewed.
    const double share = std::min(live->newest().driver_car.speed_mps / 70.0, 1.0);
    const auto expected = relative(0.2 + 0.8 * share, 1e-3);
    double fan = -1.0;
    for (int i = 0; i < 150'000 && fan != expected; ++i) {
      actuate_again();
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
      for (const Bytes& report : port.take_written())
        if (const auto actuators = car_io::decode_actuators(report)) fan = actuators->fan;
    }
    CHECK(fan == expected);
    return fan;
  };
  const double first = drive_for(120), second = drive_for(360);
  CHECK(second > first + 0.02);
}

TEST_CASE("a car that was unplugged mid-drive is told once and the drive goes on and counts it") {
  car_io::SimulatedHidPort port;
  const auto live = seated_at(port);
  DriverInput input;
  const auto drive_for = [&](int ticks) {
    for (int i = 0; i < ticks; ++i) {
      ++input.sequence;
      port.send(car_io::encode_controls(input));
      REQUIRE(live->next(std::nullopt).has_value());
    }
    return live->take_messages();
  };
  CHECK(drive_for(60).empty());
  CHECK(live->newest().diagnostics.input_stale_ticks == 0);
  port.unplug();
  const auto lost = drive_for(30);
  REQUIRE(lost.size() == 2);
  CHECK(lost[0].find("no such device") != std::string::npos);
  CHECK(lost[1].find("are cut") != std::string::npos);
  CHECK(live->newest().diagnostics.input_stale_ticks == 30);
  port.plug();
  const auto back = drive_for(120);
  REQUIRE(back.size() == 1);
  CHECK(back[0] == "car: the car's device is there");
  const auto counted = live->newest().diagnostics.input_stale_ticks;
  CHECK(counted < 100);
  drive_for(10);
  CHECK(live->newest().diagnostics.input_stale_ticks == counted);
}

TEST_CASE("a car that goes wrong in ever new ways is told of ten times and then once a second") {
  car_io::SimulatedHidPort port;
  const auto live = seated_at(port);
  const auto refused_for = [&](int ticks) {
    for (int i = 0; i < ticks; ++i) {
      port.send(Bytes(20 + i % 40));  // The message names the size.
      REQUIRE(live->next(std::nullopt).has_value());
    }
    return live->take_messages();
  };
  CHECK(refused_for(60).size() == 10);
  const auto later = refused_for(120);
  REQUIRE(later.size() == 1);
  CHECK(later[0].find("more of its messages were left out") != std::string::npos);
}

}  // namespace septet::server
