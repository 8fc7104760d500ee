#include "car-io/actuator_writer.hpp"

#include <atomic>
#include <chrono>
#include <functional>
#include <optional>
#include <string>
#include <thread>

#include <doctest/doctest.h>

#include "car-io/car_connection.hpp"
#include "car-io/simulated_hid_device.hpp"
#include "tests/car-io/car_side.hpp"

namespace septet::car_io {
namespace {

using Clock = std::chrono::steady_clock;

/// Waits for another thread; generous, since only a failure takes the time.
bool comes_true(const std::function<bool()>& condition) {
  for (const auto end = Clock::now() + std::chrono::minutes(5); Clock::now() < end;) {
    if (condition()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  return false;
}

/// The fan of the newest output report, or its previous value.
double newest_fan(SimulatedHidPort& port, double before) {
  for (const Bytes& report : port.take_written())
    if (const auto actuators = decode_actuators(report)) before = actuators->fan;
  return before;
}

}  // namespace

TEST_CASE("what is set reaches the device and the last report of all is zero") {
  SimulatedHidPort port;
  port.plug();
  double fan = -1.0;
  {
    ActuatorWriter writer(port.opener(), {.period_s = 0.002, .silent_after_s = 60.0});
    writer.set({.fan = 0.5});
    CHECK(comes_true([&] { return (fan = newest_fan(port, fan)) > 0.49; }));
  }
  CHECK(newest_fan(port, fan) == 0.0);
}

TEST_CASE("where nobody sets anything the fan fades to zero by itself") {
  SimulatedHidPort port;
  port.plug();
  ActuatorWriter writer(port.opener(), {.period_s = 0.002, .silent_after_s = 0.02});
  writer.set({.fan = 1.0});
  double fan = -1.0;
  CHECK(comes_true([&] { return (fan = newest_fan(port, fan)) == 0.0; }));
}

TEST_CASE("a sticky writer that was left alone stays at zero until what is at rest is set") {
  SimulatedHidPort port;
  port.plug();
  ActuatorWriter writer(port.opener(), {.period_s = 0.001, .silent_after_s = 0.05, .sticky = true});
  double fan = -1.0;
  std::optional<Error> error;
  REQUIRE(comes_true([&] {
    writer.set({.fan = 0.5, .vibration_hz = 20.0});
    return (fan = newest_fan(port, fan)) > 0.49;
  }));
  REQUIRE(comes_true([&] { return (error = writer.take_error()).has_value(); }));
  CHECK(error->what.find("are cut, for the simulation was silent") != std::string::npos);
  REQUIRE(comes_true([&] { return (fan = newest_fan(port, fan)) == 0.0; }));
  for (int i = 0; i < 20; ++i) {
    writer.set({.fan = 0.5, .vibration_hz = 20.0});
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    CHECK((fan = newest_fan(port, fan)) == 0.0);
  }
  CHECK(comes_true([&] {
    writer.set({});  // Again and again: a machine that is busy may cut it once more meanwhile.
    writer.set({.fan = 0.5, .vibration_hz = 20.0});
    return (fan = newest_fan(port, fan)) > 0.49;
  }));
}

TEST_CASE("a sticky writer is cut by a silence also where it is set again before its thread has looked") {
  SimulatedHidPort port;
  port.plug();
  ActuatorWriter writer(port.opener(), {.period_s = 600.0, .silent_after_s = 0.01, .sticky = true});
  writer.set({.fan = 0.5, .vibration_hz = 20.0});
  std::this_thread::sleep_for(std::chrono::milliseconds(30));  // Like a program stopped with all its threads.
  writer.set({.fan = 0.5, .vibration_hz = 20.0});
  CHECK(writer.is_cut());
  writer.set({});
  CHECK_FALSE(writer.is_cut());
}

TEST_CASE("a device that takes no output delays neither who sets nor who reads") {
  SimulatedHidPort port;
  port.plug();
  CarConnection car(port.opener(), {});
  ActuatorWriter writer(port.opener(), {.period_s = 0.001, .silent_after_s = 60.0});
  writer.set({.fan = 0.5});
  double fan = -1.0;
  REQUIRE(comes_true([&] { return (fan = newest_fan(port, fan)) > 0.49; }));
  port.block_writes(true);
  std::this_thread::sleep_for(std::chrono::milliseconds(10));  // It hangs in its write now.
  DriverInput input;
  for (int tick = 0; tick < 1000; ++tick) {
    writer.set({.fan = 0.25});
    input.sequence = static_cast<std::uint8_t>(tick);
    port.send(encode_controls(input));
    const CarReading reading = car.poll(tick / 120.0);
    CHECK(reading.input.sequence == input.sequence);
    CHECK_FALSE(reading.is_stale);
  }
  port.block_writes(false);
  CHECK(comes_true([&] { return (fan = newest_fan(port, fan)) < 0.3; }));
}

TEST_CASE("a device that was plugged in again is written to again without a word") {
  SimulatedHidPort port;
  port.plug();
  ActuatorWriter writer(port.opener(), {.period_s = 0.002, .silent_after_s = 60.0, .retry_s = 0.01});
  writer.set({.fan = 0.5});
  double fan = -1.0;
  REQUIRE(comes_true([&] { return (fan = newest_fan(port, fan)) > 0.49; }));
  port.unplug();
  std::this_thread::sleep_for(std::chrono::milliseconds(20));
  port.plug();
  fan = -1.0;
  CHECK(comes_true([&] { return (fan = newest_fan(port, fan)) > 0.49; }));
  CHECK_FALSE(writer.take_error().has_value());
}

TEST_CASE("the device's own watchdog is set whenever it is plugged in") {
  SimulatedHidPort port;
  port.plug();
  ActuatorWriter writer(port.opener(), {.period_s = 0.002, .retry_s = 0.01});
  const auto is_set = [&] {
    const auto feature = port.feature(device_report_id);
    const auto status = feature ? decode_device_status(*feature) : DeviceStatus{.watchdog_ms = 0};
    return status && status->watchdog_ms == 250;
  };
  CHECK(comes_true(is_set));
  port.unplug();
  port.plug();
  CHECK(comes_true(is_set));
  CHECK_FALSE(writer.take_error().has_value());
}

TEST_CASE("a device that does not keep its watchdog is named once and is written to all the same") {
  struct Forgetful final : HidDevice {
    explicit Forgetful(std::atomic<int>& its_writes) : writes(its_writes) {}
    Expected<std::optional<Bytes>> read_newest() override { return std::nullopt; }
    Expected<void> write(std::span<const std::byte>) override {
      ++writes;
      return {};
    }
    Expected<Bytes> get_feature(std::uint8_t, std::size_t) override {
      const auto report = encode_device_status({.watchdog_ms = 0});
      return Bytes(report.begin(), report.end());
    }
    Expected<void> send_feature(std::span<const std::byte>) override { return {}; }
    std::atomic<int>& writes;
  };
  std::atomic<int> writes = 0;
  ActuatorWriter writer([&]() -> Expected<std::unique_ptr<HidDevice>> { return std::make_unique<Forgetful>(writes); },
                        {.period_s = 0.001});
  std::optional<Error> error;
  REQUIRE(comes_true([&] { return (error = writer.take_error()).has_value(); }));
  CHECK(error->what.find("its watchdog does not hold 250 ms (it says 0 ms)") == 0);
  const int before = writes;
  CHECK(comes_true([&] { return writes > before + 3; }));
  CHECK_FALSE(writer.take_error().has_value());
}

namespace {

/// A device that is unplugged after some reports: its first handle is dead then, and the next one works.
struct Unplugged final : HidDevice {
  struct Port {
    std::size_t reports_of_first = 0;
    std::atomic<int> handles{0}, writes{0};  ///< Also those that fail.
    std::vector<double> fans;                ///< Received commands; to be read after the writer has gone.
  };
  explicit Unplugged(Port& its_port) : port(its_port), is_first(++port.handles == 1) {}
  Expected<std::optional<Bytes>> read_newest() override { return std::nullopt; }
  Expected<void> write(std::span<const std::byte> report) override {
    ++port.writes;
    if (is_first && port.fans.size() >= port.reports_of_first) return failure("No such device", "a wheel", "");
    if (const auto actuators = decode_actuators(report)) port.fans.push_back(actuators->fan);
    return {};
  }
  Expected<Bytes> get_feature(std::uint8_t, std::size_t) override {
    if (is_first && port.reports_of_first == 0) return failure("No such device", "a wheel", "");
    return feature;
  }
  Expected<void> send_feature(std::span<const std::byte> report) override {
    feature.assign(report.begin(), report.end());
    return {};
  }
  Port& port;
  bool is_first;
  Bytes feature;
};

}  // namespace

TEST_CASE("the last report of all is zero also where one has just failed") {
  Unplugged::Port port;
  port.reports_of_first = 3;
  {
    ActuatorWriter writer([&]() -> Expected<std::unique_ptr<HidDevice>> { return std::make_unique<Unplugged>(port); },
                          {.period_s = 0.001, .silent_after_s = 3600.0, .retry_s = 3600.0});
    writer.set({.fan = 0.5});
    // The fourth fails; then the device is left alone for an hour, or until the end.
    CHECK(comes_true([&] { return port.writes == 4; }));
  }
  REQUIRE_FALSE(port.fans.empty());
  CHECK(port.fans.back() == 0.0);
  CHECK(port.handles <= 2);
}

TEST_CASE("a device that is unplugged while its watchdog is set is not called one without") {
  Unplugged::Port port;
  std::optional<Error> error;
  {
    ActuatorWriter writer([&]() -> Expected<std::unique_ptr<HidDevice>> { return std::make_unique<Unplugged>(port); },
                          {.period_s = 0.001, .retry_s = 0.0});
    CHECK(comes_true([&] { return port.writes > 3; }));
    error = writer.take_error();
  }
  CHECK_FALSE(error.has_value());
  CHECK(port.handles == 2);
}

TEST_CASE("a device that refuses output reports is named once") {
  struct Refusing final : HidDevice {
    Expected<std::optional<Bytes>> read_newest() override { return std::nullopt; }
    Expected<void> write(std::span<const std::byte>) override { return failure("Broken pipe", "a wheel", ""); }
    Expected<Bytes> get_feature(std::uint8_t, std::size_t) override { return feature; }
    Expected<void> send_feature(std::span<const std::byte> report) override {
      feature.assign(report.begin(), report.end());
      return {};
    }
    Bytes feature;
  };
  ActuatorWriter writer([]() -> Expected<std::unique_ptr<HidDevice>> { return std::make_unique<Refusing>(); },
                        {.period_s = 0.001, .retry_s = 0.001});
  std::optional<Error> error;
  REQUIRE(comes_true([&] { return (error = writer.take_error()).has_value(); }));
  CHECK(error->what == "it takes no output reports: Broken pipe");
  std::this_thread::sleep_for(std::chrono::milliseconds(20));
  CHECK_FALSE(writer.take_error().has_value());
}

}  // namespace septet::car_io
