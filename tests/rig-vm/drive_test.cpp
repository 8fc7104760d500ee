// The whole: septet-server and septet-car, the car on USB, its instruments on CAN.

#include <atomic>
#include <csignal>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <thread>
#include <utility>

#include <doctest/doctest.h>
#include <fmt/core.h>

#include "car-io/can/can_bus.hpp"
#include "car-io/can/dbc.hpp"
#include "car-io/can/signal_codec.hpp"
#include "tests/pipeline/process_rig.hpp"
#include "tests/rig-vm/guest.hpp"
#include "tests/rig-vm/usb_car.hpp"
#include "tests/rig-vm/virtual_can.hpp"

namespace septet::rig_vm {
namespace {

using namespace car_io;
namespace fs = std::filesystem;

/// The driver's cluster: the newest value of every signal.
class Cluster {
 public:
  explicit Cluster(const char* interface, const std::string& dbc = text_of("/source/rigs/cluster.dbc"),
                   bool is_fd = false) {
    auto database = dbc::read_dbc(dbc, "cluster.dbc");
    REQUIRE(database.has_value());
    database_ = *database;
    auto bus = open_socket_can(interface, is_fd);
    REQUIRE(bus.has_value());
    bus_ = std::move(*bus);
  }
  double operator[](const std::string& signal) {
    for (auto frame = bus_->receive(); frame && *frame; frame = bus_->receive())
      for (const dbc::Message& message : database_.messages)
        if (message.id == (*frame)->id && message.is_fd == (*frame)->is_fd)
          for (const dbc::Signal& each : message.signals)
            shown_[each.name] = dbc::decode(message, each, (*frame)->payload()).value_or(-1.0);
    return shown_[signal];
  }

