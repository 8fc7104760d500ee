// A car on USB, as the kernel and libusb show it: plugged in, pulled out, hung, and abandoned by its program.

#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <fmt/core.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "car-io/actuator_writer.hpp"
#include "car-io/car_connection.hpp"
#include "car-io/usb_device.hpp"
#include "tests/relative.hpp"
#include "tests/rig-vm/guest.hpp"
#include "tests/rig-vm/usb_car.hpp"
#include "tests/shipped_files.hpp"

namespace septet::rig_vm {
namespace {

using namespace car_io;
namespace fs = std::filesystem;

/// The endpoints that the controller gave the car.
rig::UsbEndpoints endpoints_of_car() {
  rig::UsbEndpoints endpoints;
  for (const auto& device : fs::directory_iterator("/sys/bus/usb/devices")) {
    if (text_of(device.path() / "idVendor") != "1209\n") continue;
    const fs::path interface = device.path() / (device.path().filename().string() + ":1.0");
    for (const auto& entry : fs::directory_iterator(interface)) {
      const std::string name = entry.path().filename().string();
      if (!name.starts_with("ep_")) continue;
      const auto address = static_cast<std::uint8_t>(std::stoi(name.substr(3), nullptr, 16));
      ((address & 0x80) != 0 ? endpoints.in : endpoints.out) = address;
    }
  }
  return endpoints;
}

/// A path in, with the device that it leads to.
struct Way {
  const char* name;
  UsbCar::Kind kind;
  rig::HidAccess access;
};
constexpr Way ways[] = {{"hidraw", UsbCar::Kind::hid, rig::HidAccess::hidraw},
                        {"libusb", UsbCar::Kind::hid, rig::HidAccess::libusb},
                        {"libusb, bulk endpoints", UsbCar::Kind::vendor, rig::HidAccess::automatic}};

bool is_known(const UsbCar&) {
  for (const auto& device : fs::directory_iterator("/sys/bus/usb/devices"))
    if (text_of(device.path() / "idVendor") == "1209\n" && fs::exists(device.path() / "bConfigurationValue") &&
        text_of(device.path() / "bConfigurationValue") == "1\n")
      return true;
  return false;
}

rig::Car car_of(const Way& way, UsbCar& device) {
  rig::Car car{.source = rig::CarSource::hid, .serial = "VM-1", .access = way.access};
  device.plug();
  REQUIRE(becomes_true([&] { return is_known(device); }));
  if (way.kind == UsbCar::Kind::vendor) car.usb = endpoints_of_car();
  return car;
}

/// Polls as a tick does until `wanted` holds of the reading.
template <class Wanted>
std::optional<double> time_until(CarConnection& car, Wanted wanted, double within_s = 30.0) {
  const double begun_s = now_s();
  while (now_s() - begun_s < within_s) {
    const CarReading reading = car.poll(now_s());
    if (wanted(reading)) return now_s() - begun_s;
    sleep_s(0.004);
  }
  return std::nullopt;
}

constexpr auto is_fresh = [](const CarReading& reading) { return reading.is_connected && !reading.is_stale; };

/// septet-car try, as another user if given.
pid_t start_trial(const std::string& car_table, uid_t user = 0) {
  const std::string rig = std::filesystem::temp_directory_path() / "rig.toml";
  std::ofstream(rig) << "name = \"r\"\neye_point_m = [1.35, 0.37, 1.17]\n[[screen]]\nname = \"a\"\n"
                        "lower_left_m = [2, 1, 0]\nlower_right_m = [2, -1, 0]\nupper_left_m = [2, 1, 1]\n[car]\n"
                     << car_table;
  const pid_t child = fork();
  if (child == 0) {
    if (user != 0 && (setgid(user) != 0 || setuid(user) != 0)) _exit(126);
    execl("/bin/septet-car", "septet-car", "try", "--rig", rig.c_str(), "--seconds", "60", "--fan", "0.5",
          "--vibration", "0.25", "--hz", "40", nullptr);
    _exit(127);
  }
  return child;
}

int end_of(pid_t child) {
  int status = 0;
  REQUIRE(waitpid(child, &status, 0) == child);
  return status;
}

}  // namespace

TEST_SUITE_BEGIN("usb");

TEST_CASE("a car is read and moved and its watchdog set whatever the way in") {
  for (const Way& way : ways) {
    CAPTURE(way.name);
    UsbCar device(way.kind);
    const OpenHidDevice open = hid_opener(car_of(way, device));
    DriverInput input;
    input.steering_wheel_rad = -1.0;
    input.accelerator = 0.5;
    input.brake = 0.25;
    device.set(input);
    CarConnection car(open, {});
    const auto found_s = time_until(car, is_fresh);
    const auto error = car.take_error();
    REQUIRE_MESSAGE(found_s.has_value(), (error ? describe(*error) : ""));
    const CarReading reading = car.poll(now_s());
    CHECK(reading.input.steering_wheel_rad == relative(-1.0, 0.001));
    CHECK(reading.input.accelerator == relative(0.5, 0.001));
    CHECK(reading.input.brake == relative(0.25, 0.001));

    // The driver's input arrives a few milliseconds later.
    input.accelerator = 1.0;
    device.set(input);
    const auto felt_s = time_until(car, [](const CarReading& r) { return r.input.accelerator > 0.99; });
    REQUIRE(felt_s.has_value());
    measured(fmt::format("pedal to reading, {}", way.name), *felt_s * 1000.0, "ms");
    CHECK(*felt_s < 0.03);

    {
      ActuatorWriter writer(open, {.has_steering_force = true});
      CHECK(becomes_true([&] {
        writer.set({.fan = 0.5, .vibration = 0.25, .vibration_hz = 40.0, .steering = -0.125});
        return device.actuators().steering != 0.0;
      }));
      CHECK(device.actuators().fan == relative(0.5, 0.001));
      CHECK(device.actuators().vibration_hz == 40.0);
      CHECK(device.actuators().steering == relative(-0.125, 0.001));
      CHECK(device.watchdog_ms() == 250);
      const auto fault = writer.take_error();
      CHECK_MESSAGE(!fault.has_value(), (fault ? describe(*fault) : ""));
      // Both at once, for a while.
      const double reading_since_s = now_s();
      bool was_stale = false;
      while (now_s() - reading_since_s < 1.0) {
        writer.set({.fan = 0.5});
        was_stale = car.poll(now_s()).is_stale || was_stale;
        sleep_s(0.008);
      }
      CHECK_FALSE(was_stale);
    }
    CHECK(device.actuators().fan == 0.0);
    CHECK(device.actuators().steering == 0.0);
  }
}

TEST_CASE("a car that is pulled out is released at once and found again when it is back whatever the way in") {
  for (const Way& way : ways) {
    CAPTURE(way.name);
    UsbCar device(way.kind);
    const OpenHidDevice open = hid_opener(car_of(way, device));
    DriverInput input;
    input.accelerator = 0.75;
    device.set(input);
    CarConnection car(open, {});
    ActuatorWriter writer(open, {});
    const auto drive_until = [&](auto wanted) {
      return time_until(car, [&](const CarReading& reading) {
        writer.set({.fan = 0.5});
        return wanted(reading);
      });
    };
    REQUIRE(drive_until(is_fresh).has_value());
    for (int time = 0; time < 3; ++time) {
      device.unplug();
      const auto lost_s =
          drive_until([](const CarReading& r) { return !r.is_connected && r.input.accelerator == 0.0; });
      REQUIRE(lost_s.has_value());
      measured(fmt::format("pulled out to pedals released, {}", way.name), *lost_s * 1000.0, "ms");
      CHECK(*lost_s < 0.1);
      const auto away_s = drive_until([&, since_s = now_s()](const CarReading&) { return now_s() - since_s > 0.7; });
      REQUIRE(away_s.has_value());
      device.plug();
      const auto found_s = drive_until(is_fresh);
      REQUIRE(found_s.has_value());
      measured(fmt::format("plugged in to driving again, {}", way.name), *found_s * 1000.0, "ms");
      CHECK(*found_s < 2.0);
      CHECK(drive_until([&](const CarReading&) { return device.actuators().fan > 0.49; }).has_value());
      CHECK(device.watchdog_ms() == 250);
    }
  }
}

TEST_CASE(
    "fan and shaker stop at the device in time when a simulation is silent and when a program is killed or stopped") {
  for (const Way& way : ways) {
    CAPTURE(way.name);
    UsbCar device(way.kind);
    const rig::Car rig_car = car_of(way, device);
    const auto time_to_rest = [&] {
      const double since_s = now_s();
      REQUIRE(becomes_true([&] { return device.actuators().fan == 0.0 && device.actuators().vibration == 0.0; }));
      return now_s() - since_s;
    };
    {
      ActuatorWriter writer(hid_opener(rig_car), {.sticky = true});
      REQUIRE(becomes_true([&] {
        writer.set({.fan = 0.5, .vibration = 0.5});
        return device.actuators().fan > 0.49;
      }));
      const double rest_s = time_to_rest();
      measured(fmt::format("silent simulation to rest, {}", way.name), rest_s * 1000.0, "ms");
      CHECK(rest_s < 0.42);
      CHECK(writer.take_error().has_value());
    }
    const std::string table =
        "source = \"hid\"\n" + (way.kind == UsbCar::Kind::vendor
                                    ? fmt::format("[car.usb]\nin = {}\nout = {}\n", rig_car.usb->in, rig_car.usb->out)
                                    : fmt::format("access = \"{}\"\n", way.name));
    for (const int signal : {SIGKILL, SIGSTOP, SIGTERM}) {
      CAPTURE(signal);
      const pid_t trial = start_trial(table);
      REQUIRE(becomes_true([&] { return device.actuators().fan > 0.49; }));
      kill(trial, signal);
      const double rest_s = time_to_rest();
      measured(fmt::format("program ended by signal {} to rest, {}", signal, way.name), rest_s * 1000.0, "ms");
      CHECK(rest_s < 0.28);
      if (signal == SIGSTOP) kill(trial, SIGKILL);
      const int status = end_of(trial);
      CHECK((signal != SIGTERM || WIFEXITED(status)));
    }
  }
}

TEST_CASE("where hidraw may not be opened libusb is the way in and where neither may the remedy is a rule") {
  UsbCar device(UsbCar::Kind::hid);
  device.plug();
  REQUIRE(becomes_true([] { return fs::exists("/dev/hidraw0"); }));
  constexpr uid_t somebody = 1000;
  const auto try_it = [&](const char* usb_mode) {
    command(std::string("chmod 600 /dev/hidraw* && chmod ") + usb_mode + " /dev/bus/usb/*/*");
    return start_trial("source = \"hid\"\n", somebody);
  };
  const pid_t refused = try_it("600");
  const int status = end_of(refused);
  CHECK((WIFEXITED(status) && WEXITSTATUS(status) == 1));
  CHECK(device.outputs() == 0);
  const pid_t trial = try_it("666");
  CHECK(becomes_true([&] { return device.actuators().fan > 0.49; }));
  kill(trial, SIGTERM);
  CHECK(WIFEXITED(end_of(trial)));
  CHECK(device.actuators().fan == 0.0);
  // The kernel has its interface back.
  CHECK(becomes_true([] { return fs::exists("/dev/hidraw0"); }));
}

TEST_CASE("a firmware that takes no outputs is told and read all the same") {
  for (const Way& way : {ways[1], ways[2]}) {
    CAPTURE(way.name);
    UsbCar device(way.kind);
    const OpenHidDevice open = hid_opener(car_of(way, device));
    CarConnection car(open, {});
    REQUIRE(time_until(car, is_fresh).has_value());
    device.hang(true);
    ActuatorWriter writer(open, {});
    std::optional<Error> fault;
    bool was_stale = false;
    REQUIRE(time_until(car, [&](const CarReading& reading) {
              was_stale = was_stale || reading.is_stale;
              writer.set({.fan = 0.5});
              if (!fault) fault = writer.take_error();
              return fault.has_value();
            }).has_value());
    CHECK(fault->what.starts_with("it takes no output reports"));
    CHECK_FALSE(was_stale);
  }
}

TEST_CASE("a device that is not what the rig says is refused by what it lacks") {
  UsbCar device(UsbCar::Kind::vendor);
  rig::Car car = car_of(ways[2], device);
  const auto what = [](const rig::Car& named) {
    const auto opened = hid_opener(named)();
    return opened ? std::string() : opened.error().what;
  };
  CHECK(what(car).empty());
  {
    const auto held = hid_opener(car)();
    REQUIRE(held.has_value());
    CHECK(what(car).starts_with("its interface 0 is not to be had"));
  }
  car.serial = "VM-2";
  CHECK(what(car) == "a device of this kind is plugged in, but with another serial number");
  car.serial = "VM-1";
  car.usb->out = 9;
  CHECK(what(car).starts_with("it has no interface 0 with the endpoints"));
  car.usb.reset();
  car.access = rig::HidAccess::libusb;
  CHECK(what(car) == "it is no HID device");
  device.unplug();
  CHECK(becomes_true([&] { return what(car) == "the device is not plugged in"; }));
}

TEST_SUITE_END();

}  // namespace septet::rig_vm
