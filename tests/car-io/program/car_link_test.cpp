#include "car-io/program/car_link.hpp"

#include <chrono>
#include <thread>

#include <doctest/doctest.h>

#include "car-io/simulated_hid_device.hpp"
#include "engine/scene/store.hpp"
#include "sim-server/host/screen_host.hpp"
#include "tests/car-io/car_side.hpp"
#include "tests/engine/net/bad_network.hpp"
#include "tests/engine/net/simulated_machine.hpp"
#include "tests/relative.hpp"

namespace septet::car_io {
namespace {

constexpr const char* rig_text =
    "name = \"r\"\neye_point_m = [1.35, 0.37, 1.17]\n[car]\nsource = \"hid\"\nmachine = "
    "\"car-pc\"\n"
    "[[screen]]\nname = \"a\"\nlower_left_m = [2, 1, 0]\nlower_right_m = [2, -1, 0]\nupper_left_m "
    "= [2, 1, 1]\n";

/// A car's machine and the server on a network, each with a clock of its own, and the device in the car.
struct Rig {
  net::BadNetwork network;
  Random random{5};
  net::Address server_address{0x0a000001, 4750};
  std::unique_ptr<net::SimulatedMachine> server_machine = net::machine_of_its_own(network, server_address.ip,
                                                                                  server_address.ip, random),
                                         car_machine =
                                             net::machine_of_its_own(network, 0x0a000002, server_address.ip, random);
  net::Identity server_identity = net::Identity::generate(), car_identity = net::Identity::generate();
  std::unique_ptr<net::DatagramSocket> lane, tick, car_socket;
  scene::Store store;
  std::shared_ptr<server::RemoteCar> remote = std::make_shared<server::RemoteCar>();
  std::unique_ptr<server::ScreenHost> host;
  SimulatedHidPort port;
  std::unique_ptr<CarLink> link;
  std::unique_ptr<CarConnection> at_server;
  double now_s = 0.0;  ///< True time.
  std::uint8_t sequence = 0;
  double accelerator = 0.5;

  explicit Rig(const net::NetworkFaults& faults = {}, const std::string& name = "car") : network(faults, 1) {
    lane = server_machine->open(server_address.port);
    tick = server_machine->open(4999);
    car_socket = car_machine->open(5000);
    server::ScreenHostOptions options{.identity = server_identity, .session = net::random_session_id()};
    options.allowed.push_back({car_identity.public_key(), name});
    options.welcome.rig = rig_text;
    options.car = remote;
    host = std::make_unique<server::ScreenHost>(*lane, *tick, store, std::move(options));
    link = std::make_unique<CarLink>(
        *car_socket, net::SecureClientOptions{server_address, server_identity.public_key(), car_identity, {}},
        [this](const rig::Car&) { return port.opener(); });
    at_server =
        std::make_unique<CarConnection>(remote->device.opener(), CarConnectionOptions{.repeats = true, .retry_s = 0.0});
  }

  /// The device reports a hundred times a second, the server ticks a hundred times a second.
  CarReading run_for(double seconds) {
    CarReading reading;
    for (int ms = 0; ms < static_cast<int>(seconds * 1000.0 + 0.5); ++ms) {
      now_s += 0.001;
      network.advance_to(now_s);
      if (ms % 10 == 0) {
        DriverInput input;
        input.accelerator = accelerator;
        input.sequence = ++sequence;
        port.send(encode_controls(input));
      }
      link->pump(car_machine->clock_s(now_s));
      host->pump(server_machine->clock_s(now_s));
      if (ms % 10 == 5) reading = poll();
    }
    return reading;
  }
  CarReading poll() { return at_server->poll(server_machine->clock_s(now_s)); }
};

bool has(const std::vector<std::string>& messages, const std::string& part) {
  for (const auto& message : messages)
    if (message.find(part) != std::string::npos) return true;
  return false;
}

}  // namespace

TEST_CASE("the controls of a car on another machine reach the server as the device sent them") {
  Rig rig;
  rig.port.plug();
  const CarReading reading = rig.run_for(1.0);
  CHECK(reading.is_connected);
  CHECK_FALSE(reading.is_stale);
  CHECK(reading.input.accelerator == relative(0.5, 1e-4));
  CHECK(rig.at_server->refused_reports() == 0);
}

TEST_CASE("a network that loses and reorders a tenth of the datagrams does not make the car stale") {
  Rig rig({.loss = 0.1, .latency_s = 0.002, .jitter_s = 0.015});
  rig.port.plug();
  rig.run_for(1.0);
  for (int i = 0; i < 20; ++i) CHECK_FALSE(rig.run_for(0.1).is_stale);
}

TEST_CASE("a device that is lost mid-drive is one message at either end and comes back by itself") {
  Rig rig;
  rig.port.plug();
  rig.run_for(1.0);
  rig.link->take_messages();
  rig.at_server->take_error();
  rig.port.unplug();
  CarReading reading = rig.run_for(1.0);
  CHECK_FALSE(reading.is_connected);
  CHECK(reading.is_stale);
  CHECK(reading.input.accelerator == 0.0);
  const auto messages = rig.link->take_messages();
  CHECK(messages.size() <= 2);  // It is gone, and it is not plugged in when asked for again.
  CHECK(has(messages, "no such device"));
  CHECK(rig.at_server->take_error().has_value());
  rig.port.plug();
  reading = rig.run_for(1.0);
  CHECK_FALSE(reading.is_stale);
  CHECK(reading.input.accelerator == relative(0.5, 1e-4));
  CHECK(has(rig.link->take_messages(), "the device is there"));
}

TEST_CASE("feedback of the server turns the fan of the device") {
  Rig rig;
  rig.port.plug();
  rig.run_for(0.5);
  double fan = 0.0;
  for (int i = 0; i < 50000 && fan < 0.59; ++i) {
    rig.remote->feedback = control::CarFeedback{static_cast<Tick>(i + 1), 0.6f, 0.2f, 30.0f, 0.0f};
    rig.run_for(0.01);
    std::this_thread::sleep_for(std::chrono::milliseconds(5));  // The writer has a thread and a clock of its own.
    for (const Bytes& report : rig.port.take_written())
      if (const auto actuators = decode_actuators(report)) fan = actuators->fan;
  }
  CHECK(fan == relative(0.6, 1e-3));
}

TEST_CASE("whoever re-arms at the car's own machine holds the button for a second and a third") {
  Rig rig;
  rig.port.plug();
  CHECK_FALSE(rig.run_for(0.5).switches.rearm);
  rig.link->rearm(rig.car_machine->clock_s(rig.now_s));
  CHECK(rig.run_for(0.1).switches.rearm);
  CHECK(rig.run_for(1.1).switches.rearm);
  CHECK_FALSE(rig.run_for(0.2).switches.rearm);
  CHECK(rig.poll().input.accelerator == relative(0.5, 1e-4));
}

TEST_CASE("a client whose key is not called car is refused as a car") {
  Rig rig({}, "screen-1");
  rig.port.plug();
  rig.run_for(0.5);
  REQUIRE(rig.link->refusal().has_value());
  CHECK(rig.link->refusal()->what.find("allowed-clients") != std::string::npos);
  CHECK(rig.poll().is_stale);
}

TEST_CASE("a car whose device is missing at the start says so and does not drive") {
  Rig rig;
  rig.run_for(0.5);
  REQUIRE(rig.link->refusal().has_value());
  CHECK(rig.link->refusal()->what == "the device is not plugged in");
}

}  // namespace septet::car_io