 private:
  dbc::Database database_;
  std::unique_ptr<CanBus> bus_;
  std::map<std::string, double> shown_;
};

}  // namespace

TEST_SUITE_BEGIN("drive");

TEST_CASE(
    "a drive goes on while its car is pulled out and its programs are killed and hung and everything is safe "
    "meanwhile") {
  const TemporaryFolder folder;
  const VirtualCan can("vcan0");
  UsbCar device(UsbCar::Kind::hid);
  device.plug();
  Cluster cluster("vcan0");
  fs::copy_file("/source/rigs/cluster.dbc", folder / "cluster.dbc");
  pipeline::write_text(
      folder / "rig.toml",
      pipeline::small_rig(1, "",
                          "source = \"hid\"\nserial = \"VM-1\"\nmachine = \"car-pc\"\n[car.actuators]\n"
                          "fan_full_speed_mps = 20\nfan_least = 0.2\n[can]\ninterface = \"vcan0\"\ndbc = "
                          "\"cluster.dbc\""));
  const fs::path keys = pipeline::make_keys(folder / "keys", "a");
  const auto identity = net::load_or_create_identity(keys / "car.key");
  REQUIRE(identity.has_value());
  pipeline::write_text(keys / "allowed-clients",
                       text_of(keys / "allowed-clients") + net::to_text(identity->public_key()) + " car\n");
  auto server =
      pipeline::start("septet-server",
                      {"--rig", (folder / "rig.toml").string(), "--keys", keys.string(), "--out",
                       (folder / "out").string(), "--any-port", "--start-now", "--wait-for-screens", "2", "--seconds",
                       "600", "--scenario", "/source/tests/conformance/data/scenarios/xosc/velodrome.xosc"},
                      folder / "server.err");
  const std::string port = pipeline::ready_port(server, folder / "server.err");
  const auto start_car = [&] {
    return pipeline::start("septet-car", {"--server", "127.0.0.1:" + port, "--keys", keys.string()},
                           folder / "car.err");
  };
  auto car = start_car();

  DriverInput input;
  input.accelerator = 1.0;
  device.set(input);
  CHECK(becomes_true([&] { return cluster["speed_kmh"] > 15.0 && device.actuators().fan > 0.2; }, 60.0));
  const auto said_so_far = [&] { return text_of(folder / "server.err") + text_of(folder / "car.err"); };
  INFO(said_so_far());
  REQUIRE(cluster["speed_kmh"] > 15.0);
  CHECK(cluster["engine_rpm"] > 800.0);
  CHECK(cluster["ignition"] == 1.0);
  CHECK(cluster["controls_lost"] == 0.0);
  CHECK(device.watchdog_ms() == 250);

  // From the driver's action to the instruments' display.
  const double pressed_s = now_s();
  input.parking_brake = true;
  device.set(input);
  CHECK(becomes_true([&] { return cluster["parking_brake"] == 1.0; }));
  measured("hand brake to lamp, through USB, network, simulation and CAN", 1000.0 * (now_s() - pressed_s), "ms");
  CHECK(now_s() - pressed_s < 0.15);
  input.parking_brake = false;
  device.set(input);

  const auto time_until = [&](const auto& condition) {
    const double since_s = now_s();
    REQUIRE(becomes_true(condition));
    return now_s() - since_s;
  };
  const auto is_at_rest = [&] { return device.actuators().fan == 0.0 && device.actuators().vibration == 0.0; };

  device.unplug();
  const double told_s = time_until([&] { return cluster["controls_lost"] == 1.0; });
  measured("car pulled out to the lamp on the cluster", 1000.0 * told_s, "ms");
  CHECK(told_s < 0.2);
  // It has power of its own, and its watchdog.
  CHECK(time_until(is_at_rest) < 0.26);
  device.plug();
  const double back_s = time_until([&] { return cluster["controls_lost"] == 0.0; });
  measured("car plugged in to driving again, through septet-car", 1000.0 * back_s, "ms");
  CHECK(back_s < 2.0);
  // Sticky: no operator has confirmed.
  sleep_s(1.0);
  CHECK(is_at_rest());
  const double slow_kmh = cluster["speed_kmh"];
  CHECK(becomes_true([&] { return cluster["speed_kmh"] > slow_kmh + 3.0; }));

  // septet-car is killed: the device's watchdog, the cluster's lamp; another one takes its place.
  car.send_signal(SIGKILL);
  const double lost_s = time_until([&] { return cluster["controls_lost"] == 1.0; });
  measured("septet-car killed to the lamp on the cluster", 1000.0 * lost_s, "ms");
  CHECK(lost_s < 0.3);
  CHECK(time_until(is_at_rest) < 0.3);
  CHECK(pipeline::exit_code(car) != 0);
  car = start_car();
  CHECK(becomes_true([&] { return cluster["controls_lost"] == 0.0; }));

  // The server hangs: septet-car goes on, and the instruments fall silent with it.
  CHECK(becomes_true([&] { return cluster["speed_kmh"] > 5.0; }));
  server.send_signal(SIGSTOP);
  CHECK(time_until(is_at_rest) < 0.42);
  sleep_s(1.0);
  CHECK(is_at_rest());
  server.send_signal(SIGCONT);
  const double before_kmh = cluster["speed_kmh"];
  CHECK(becomes_true([&] { return cluster["speed_kmh"] > before_kmh + 3.0; }));

  server.send_signal(SIGTERM);
  CHECK(pipeline::exit_code(server) == 3);
  CHECK(pipeline::exit_code(car) == 0);
  CHECK(becomes_true([&] { return cluster["ignition"] == 0.0; }));
  CHECK(is_at_rest());
  const std::string said = said_so_far();
  CHECK(said.find("wheel force are cut, for the controls have stopped") != std::string::npos);
  CHECK(said.find("the simulation was silent for 200 ms") != std::string::npos);
  for (const char* file : {"session.sqlite", "summary.json", "report.html"}) CHECK(fs::exists(folder / "out" / file));
}

TEST_CASE(
    "a car whose controls and instruments are CAN FD frames has its fan and shaker on USB and is safe when a node is "
    "silent") {
  const TemporaryFolder folder;
  const VirtualCan can("vcan0");
  UsbCar device(UsbCar::Kind::hid);
  device.plug();
  // Septet's own messages, each of them CAN FD.
  std::string dbc = text_of("/source/rigs/cluster.dbc");
  for (const int id : {256, 257, 258, 259, 512, 513, 514}) dbc += fmt::format("BA_ \"VFrameFormat\" BO_ {} 14;\n", id);
  pipeline::write_text(folder / "cluster.dbc", dbc);
  pipeline::write_text(
      folder / "rig.toml",
      pipeline::small_rig(1, "",
                          "source = \"can\"\nserial = \"VM-1\"\n[car.actuators]\nfan_full_speed_mps = 20\nfan_least = "
                          "0.2\n[can]\ninterface = \"vcan0\"\ndbc = \"cluster.dbc\""));
  Cluster cluster("vcan0", dbc, true);
  const auto database = dbc::read_dbc(dbc, "cluster.dbc");
  auto node = open_socket_can("vcan0", true);
  REQUIRE((database.has_value() && node.has_value()));
  const auto send = [&](const char* name, const char* signal, double value) {
    const auto& message = *dbc::find_message(*database, name);
    CanFrame frame{message.id, false, message.is_fd, message.bytes, {}};
    CHECK(frame.is_fd);
    dbc::encode(*dbc::find_signal(message, signal), value, frame.data);
    (void)(*node)->send(frame);
  };
  std::atomic<bool> has_ended = false, is_silent = false, is_rearming = false;
  std::thread controls([&] {
    for (; !has_ended; sleep_s(0.01)) {
      if (is_silent) continue;
      send("STEERING", "steering_wheel_deg", 0.0);
      send("PEDALS", "accelerator_percent", 100.0);
      const auto& stalks = *dbc::find_message(*database, "STALKS");
      CanFrame frame{stalks.id, false, true, stalks.bytes, {}};
      dbc::encode(*dbc::find_signal(stalks, "selector_position"), 3.0, frame.data);
      dbc::encode(*dbc::find_signal(stalks, "rearm_switch"), is_rearming ? 1.0 : 0.0, frame.data);
      (void)(*node)->send(frame);
    }
  });
  auto server = pipeline::start(
      "septet-server",
      {"--rig", (folder / "rig.toml").string(), "--keys", pipeline::make_keys(folder / "keys", "a").string(), "--out",
       (folder / "out").string(), "--any-port", "--start-now", "--wait-for-screens", "2", "--seconds", "600",
       "--scenario", "/source/tests/conformance/data/scenarios/xosc/velodrome.xosc"},
      folder / "server.err");
  const bool drives = becomes_true([&] { return cluster["speed_kmh"] > 15.0 && device.actuators().fan > 0.2; }, 60.0);
  CHECK_MESSAGE(drives, text_of(folder / "server.err"));
  CHECK(cluster["engine_rpm"] > 800.0);
  CHECK(device.watchdog_ms() == 250);

  is_silent = true;
  const double since_s = now_s();
  CHECK(becomes_true([&] { return device.actuators().fan == 0.0 && device.actuators().vibration == 0.0; }));
  measured("silent CAN node to fan and shaker at rest", 1000.0 * (now_s() - since_s), "ms");
  CHECK(now_s() - since_s < 0.36);
  is_silent = false;
  sleep_s(1.0);
  CHECK(device.actuators().fan == 0.0);  // Not re-armed.
  is_rearming = true;
  CHECK(becomes_true([&] { return device.actuators().fan > 0.2; }, 5.0));
  has_ended = true;
  controls.join();
  server.send_signal(SIGTERM);
  CHECK(pipeline::exit_code(server) == 3);
  CHECK(device.actuators().fan == 0.0);
}

TEST_SUITE_END();

}  // namespace septet::rig_vm
