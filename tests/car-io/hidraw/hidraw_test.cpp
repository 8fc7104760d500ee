// Runs under umockdev-wrapper: libudev, open, read, write and ioctl see the devices of the testbed.

#include <chrono>
#include <csignal>
#include <fstream>
#include <memory>
#include <string>

#include <doctest/doctest.h>
#include <fmt/core.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <sys/wait.h>
#include <unistd.h>
// After the system's headers, whose macros glib undoes.
#include <umockdev.h>

#include "car-io/car_connection.hpp"
#include "car-io/car_report.hpp"
#include "car-io/hid_device.hpp"
#include "tests/car-io/car_side.hpp"
#include "tests/checkout.hpp"
#include "tests/relative.hpp"
#include "tests/temporary_folder.hpp"
#include "tests/why_not.hpp"

namespace septet::car_io {
namespace {

std::string hex_of(std::span<const std::uint8_t> bytes) {
  std::string hex;
  for (const std::uint8_t byte : bytes) hex += fmt::format("{:02X}", byte);
  return hex;
}

/// A hidraw device of the testbed: Septet's car as the kernel would show it.
class MockedCar {
 public:
  ~MockedCar() {
    if (testbed_) unplug();
  }

  /// Every plug is a new hidraw node, as with the kernel while the old one is still open, in a new
  /// testbed, because umockdev keeps a removed device's node.
  void plug(const std::string& serial) {
    testbed_ = umockdev_testbed_new();
    ++minor_;
    const std::string node = fmt::format("/dev/hidraw{}", minor_);
    const auto descriptor = car_report_descriptor();
    add(
        fmt::format("P: {}\nE: SUBSYSTEM=hid\nE: HID_ID=0003:00001209:00000001\nE: HID_NAME=Septet "
                    "car\nE: HID_UNIQ={}\n"
                    "H: report_descriptor={}\n",
                    hid_path, serial, hex_of(descriptor)));
    add(
        fmt::format("P: {}\nN: hidraw{}\nE: DEVNAME={}\nE: SUBSYSTEM=hidraw\nE: MAJOR=240\nE: "
                    "MINOR={}\nA: dev=240:{}\\n\n"
                    "L: device=../../../0003:1209:0001.0001\n",
                    hidraw_path(), minor_, node, minor_, minor_));
    // hidapi recognises a hidraw device by this ioctl.
    GError* error = nullptr;
    const std::string ioctls =
        fmt::format("@DEV {} (HIDRAW)\nHIDIOCGRDESCSIZE 0 {:02X}000000\n", node, descriptor.size());
    const std::string path = std::string(umockdev_testbed_get_root_dir(testbed_)) + "/ioctls";
    REQUIRE(g_file_set_contents(path.c_str(), ioctls.c_str(), -1, &error));
    REQUIRE_MESSAGE(umockdev_testbed_load_ioctl(testbed_, node.c_str(), path.c_str(), &error),
                    (error ? error->message : ""));
    fd_ = umockdev_testbed_get_dev_fd(testbed_, node.c_str());
    REQUIRE(fd_ >= 0);
  }
  void unplug() {
    close(fd_);
    g_object_unref(testbed_);
    testbed_ = nullptr;
  }
  void send(std::span<const std::byte> report) {
    REQUIRE(write(fd_, report.data(), report.size()) == static_cast<ssize_t>(report.size()));
  }
  bool has_report() const {
    pollfd waiting{fd_, POLLIN, 0};
    return poll(&waiting, 1, 0) > 0;
  }
  Bytes receive() {
    // The mocked node is a stream: one read may return several reports, so the length of one is read.
    Bytes bytes(actuators_report_bytes);
    const ssize_t count = read(fd_, bytes.data(), bytes.size());
    bytes.resize(static_cast<std::size_t>(std::max<ssize_t>(count, 0)));
    return bytes;
  }

 private:
  void add(const std::string& description) {
    GError* error = nullptr;
    const bool added = umockdev_testbed_add_from_string(testbed_, description.c_str(), &error);
    REQUIRE_MESSAGE(added, (error ? error->message : ""));
  }
  std::string hidraw_path() const { return fmt::format("{}/hidraw/hidraw{}", hid_path, minor_); }

