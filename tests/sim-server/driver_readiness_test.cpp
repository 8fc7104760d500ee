#include <chrono>
#include <thread>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

#include "car-io/simulated_hid_device.hpp"
#include "sim-server/drive/driver_seat.hpp"
#include "tests/relative.hpp"
#include "tests/sim-server/shipped_drive.hpp"

namespace septet::server {
namespace {

std::unique_ptr<LiveDrive> seated(const LoadedDrive& drive, DriverSeat seat) {
  auto live = LiveDrive::start(drive.model, traffic::own_traffic(drive.model->roads, 1), std::move(seat));
  REQUIRE(live.has_value());
  return std::move(*live);
}

}  // namespace

TEST_CASE("a driver at a keyboard is ready with the first controls of a screen") {
  const LoadedDrive drive = shipped_drive("behind-ambulance", "desktop");
  auto seat = open_driver_seat(drive.rig.car, 1, drive.model);
  REQUIRE(seat.has_value());
  const auto live = seated(drive, std::move(*seat));
  REQUIRE(live->first());
  CHECK(live->first()->snapshot().tick == 0);
  CHECK_FALSE(live->driver_is_ready(std::nullopt, 0.0));
  CHECK_FALSE(live->driver_is_ready(std::nullopt, 3600.0));
  CHECK(live->driver_is_ready(DriverInput{}, 3600.1));
}

TEST_CASE("a driver at a wheel is ready when a control is moved and not while it trembles") {
  const LoadedDrive drive = shipped_drive("behind-ambulance", "desktop");
  DriverInput resting;
  resting.steering_wheel_rad = 0.4;
  DriverInput pedal = resting, wheel = resting, indicator = resting;
  pedal.accelerator = 0.3;
  wheel.steering_wheel_rad = 0.1;
  indicator.indicator = IndicatorStalk::left;
  for (const DriverInput& touched : {pedal, wheel, indicator}) {
    car_io::SimulatedHidPort port;
    port.plug();
    DriverSeat seat;
    sit_at_device(seat, port.opener(), {});
    const auto live = seated(drive, std::move(seat));
    double waited_s = 0.0;
    const auto ready = [&](DriverInput input) {
      input.sequence = static_cast<std::uint8_t>(waited_s * 100.0);
      port.send(car_io::encode_controls(input));
      return live->driver_is_ready(std::nullopt, waited_s += 0.01);
    };
    for (int i = 0; i < 200; ++i) {
      DriverInput trembling = resting;
      trembling.steering_wheel_rad += i % 2 ? 0.02 : -0.02;
      trembling.accelerator = i % 3 ? 0.01 : 0.0;
      REQUIRE_FALSE(ready(trembling));
    }
    CHECK(ready(touched));
    CHECK(live->newest().tick == 0);
  }
}

TEST_CASE("a screen that drives and falls silent has its accelerator released after a second and not before") {
  const LoadedDrive drive = shipped_drive("behind-ambulance", "desktop");
  const auto live = seated(drive, {});
  DriverInput flat_out;
  flat_out.accelerator = 1.0;
  flat_out.horn = true;
  const auto accelerator_after = [&](int ticks, const std::optional<DriverInput>& controls) {
    for (int i = 0; i < ticks; ++i) REQUIRE(live->next(controls).has_value());
    return live->newest().driver_car.accelerator;
  };
  CHECK(accelerator_after(10, flat_out) == 1.0);
  CHECK(accelerator_after(115, std::nullopt) == 1.0);
  CHECK(accelerator_after(20, std::nullopt) == 0.0);
  CHECK(live->newest().diagnostics.input_stale_ticks > 0);
  CHECK(live->take_messages().size() == 1);
  CHECK(accelerator_after(2, flat_out) == 1.0);
}

TEST_CASE("a screen whose keys have all been let go is not said to be silent") {
  const LoadedDrive drive = shipped_drive("behind-ambulance", "desktop");
  const auto live = seated(drive, {});
  REQUIRE(live->next(DriverInput{}).has_value());
  for (int i = 0; i < 300; ++i) REQUIRE(live->next(std::nullopt).has_value());
  CHECK(live->newest().diagnostics.input_stale_ticks == 0);
  CHECK(live->take_messages().empty());
}

TEST_CASE("a simulated driver is always ready") {
  const LoadedDrive drive = shipped_drive("behind-ambulance", "seven-screens");
  auto seat = open_driver_seat(drive.rig.car, 1, drive.model);
  REQUIRE(seat.has_value());
  CHECK(seated(drive, std::move(*seat))->driver_is_ready(std::nullopt, 0.0));
}

TEST_CASE("silence on the wall clock is a fault of the actuators in real time, and none where time is simulated") {
  car_io::SimulatedHidPort port;
  port.plug();
  DriverSeat real_time, simulated;
  simulated.is_real_time = false;
  for (DriverSeat* seat : {&real_time, &simulated}) {
    sit_at_device(*seat, port.opener(), {}, true);
    REQUIRE(seat->has_actuators());
    for (const auto& device : seat->devices) CHECK_FALSE(device->actuate(1, {.fan = 0.5}).has_value());
  }
  for (int looks = 0; looks < 2000 && !real_time.has_cut_itself(); ++looks)
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  CHECK(real_time.has_cut_itself());
  CHECK_FALSE(simulated.has_cut_itself());
}

TEST_CASE("a simulated driver's seat moves no actuators, so that no silence can cut them") {
  for (const char* rig : {"desktop", "three-monitors", "seven-screens"}) {
    const LoadedDrive drive = shipped_drive("behind-ambulance", rig);
    rig::Car car = drive.rig.car;
    car.source = rig::CarSource::simulated_driver;
    auto seat = open_driver_seat(car, 1, drive.model);
    REQUIRE(seat.has_value());
    CHECK_FALSE(seat->has_actuators());
    const auto live = seated(drive, std::move(*seat));
    CHECK_FALSE(live->has_actuators());
    for (int tick = 0; tick < 12; ++tick) REQUIRE(live->next(std::nullopt).has_value());
    CHECK_FALSE(live->actuators_cut().has_value());
  }
}

TEST_CASE("a seat whose device may be missing is one at the keyboard without it") {
  const LoadedDrive drive = shipped_drive("behind-ambulance", "desktop");
  rig::Car car = drive.rig.car;
  car.product_id = 0xfffe;
  car.source = rig::CarSource::automatic;
  const auto seat = open_driver_seat(car, 1, drive.model);
  REQUIRE(seat.has_value());
  CHECK_FALSE(seat->car);
  CHECK(seat->devices.empty());
  car.source = rig::CarSource::hid;
  const auto refused = open_driver_seat(car, 1, drive.model);
  REQUIRE_FALSE(refused.has_value());
  CHECK(refused.error().remedy.find("automatic") != std::string::npos);
}

TEST_CASE(
    "a driver's device that is heard all the time is not taken for silent where the drive begins at a later time") {
  const LoadedDrive drive = shipped_drive("behind-ambulance", "desktop");
  auto state = simulation::initial_state(*drive.model, traffic::own_traffic(drive.model->roads, 1)).value();
  std::vector<simulation::Event> events;
  while (state.time_s() < 2.0) simulation::server_step(*drive.model, {}, state, events);
  car_io::SimulatedHidPort port;
  port.plug();
  DriverSeat seat;
  sit_at_device(seat, port.opener(), {});
  const auto live = LiveDrive::start(drive.model, std::move(state), std::move(seat));
  DriverInput input;
  const auto send = [&] {
    ++input.sequence;
    port.send(car_io::encode_controls(input));
  };
  for (double waited_s = 0.0; waited_s < 1.0; waited_s += 0.01) {
    if (waited_s > 0.9) input.accelerator = 0.5;
    send();
    CHECK(live->driver_is_ready(std::nullopt, waited_s) == (waited_s > 0.9));
  }
  for (int i = 0; i < 60; ++i) {
    if (i % 3 == 2) send();  // A device sends less often than a tick passes.
    REQUIRE(live->next(std::nullopt).has_value());
  }
  CHECK(live->state().time_s() == doctest::Approx(2.5));
  CHECK(live->state().input.accelerator == relative(0.5, 0.01));
  CHECK(live->state().diagnostics.input_stale_ticks == 0);
  CHECK_FALSE(live->actuators_cut().has_value());
}

}  // namespace septet::server
