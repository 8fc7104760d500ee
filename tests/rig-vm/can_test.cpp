// SocketCAN of the kernel: virtual interfaces, with and without CAN FD.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <doctest/doctest.h>
#include <linux/can.h>
#include <linux/can/error.h>
#include <linux/can/raw.h>
#include <net/if.h>
#include <sys/socket.h>
#include <unistd.h>

#include "car-io/can/can_bus.hpp"
#include "car-io/can/can_controls.hpp"
#include "car-io/can/can_plan.hpp"
#include "car-io/can/dbc.hpp"
#include "car-io/can/instrument_sender.hpp"
#include "car-io/can/signal_codec.hpp"
#include "car-io/car_connection.hpp"
#include "tests/relative.hpp"
#include "tests/rig-vm/guest.hpp"
#include "tests/rig-vm/virtual_can.hpp"
#include "tests/shipped_files.hpp"
#include "tests/why_not.hpp"

namespace septet::rig_vm {
namespace {

using namespace car_io;

/// Another node on the bus, which uses the kernel's own structures.
class Peer {
 public:
  explicit Peer(const char* interface) : socket_(::socket(PF_CAN, SOCK_RAW | SOCK_NONBLOCK, CAN_RAW)) {
    const int on = 1;
    sockaddr_can address{};
    address.can_family = AF_CAN;
    address.can_ifindex = static_cast<int>(if_nametoindex(interface));
    REQUIRE(setsockopt(socket_, SOL_CAN_RAW, CAN_RAW_FD_FRAMES, &on, sizeof on) == 0);
    REQUIRE(bind(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0);
  }
  ~Peer() { close(socket_); }
  Peer(const Peer&) = delete;
  Peer& operator=(const Peer&) = delete;

  template <class Frame>
  void send(const Frame& frame) {
    REQUIRE(write(socket_, &frame, sizeof frame) == static_cast<ssize_t>(sizeof frame));
  }
  /// The next frame, which may be on its way through the kernel, and its size.
  std::pair<canfd_frame, std::size_t> await() {
    std::pair<canfd_frame, std::size_t> received;
    CHECK(becomes_true([&] { return (received = receive()).second > 0; }));
    return received;
  }
  /// The next frame and its size, or a size of 0.
  std::pair<canfd_frame, std::size_t> receive() {
    canfd_frame frame{};
    const ssize_t size = read(socket_, &frame, sizeof frame);
    return {frame, static_cast<std::size_t>(std::max<ssize_t>(size, 0))};
  }

 private:
  int socket_;
};

/// The next frame for this bus, likewise.
CanFrame await(CanBus& bus) {
  std::optional<CanFrame> frame;
  CHECK(becomes_true([&] {
    auto received = bus.receive();
    REQUIRE(received.has_value());
    frame = *received;
    return frame.has_value();
  }));
  return frame.value_or(CanFrame{});
}

dbc::Database cluster() {
  auto database = dbc::read_dbc(text_of("/source/rigs/cluster.dbc"), "cluster.dbc");
  REQUIRE_MESSAGE(database.has_value(), why_not(database));
  return *database;
}

OpenCanBus opener(const std::string& interface) {
  return [interface] { return open_socket_can(interface, false); };
}

/// A cluster's view of one message.
struct Seen {
  std::vector<double> at_s;
  std::vector<double> counters;
  double newest = 0.0;  ///< Of its first signal.
};

void look(Peer& peer, const dbc::Message& message, Seen& seen) {
  for (auto [frame, size] = peer.receive(); size > 0; std::tie(frame, size) = peer.receive()) {
    if (frame.can_id != message.id) continue;
    const auto data = std::as_bytes(std::span(frame.data, frame.len));
    seen.at_s.push_back(now_s());
    seen.counters.push_back(dbc::decode(message, *dbc::find_signal(message, "counter"), data).value());
    seen.newest = dbc::decode(message, message.signals.front(), data).value();
  }
}

}  // namespace

TEST_SUITE_BEGIN("can");

TEST_CASE("classic and FD frames of both lengths of identifier pass the kernel in both directions") {
  const VirtualCan interface("vcan0");
  auto bus = open_socket_can("vcan0", true);
  REQUIRE_MESSAGE(bus.has_value(), why_not(bus));
  Peer peer("vcan0");
  CanFrame classic{0x1ABCDEF, true, false, 8, {}}, fd{0x7FF, false, true, 64, {}};
  for (std::size_t i = 0; i < 64; ++i) fd.data[i] = static_cast<std::byte>(i * 3);
  std::copy_n(fd.data.begin(), 8, classic.data.begin());
  REQUIRE((*bus)->send(classic).value());
  REQUIRE((*bus)->send(fd).value());
  const auto [first, first_size] = peer.await();
  const auto [second, second_size] = peer.await();
  CHECK(
      (first_size == CAN_MTU && first.can_id == (0x1ABCDEFu | CAN_EFF_FLAG) && first.len == 8 && first.data[7] == 21));
  CHECK((second_size == CANFD_MTU && second.can_id == 0x7FF && second.len == 64 && second.data[63] == 189));
  CHECK((*bus)->receive().value() == std::nullopt);  // Without its own frames.

  can_frame raw{};
  std::memcpy(&raw, &first, sizeof raw);
  peer.send(raw);
  peer.send(second);
  CHECK(await(**bus) == classic);
  CHECK(await(**bus) == fd);
  CHECK((*bus)->receive().value() == std::nullopt);
}

TEST_CASE("an error frame of the controller is a notice and a request for a frame is nothing") {
  const VirtualCan interface("vcan0");
  auto bus = open_socket_can("vcan0", false);
  REQUIRE(bus.has_value());
  Peer peer("vcan0");
  can_frame error{}, request{}, frame{};
  error.can_id = CAN_ERR_FLAG | CAN_ERR_BUSOFF;
  error.len = CAN_ERR_DLC;
  request.can_id = CAN_RTR_FLAG | 0x123;
  frame.can_id = 0x123;
  for (const auto& sent : {error, request, frame}) peer.send(sent);
  CHECK(await(**bus).id == 0x123);
  CHECK((*bus)->receive().value() == std::nullopt);
  CHECK((*bus)->take_notice().value().told.what == "the controller is off the bus after too many errors");
  error.can_id = CAN_ERR_FLAG | CAN_ERR_RESTARTED;
  peer.send(error);
  std::optional<car_io::CanNotice> notice;
  CHECK(becomes_true([&] {
    CHECK((*bus)->receive().value() == std::nullopt);
    notice = (*bus)->take_notice();
    return notice.has_value();
  }));
  CHECK(notice.value().told.what == "the controller is on the bus again");
}

TEST_CASE("an interface that cannot be used says why") {
  const auto what = [](const char* interface, bool needs_fd) {
    const auto bus = open_socket_can(interface, needs_fd);
    return bus ? std::string() : bus.error().what;
  };
  CHECK(what("vcan0", false) == "there is no such interface");
  CHECK(what("lo", false).starts_with("it cannot be opened"));
  VirtualCan interface("vcan0", CAN_MTU);
  CHECK(what("vcan0", false).empty());
  CHECK(what("vcan0", true) == "the DBC file has CAN FD messages, and the interface carries none");
  interface.set("down");
  CHECK(what("vcan0", false) == "the interface is down");
}

TEST_CASE("a bus that goes down is an error that says how to bring it up and lives when opened again") {
  VirtualCan interface("vcan0");
  auto bus = open_socket_can("vcan0", false);
  REQUIRE(bus.has_value());
  interface.set("down");
  const auto received = (*bus)->receive();
  REQUIRE_FALSE(received.has_value());
  CHECK(received.error().what == "reading failed: Network is down");
  CHECK(received.error().remedy.find("ip link set vcan0 up") != std::string::npos);
  CHECK_FALSE((*bus)->send({.id = 1}).has_value());
  interface.set("up");
  bus = open_socket_can("vcan0", false);
  REQUIRE(bus.has_value());
  CHECK((*bus)->send({.id = 1}).value());
  interface.remove();
  CHECK_FALSE((*bus)->receive().has_value());
  CHECK_FALSE((*bus)->send({.id = 1}).has_value());
}

TEST_CASE("instruments come cyclic and counted and rest when nobody drives and go off at the end") {
  const VirtualCan interface("vcan0");
  const auto database = cluster();
  const auto& speed = *dbc::find_message(database, "SPEED");
  const auto& ignition = *dbc::find_message(database, "IGNITION");
  Peer cluster_speed("vcan0"), cluster_ignition("vcan0");
  Seen speeds, ignitions;
  {
    InstrumentThread thread(InstrumentSender(opener("vcan0"), plan_can(database, {}).value()));
    for (const double end_s = now_s() + 1.0; now_s() < end_s; sleep_s(0.005)) {
      thread.set({.ignition = 1.0, .speed_kmh = 88.25});
      look(cluster_speed, speed, speeds);
      look(cluster_ignition, ignition, ignitions);
    }
    CHECK(speeds.newest == doctest::Approx(88.25));
    CHECK(speeds.at_s.size() >= 49);
    CHECK(speeds.at_s.size() <= 52);
    const double silent_from_s = now_s();
    CHECK(becomes_true([&] {
      look(cluster_speed, speed, speeds);
      return speeds.newest == 0.0;
    }));
    measured("instruments at rest after the last word of a simulation", 1000.0 * (now_s() - silent_from_s), "ms");
    CHECK(now_s() - silent_from_s < 0.25);
    for (const double end_s = now_s() + 0.5; now_s() < end_s; sleep_s(0.005)) {
      look(cluster_speed, speed, speeds);
      look(cluster_ignition, ignition, ignitions);
    }
    CHECK(ignitions.newest == 1.0);
    CHECK_FALSE(thread.take_error().has_value());
  }
  CHECK(becomes_true([&] {
    look(cluster_ignition, ignition, ignitions);
    return ignitions.newest == 0.0;
  }));
  double longest_s = 0.0;
  bool in_turn = true;
  for (std::size_t i = 1; i < speeds.at_s.size(); ++i) {
    longest_s = std::max(longest_s, speeds.at_s[i] - speeds.at_s[i - 1]);
    in_turn = in_turn && speeds.counters[i] == static_cast<int>(speeds.counters[i - 1] + 1.0) % 16;
  }
  CHECK(in_turn);
  measured("longest pause between two frames of a message that comes every 20 ms", 1000.0 * longest_s, "ms");
  CHECK(longest_s < 0.04);
}

TEST_CASE("a full queue drops instruments and says so and a removed interface is found again") {
  VirtualCan interface("vcan0");
  const auto database = cluster();
  InstrumentSender sender(opener("vcan0"), plan_can(database, {}).value());
  const auto run = [&](double seconds) {
    for (const double end_s = now_s() + seconds; now_s() < end_s; sleep_s(0.01)) {
      sender.set({.speed_kmh = 50.0}, now_s());
      sender.pump(now_s());
    }
  };
  run(0.2);
  CHECK(sender.counts().dropped == 0);
  // Four frames fit, and each stays for a second: a bus without acknowledgement.
  command("/tools/tc qdisc add dev vcan0 root netem delay 1s limit 4");
  run(0.5);
  CHECK(sender.counts().dropped > 20);
  CHECK(sender.counts().lost == 0);
  CHECK(sender.take_error().value().what == "its queue is full and the instruments' frames are dropped");
  command("/tools/tc qdisc del dev vcan0 root");
  run(0.2);
  CHECK(sender.take_error().value().what == "the instruments' frames leave again");

  interface.remove();
  run(0.7);
  CHECK(sender.counts().lost == 1);
  CHECK(sender.take_error().value().where == "CAN interface vcan0");
  CHECK(sender.take_error().value().what == "there is no such interface");
  interface.add();
  Peer peer("vcan0");
  Seen seen;
  CHECK(becomes_true([&] {
    run(0.02);
    look(peer, *dbc::find_message(database, "SPEED"), seen);
    return seen.newest == 50.0;
  }));
  CHECK(sender.take_error().value().what == "the instruments are sent again");
}

TEST_CASE("controls on the bus drive and are stale when their node falls silent and when the bus goes down") {
  VirtualCan interface("vcan0");
  const auto database = cluster();
  CarConnection car(can_controls_opener(opener("vcan0"), plan_can(database, {}).value(), 7.85),
                    {.calibration = {.steering_lock_rad = 7.85}});
  auto node = open_socket_can("vcan0", false);
  REQUIRE(node.has_value());
  const auto send = [&](const char* name, const char* signal, double value) {
    const auto& message = *dbc::find_message(database, name);
    CanFrame frame{message.id, false, false, message.bytes, {}};
    dbc::encode(*dbc::find_signal(message, signal), value, frame.data);
    (*node)->send(frame);
  };
  CarReading reading;
  const auto drive = [&](double seconds, bool has_pedals) {
    for (const double end_s = now_s() + seconds; now_s() < end_s; sleep_s(0.008)) {
      send("STEERING", "steering_wheel_deg", -90.0);
      if (has_pedals) send("PEDALS", "accelerator_percent", 40.0);
      reading = car.poll(now_s());
    }
  };
  drive(0.3, true);
  CHECK_FALSE(reading.is_stale);
  CHECK(reading.input.accelerator == relative(0.4, 0.001));
  CHECK(reading.input.steering_wheel_rad == relative(-1.5708, 0.001));
  const double silent_from_s = now_s();
  CHECK(becomes_true([&] {
    drive(0.005, false);
    return reading.is_stale;
  }));
  measured("pedals of a silent CAN node are released after", 1000.0 * (now_s() - silent_from_s), "ms");
  CHECK(now_s() - silent_from_s < 0.15);
  CHECK(reading.input.accelerator == 0.0);
  drive(0.3, true);
  CHECK_FALSE(reading.is_stale);
  interface.set("down");
  drive(0.02, true);
  CHECK((!reading.is_connected && reading.is_stale && reading.input.accelerator == 0.0));
  interface.set("up");
  node = open_socket_can("vcan0", false);
  drive(0.8, true);
  CHECK((reading.is_connected && !reading.is_stale));
}

TEST_CASE("a controller that is down is up as the remedy says and its frames are heard by another one") {
  // Two of Kvaser's on one bus, with bit rates, by the kernel's own driver.
  const auto refused = open_socket_can("can0", false);
  REQUIRE_FALSE(refused.has_value());
  CHECK(refused.error().what == "the interface is down");
  for (const char* name : {"can0", "can1"}) {
    std::string remedy = open_socket_can(name, false).error().remedy;
    for (auto at = remedy.find("sudo ip"); at != std::string::npos; at = remedy.find("sudo ip"))
      remedy.replace(at, 7, "/tools/ip");
    command(remedy);
  }
  CHECK(open_socket_can("can0", true).error().what ==
        "the DBC file has CAN FD messages, and the interface carries none");
  const auto database = cluster();
  auto other = open_socket_can("can1", false);
  REQUIRE(other.has_value());
  InstrumentSender sender(opener("can0"), plan_can(database, {}).value());
  Seen seen;
  Peer peer("can1");
  for (const double end_s = now_s() + 1.0; now_s() < end_s; sleep_s(0.005)) {
    sender.set({.speed_kmh = 50.0}, now_s());
    sender.pump(now_s());
    look(peer, *dbc::find_message(database, "SPEED"), seen);
  }
  CHECK(seen.newest == 50.0);
  CHECK(seen.at_s.size() >= 45);
  CHECK(sender.counts().lost == 0);
  command("/tools/ip link set can1 down");
  CHECK_FALSE((*other)->receive().has_value());
  command("/tools/ip link set can0 down");
}

TEST_SUITE_END();

}  // namespace septet::rig_vm
