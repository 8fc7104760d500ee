// A program that serves a game hangs and goes on, with the firmware's core as its device.

#include <chrono>
#include <cstdint>
#include <mutex>
#include <thread>

#include <doctest/doctest.h>

#include "car-io/actuator_writer.hpp"
#include "car-io/games/game_drive.hpp"
#include "tests/car-io/firmware/simulated_car.hpp"

namespace septet::car_io {
namespace {

/// `septet-car serve` with a game that pulls the wheel; the car's time goes on with the reports that it takes.
struct ServedCar {
  ServedCar() {
    car.run(60);
    effects.load(0, {.kind = ForceKind::constant, .level = 1.0});
    effects.play(0, 1, 0.0);
  }
  std::uint8_t newest_report() {
    const std::lock_guard lock(car.mutex);
    return car.device.steering_sequence;
  }
  void serve_for(double seconds) {
    CarReading reading;
    reading.is_connected = true;
    for (const double end_s = now_s + seconds; now_s < end_s; now_s += 0.01) {
      if (writer.is_cut()) drive.cut("septet-car was silent");
      writer.set(drive.actuate(reading, effects, now_s));
      const std::uint8_t before = newest_report();
      for (int i = 0; i < 100'000 && newest_report() == before; ++i)
        std::this_thread::sleep_for(std::chrono::microseconds(200));
      car.run(10);
    }
  }
  bool is_pulled() { return !car.is_off() && car.outputs.steering != 0; }

  SimulatedCar car;
  GameDrive drive{{.steering_most = 1.0}, 7.85};
  ForceEffects effects;
  ActuatorWriter writer{car.opener(),
                        {.has_steering_force = true, .period_s = 0.001, .sticky = true, .tells_cut = false}};
  double now_s = 0.0;
};

}  // namespace

TEST_CASE("a game's program that hung and goes on leaves everything at 0 until it is re-armed, and then it is back") {
  ServedCar served;
  served.serve_for(1.5);
  REQUIRE(served.is_pulled());
  served.car.run(300);  // Longer than the device's watchdog, and nothing written.
  CHECK(served.car.is_off());
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  served.serve_for(1.0);
  CHECK(served.car.is_off());
  CHECK(served.drive.is_cut());
  served.drive.rearm();
  served.serve_for(1.5);
  CHECK_FALSE(served.drive.is_cut());
  CHECK(served.is_pulled());
}

TEST_CASE("a device that has cut itself off alone is armed by re-arming though the drive was not cut") {
  ServedCar served;
  served.serve_for(1.5);
  served.car.run(300);
  served.serve_for(0.5);
  CHECK(served.car.is_off());
  served.drive.rearm();
  served.serve_for(1.5);
  CHECK(served.is_pulled());
}

}  // namespace septet::car_io
