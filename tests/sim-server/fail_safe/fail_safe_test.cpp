#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

#include "car-io/can/can_plan.hpp"
#include "car-io/simulated_hid_device.hpp"
#include "sim-server/drive/live_drive.hpp"
#include "tests/relative.hpp"
#include "tests/sim-server/shipped_drive.hpp"

namespace septet::server {
namespace {

/// A person's car in a drive on simulated time, and the commands to its actuators.
struct SeatedDrive {
  explicit SeatedDrive(const rig::CarActuators& limits, bool has_actuators = true) {
    port.plug();
    DriverSeat seat;
    seat.actuators = limits;
    seat.car = std::make_unique<car_io::CarConnection>(port.opener(), car_io::CarConnectionOptions{});
    seat.devices.push_back(std::make_unique<Device>(*this, has_actuators));
    seat.shakes_by_sound = true;
    const LoadedDrive loaded = shipped_drive("behind-ambulance", "desktop");
    live = LiveDrive::start(loaded.model, traffic::own_traffic(loaded.model->roads, 1), std::move(seat)).value();
  }
  void drive(int ticks, bool sends) {
    for (int i = 0; i < ticks; ++i) {
      input.sequence = static_cast<std::uint8_t>(input.sequence + (sends ? 1 : 0));
      port.send(car_io::encode_controls(input, car_io::default_steering_lock_rad, switches));
      REQUIRE(live->next(std::nullopt).has_value());
    }
  }
  bool is_off() const { return told.fan == 0.0 && told.vibration == 0.0 && told.steering == 0.0; }

  /// Actuators and a cluster on a bus.
  class Device final : public SeatDevice {
   public:
    Device(SeatedDrive& drive, bool moves) : drive_(drive), moves_(moves) {}
    bool moves() const override { return moves_; }
    bool shows() const override { return true; }
    std::optional<Error> actuate(Tick, const car_io::Actuators& actuators) override {
      drive_.told = actuators;
      return std::nullopt;
    }
    std::optional<Error> show(const car_io::Instruments& instruments) override {
      drive_.shown = instruments;
      return std::nullopt;
    }
    bool is_lost() const override { return drive_.bus_is_lost; }

   private:
    SeatedDrive& drive_;
    bool moves_;
  };

