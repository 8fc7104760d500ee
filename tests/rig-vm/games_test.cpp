// A commercial game on the rig: septet-car serve as its wheel, the car on USB, telemetry over a socket of the kernel;
// and septet-car test.

#include <arpa/inet.h>
#include <fcntl.h>
#include <linux/input.h>
#include <netinet/in.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <csignal>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <string>
#include <string_view>
#include <thread>

#include <doctest/doctest.h>

#include "tests/pipeline/process_rig.hpp"
#include "tests/rig-vm/guest.hpp"
#include "tests/rig-vm/usb_car.hpp"

namespace septet::rig_vm {
namespace {

namespace fs = std::filesystem;

/// The wheel as a game opens it, by its name.
class GameWheel {
 public:
  GameWheel() {
    const auto find = [this] {
      for (int number = 0; number < 64 && file_ < 0; ++number) {
        const int file = open(("/dev/input/event" + std::to_string(number)).c_str(), O_RDWR | O_NONBLOCK | O_CLOEXEC);
        std::array<char, 80> name{};
        if (file < 0) continue;
        if (ioctl(file, EVIOCGNAME(name.size() - 1), name.data()) >= 0 &&
            std::string_view(name.data()) == "Septet game wheel")
          file_ = file;
        else
          close(file);
      }
      return file_ >= 0;
    };
    REQUIRE(becomes_true(find));
  }
  ~GameWheel() { close(file_); }
  GameWheel(const GameWheel&) = delete;
  GameWheel& operator=(const GameWheel&) = delete;

  /// −1 to 1 of the axis' range.
  double place(int axis) const {
    input_absinfo info{};
    REQUIRE(ioctl(file_, EVIOCGABS(static_cast<unsigned>(axis)), &info) == 0);
    return 2.0 * (info.value - info.minimum) / (info.maximum - info.minimum) - 1.0;
  }
  /// A constant force that plays until it is another; `share` −1 to 1.
  void push(double share) {
    effect_.type = FF_CONSTANT;
    effect_.direction = 0x4000;  // To the left.
    effect_.u.constant.level = static_cast<std::int16_t>(share * 32767.0);
    REQUIRE(ioctl(file_, EVIOCSFF, &effect_) == 0);
    input_event play{};
    play.type = EV_FF;
    play.code = static_cast<std::uint16_t>(effect_.id);
    play.value = 1;
    REQUIRE(write(file_, &play, sizeof play) == static_cast<ssize_t>(sizeof play));
  }

 private:
  int file_ = -1;
  ff_effect effect_ = [] {
    ff_effect effect{};
    effect.id = -1;
    return effect;
  }();
};

/// A game at 90 km/h that sends it fifty times a second while `tells` is true.
class Telemetry {
 public:
  Telemetry() : file_(socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0)) {
    REQUIRE(file_ >= 0);
    thread_ = std::thread([this] {
      sockaddr_in to{};
      to.sin_family = AF_INET;
      to.sin_port = htons(30000);
      to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
      std::array<char, 96> packet{};
      const float speed_mps = 25.0f, engine_rpm = 3000.0f;
      packet[10] = 4;
      std::memcpy(packet.data() + 12, &speed_mps, sizeof speed_mps);
      std::memcpy(packet.data() + 16, &engine_rpm, sizeof engine_rpm);
      for (; !is_ending_; sleep_s(0.02))
        if (tells)
          (void)sendto(file_, packet.data(), packet.size(), 0, reinterpret_cast<const sockaddr*>(&to), sizeof to);
    });
  }
  ~Telemetry() {
    is_ending_ = true;
    thread_.join();
    close(file_);
  }
  Telemetry(const Telemetry&) = delete;
  Telemetry& operator=(const Telemetry&) = delete;

  std::atomic<bool> tells = true;

 private:
  int file_;
  std::atomic<bool> is_ending_ = false;
  std::thread thread_;
};

fs::path rig_with_motor(const fs::path& folder) {
  pipeline::write_text(folder / "rig.toml",
                       pipeline::small_rig(1, "",
                                           "source = \"hid\"\nserial = \"VM-1\"\n[car.actuators]\nfan_full_speed_mps = "
                                           "30\nfan_least = 0.2\nsteering_most = 0.6"));
  return folder / "rig.toml";
}

/// Plugged in, and known to the kernel.
void plug(UsbCar& device) {
  device.plug();
  REQUIRE(becomes_true([] {
    for (const auto& entry : fs::directory_iterator("/sys/class/hidraw"))
      if (text_of(entry.path() / "device/uevent").find("HID_UNIQ=VM-1") != std::string::npos)
        return fs::exists("/dev" / entry.path().filename());
    return false;
  }));
}

double time_until(const std::function<bool()>& condition) {
  const double since_s = now_s();
  REQUIRE(becomes_true(condition));
  return now_s() - since_s;
}

}  // namespace