  static constexpr const char* hid_path = "/devices/virtual/misc/uhid/0003:1209:0001.0001";
  UMockdevTestbed* testbed_ = nullptr;
  int minor_ = -1;
  int fd_ = -1;
};

/// Polls until `wanted`, or for as long as only a hang takes.
template <class Wanted>
CarReading poll_until(CarConnection& car, Wanted wanted) {
  CarReading reading;
  for (int i = 0; i < 60'000; ++i) {
    reading = car.poll(i * 0.005);
    if (wanted(reading)) break;
    usleep(5000);
  }
  return reading;
}

}  // namespace

TEST_CASE("hidapi finds reads writes and loses a car and the connection finds it again") {
  MockedCar mocked;
  CarConnection car([] { return open_hid_device({.vendor_id = 0x1209, .product_id = 0x0001, .serial = "S80-1"}); }, {});
  CHECK_FALSE(car.poll(0.0).is_connected);
  CHECK(car.take_error().value().what == "the device is not plugged in");

  mocked.plug("S80-1");
  const CarReading connected = poll_until(car, [](const CarReading& r) { return r.is_connected; });
  const auto error = car.take_error();
  REQUIRE_MESSAGE(connected.is_connected, (error ? describe(*error) : ""));

  DriverInput input;
  input.accelerator = 0.5;
  input.sequence = 9;
  const auto report = encode_controls(input);
  mocked.send(report);
  const CarReading read = poll_until(car, [](const CarReading& r) { return r.report.has_value(); });
  CHECK(read.report == Bytes(report.begin(), report.end()));
  CHECK(read.input.accelerator == relative(0.5, 1e-4));
  CHECK_FALSE(read.is_stale);

  const auto actuators = encode_actuators({.fan = 0.25}, 1);
  {
    // Like the writing thread: a second handle on the same device.
    const auto writer = open_hid_device(HidAddress{});
    REQUIRE(writer.has_value());
    REQUIRE((*writer)->write(actuators));
  }
  CHECK(mocked.receive() == Bytes(actuators.begin(), actuators.end()));

  mocked.unplug();
  const CarReading lost = poll_until(car, [](const CarReading& r) { return !r.is_connected; });
  CHECK_FALSE(lost.is_connected);
  CHECK(lost.input.accelerator == 0.0);
  CHECK(car.take_error().has_value());

  mocked.plug("S80-1");
  CHECK(poll_until(car, [](const CarReading& r) { return r.is_connected; }).is_connected);
}

TEST_CASE("a car with another serial number is told apart") {
  MockedCar mocked;
  mocked.plug("S80-2");
  const auto device = open_hid_device({.vendor_id = 0x1209, .product_id = 0x0001, .serial = "S80-1"});
  REQUIRE_FALSE(device.has_value());
  CHECK(device.error().what == "a device of this kind is plugged in, but with another serial number");
  const auto any = open_hid_device({});
  CHECK_MESSAGE(any.has_value(), why_not(any));
}

TEST_CASE("a closed terminal stops fan and shaker as Ctrl-C does, also where the program was stopped") {
  for (const auto& [signal, is_stopped] :
       {std::pair(SIGHUP, false), std::pair(SIGTERM, false), std::pair(SIGHUP, true)}) {
    CAPTURE(signal);
    CAPTURE(is_stopped);
    MockedCar mocked;
    mocked.plug("S80-1");
    const TemporaryFolder folder;
    const std::string rig = (folder / "rig.toml").string();
    std::ofstream(rig)
        << "name = \"r\"\neye_point_m = [1.35, 0.37, 1.17]\n[car]\nsource = \"hid\"\n[[screen]]\nname = \"a\"\n"
           "lower_left_m = [2, 1, 0]\nlower_right_m = [2, -1, 0]\nupper_left_m = [2, 1, 1]\n";
    const std::string program = build_folder() + "/septet-car";
    const pid_t child = fork();
    if (child == 0) {
      execl(program.c_str(), "septet-car", "try", "--rig", rig.c_str(), "--seconds", "60", "--fan", "0.5",
            "--vibration", "0.25", nullptr);
      _exit(127);
    }
    double fan = -1.0, vibration = -1.0;
    const auto read_reports = [&] {
      for (int i = 0; i < 100 && mocked.has_report(); ++i)
        if (const auto actuators = decode_actuators(mocked.receive()))
          fan = actuators->fan, vibration = actuators->vibration;
    };
    int status = 0;
    bool ended = false;
    const auto wait_for = [&](auto condition) {
      for (int i = 0; i < 60'000 && !condition(); ++i) {
        ended = ended || waitpid(child, &status, WNOHANG) == child;
        read_reports();
        usleep(5000);
      }
      return condition();
    };
    CHECK(wait_for([&] { return fan > 0.49 || ended; }));
    REQUIRE_FALSE(ended);
    // A stopped program can do nothing (that is what the device's watchdog is for); the signal is obeyed once it goes
    // on.
    if (is_stopped) {
      kill(child, SIGSTOP);
      REQUIRE(waitpid(child, &status, WUNTRACED) == child);
    }
    kill(child, signal);
    if (is_stopped) kill(child, SIGCONT);
    CHECK(wait_for([&] { return ended; }));
    if (!ended) kill(child, SIGKILL);
    // The last command may still be in the mocked kernel.
    wait_for([&] { return fan == 0.0 && vibration == 0.0; });
    CHECK(WIFEXITED(status));
    CHECK(fan == 0.0);
    CHECK(vibration == 0.0);
  }
}

}  // namespace septet::car_io