  car_io::SimulatedHidPort port;
  car_io::CarSwitches switches;
  bool bus_is_lost = false;
  DriverInput input{.accelerator = 0.5};
  car_io::Actuators told;
  car_io::Instruments shown;
  std::unique_ptr<LiveDrive> live;
};

long messages_with(LiveDrive& live, const std::string& words) {
  return std::ranges::count_if(live.take_messages(),
                               [&](const std::string& text) { return text.find(words) != std::string::npos; });
}

}  // namespace

TEST_CASE("controls that stand still cut fan and shaker within 300 ms and they wait for a pause") {
  SeatedDrive seated({});
  seated.drive(60, true);
  CHECK_FALSE(seated.is_off());
  CHECK(messages_with(*seated.live, "are cut") == 0);
  seated.drive(36, false);  // 100 ms until they are stale, 200 ms to fall.
  seated.drive(1, false);
  CHECK(seated.is_off());
  seated.drive(120, true);
  CHECK(seated.is_off());
  CHECK(messages_with(*seated.live, "are cut, for the controls have stopped") == 1);
  seated.live->stand_still();
  CHECK(car_io::is_rest(seated.told));
  seated.drive(1, true);
  CHECK(seated.told.fan < 0.02);
  seated.drive(120, true);
  CHECK(seated.told.fan > 0.19);
}

TEST_CASE("a car that is pulled out and plugged in again has still fan and shaker until a pause") {
  SeatedDrive seated({});
  seated.drive(30, true);
  seated.port.unplug();
  seated.drive(25, true);
  CHECK(seated.is_off());
  seated.port.plug();
  seated.drive(120, true);
  CHECK(seated.is_off());
  seated.live->stand_still();
  seated.drive(121, true);
  CHECK(seated.told.fan > 0.19);
}

TEST_CASE("an emergency stop is in force with its own tick and outlasts its release and a pause until it is re-armed") {
  SeatedDrive seated({});
  seated.drive(60, true);
  CHECK(seated.live->alarm().empty());
  const double accelerated = seated.live->state().input.accelerator;
  CHECK(accelerated == relative(0.5, 0.01));
  seated.switches.emergency_stop = true;
  seated.drive(1, true);
  CHECK(seated.is_off());
  CHECK(seated.live->alarm() == "Emergency stop");
  CHECK(seated.live->state().input.accelerator == 0.0);
  CHECK(messages_with(*seated.live, "EMERGENCY STOP") == 1);
  CHECK(seated.live->rearm_actuators("operator") == "the emergency stop is still pressed");
  seated.switches.emergency_stop = false;
  seated.drive(60, true);
  CHECK(seated.is_off());
  seated.live->stand_still();
  seated.drive(60, true);
  CHECK(seated.is_off());
  CHECK(seated.live->alarm().find("re-armed") != std::string::npos);
  CHECK_FALSE(seated.live->rearm_actuators("operator").has_value());
  seated.drive(12, true);
  CHECK(car_io::is_rest(seated.told));  // It re-arms the writer on another machine.
  seated.drive(1, true);
  CHECK(seated.told.fan < 0.02);
  seated.drive(120, true);
  CHECK(seated.told.fan > 0.19);
  CHECK(seated.live->alarm().empty());
}

TEST_CASE("an emergency stop that is pressed and let go while the world stands still is in force when it goes on") {
  SeatedDrive seated({});
  seated.drive(60, true);
  const auto stand_with = [&](bool pressed) {
    seated.port.send(car_io::encode_controls(seated.input, 1.0, {.emergency_stop = pressed}));
    seated.live->stand_still();
  };
  stand_with(true);
  stand_with(false);
  seated.drive(60, true);
  CHECK(seated.is_off());
}

TEST_CASE("the re-arm button does it when it is held for a second and not before") {
  SeatedDrive seated({});
  seated.drive(60, true);
  seated.drive(60, false);
  CHECK(seated.is_off());
  seated.switches.rearm = true;
  seated.drive(100, true);
  seated.switches.rearm = false;
  seated.drive(1, true);
  seated.switches.rearm = true;
  seated.drive(110, true);
  CHECK(seated.live->actuators_cut().has_value());
  seated.drive(20 + 120, true);
  CHECK_FALSE(seated.live->actuators_cut().has_value());
  CHECK(seated.told.fan > 0.19);
}

TEST_CASE("a lost instruments' bus and sound that has stopped cut fan and shaker within 200 ms, each once") {
  SeatedDrive seated({});
  const auto falls = [&](const std::string& why) {
    seated.drive(25, true);
    CHECK(seated.is_off());
    CHECK(seated.live->actuators_cut() == why);
    CHECK_FALSE(seated.live->rearm_actuators("operator").has_value());
    seated.drive(140, true);
    CHECK(seated.told.fan > 0.19);
  };
  seated.drive(60, true);
  seated.bus_is_lost = true;
  seated.drive(1, true);
  seated.bus_is_lost = false;
  falls("the CAN bus is lost");
  seated.live->cut_actuators("the sound has stopped");
  falls("the sound has stopped");
}

TEST_CASE("while the CAN bus is lost neither the operator nor a pause brings fan and shaker back") {
  SeatedDrive seated({});
  seated.drive(60, true);
  seated.bus_is_lost = true;
  seated.drive(30, true);
  CHECK(seated.live->rearm_actuators("operator") == "the CAN bus is still lost");
  seated.live->stand_still();
  seated.drive(140, true);
  CHECK(seated.is_off());
  CHECK(seated.live->actuators_cut() == "the CAN bus is lost");
  seated.bus_is_lost = false;
  CHECK_FALSE(seated.live->rearm_actuators("operator").has_value());
  seated.drive(140, true);
  CHECK(seated.told.fan > 0.19);
}

TEST_CASE("controls that stand still and a car that is pulled out light the cluster's lamp until they are back") {
  SeatedDrive seated({});
  seated.drive(30, true);
  CHECK(seated.shown.controls_lost == 0.0);
  seated.drive(14, false);  // 100 ms until they are stale.
  CHECK(seated.shown.controls_lost == 1.0);
  seated.drive(2, true);
  CHECK(seated.shown.controls_lost == 0.0);
  seated.port.unplug();
  seated.drive(2, true);
  CHECK(seated.shown.controls_lost == 1.0);
  seated.port.plug();
  seated.drive(70, true);
  CHECK(seated.shown.controls_lost == 0.0);
}

TEST_CASE("a shaker that has shaken for a day is cut and the fan blows on") {
  SeatedDrive seated({.vibration_full_mps2 = 100.0, .vibration_dose_mps2 = 0.01});
  seated.drive(240, true);
  CHECK(seated.told.vibration == 0.0);
  CHECK(seated.told.fan > 0.19);
  CHECK(messages_with(*seated.live, "the shaker is cut") == 1);
  CHECK(seated.live->shaking_share() == 0.0);
}

TEST_CASE(
    "a shaker on the sound's low frequencies is cut and re-armed with everything else, also where there is nothing "
    "else") {
  for (const bool has_others : {true, false}) {
    CAPTURE(has_others);
    SeatedDrive seated({}, has_others);
    seated.drive(60, true);
    CHECK(seated.live->shaking_share() == 1.0);
    seated.drive(50, false);
    CHECK(seated.live->shaking_share() == 0.0);
    CHECK(messages_with(*seated.live, "are cut, for the controls have stopped") == 1);
    seated.drive(30, true);
    CHECK(seated.live->shaking_share() == 0.0);
    CHECK_FALSE(seated.live->rearm_actuators("operator").has_value());
    seated.drive(1, true);
    CHECK(seated.live->shaking_share() < 0.05);
    seated.drive(240, true);
    CHECK(seated.live->shaking_share() == 1.0);
  }
}

}  // namespace septet::server