TEST_SUITE_BEGIN("games");

TEST_CASE(
    "a game has the car for a wheel, moves its fan, shaker and motor, and whatever falls silent leaves them at rest") {
  const TemporaryFolder folder;
  UsbCar device(UsbCar::Kind::hid);
  plug(device);
  auto car =
      pipeline::start("septet-car", {"serve", "--rig", rig_with_motor(folder.path()).string(), "--game", "outgauge"},
                      folder / "car.err");
  const auto said = [&] { return text_of(folder / "car.err"); };
  INFO(said());
  GameWheel wheel;

  DriverInput input;
  input.steering_wheel_rad = 2.0;
  input.accelerator = 1.0;
  device.set(input);
  CHECK(becomes_true([&] { return std::abs(wheel.place(ABS_X)) > 0.1 && wheel.place(ABS_Z) > 0.9; }));

  Telemetry game;
  wheel.push(0.8);
  const auto is_moved = [&] {
    const auto now = device.actuators();
    return now.fan > 0.3 && now.vibration > 0.0 && std::abs(now.steering) > 0.1;
  };
  const auto is_at_rest = [&] { return device.actuators().fan == 0.0 && device.actuators().vibration == 0.0; };
  const auto has_no_force = [&] { return std::abs(device.actuators().steering) < 0.02; };
  CHECK(becomes_true(is_moved));
  INFO(device.actuators().fan, " ", device.actuators().vibration, " ", device.actuators().steering);
  CHECK(std::abs(device.actuators().steering) <= 0.61);

  // The game hangs, with its force on.
  game.tells = false;
  const double silent_s = time_until([&] { return is_at_rest() && has_no_force(); });
  measured("a game's telemetry stopped to fan, shaker and wheel at rest", 1000.0 * silent_s, "ms");
  CHECK(silent_s < 0.45);
  game.tells = true;
  CHECK(becomes_true(is_moved));

  // septet-car hangs: the device's watchdog.
  car.send_signal(SIGSTOP);
  const double hung_s = time_until([&] { return is_at_rest() && device.actuators().steering == 0.0; });
  measured("septet-car serve hung to fan, shaker and wheel at rest", 1000.0 * hung_s, "ms");
  CHECK(hung_s < 0.3);
  // It goes on, and everything waits until the re-arm button has been held for a second.
  car.send_signal(SIGCONT);
  CHECK(becomes_true([&] { return said().find("for septet-car was silent") != std::string::npos; }));
  const auto moves_at_all = [&] { return !is_at_rest() || device.actuators().steering != 0.0; };
  bool has_moved = false;
  for (const double until_s = now_s() + 1.0; now_s() < until_s; sleep_s(0.01)) has_moved = has_moved || moves_at_all();
  CHECK_FALSE(has_moved);
  device.set(input, {.rearm = true});
  CHECK(becomes_true(is_moved));
  device.set(input);

  car.send_signal(SIGTERM);
  CHECK(pipeline::exit_code(car) == 0);
  CHECK(is_at_rest());
  CHECK(said().find("games find the wheel") != std::string::npos);
}

TEST_CASE("septet-car test moves fan, shaker and wheel one after the other and leaves them at rest") {
  const TemporaryFolder folder;
  UsbCar device(UsbCar::Kind::hid);
  plug(device);
  auto car = pipeline::start(
      "septet-car", {"test", "--rig", rig_with_motor(folder.path()).string(), "--seconds", "0.5"}, folder / "car.err");
  INFO(text_of(folder / "car.err"));
  double fan = 0.0, vibration = 0.0, left = 0.0, right = 0.0;
  int at_once = 0;
  const auto is_over = [&] {
    const auto now = device.actuators();
    fan = std::max(fan, now.fan);
    vibration = std::max(vibration, now.vibration);
    left = std::max(left, now.steering);
    right = std::min(right, now.steering);
    at_once = std::max(at_once, int{now.fan > 0.0} + int{now.vibration > 0.0} + int{now.steering != 0.0});
    return text_of(folder / "car.err").find("all is off again") != std::string::npos;
  };
  CHECK(becomes_true(is_over, 60.0));
  CHECK(pipeline::exit_code(car) == 0);
  CHECK(fan > 0.1);
  CHECK(vibration > 0.05);
  CHECK(left > 0.02);
  CHECK(right < -0.02);
  CHECK(at_once == 1);
  const auto now = device.actuators();
  CHECK((now.fan == 0.0 && now.vibration == 0.0 && now.steering == 0.0));
}

TEST_SUITE_END();

}  // namespace septet::rig_vm
