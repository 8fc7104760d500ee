#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <doctest/doctest.h>
#include <linux/can.h>
#include <linux/can/error.h>
#include <sys/socket.h>
#include <unistd.h>

#include "car-io/can/can_bus.hpp"
#include "car-io/can/can_controls.hpp"
#include "car-io/can/can_plan.hpp"
#include "car-io/can/instrument_sender.hpp"
#include "car-io/can/instruments.hpp"
#include "car-io/can/signal_codec.hpp"
#include "car-io/car_connection.hpp"
#include "tests/car-io/can/simulated_can_bus.hpp"
#include "tests/relative.hpp"
#include "tests/shipped_files.hpp"
#include "tests/why_not.hpp"

namespace septet::car_io {
namespace {

dbc::Database cluster() {
  auto database = dbc::read_dbc(shipped_text("rigs/cluster.dbc"), "cluster.dbc");
  REQUIRE_MESSAGE(database.has_value(), why_not(database));
  return *database;
}

CanPlan cluster_plan() { return plan_can(cluster(), {}).value(); }

CanFrame frame_of(const char* message, std::vector<std::pair<const char*, double>> values) {
  static const dbc::Database database = cluster();
  const dbc::Message* found = dbc::find_message(database, message);
  REQUIRE(found);
  CanFrame frame{found->id, found->is_extended, found->is_fd, found->bytes, {}};
  for (const auto& [signal, value] : values) dbc::encode(*dbc::find_signal(*found, signal), value, frame.data);
  return frame;
}

/// Of the last frame of this message.
double shown(const SimulatedCanBus& bus, const char* message, const char* signal) {
  static const dbc::Database database = cluster();
  const dbc::Message* found = dbc::find_message(database, message);
  const auto frame =
      std::find_if(bus.sent.rbegin(), bus.sent.rend(), [&](const CanFrame& sent) { return sent.id == found->id; });
  return frame == bus.sent.rend() ? std::nan("")
                                  : dbc::decode(*found, *dbc::find_signal(*found, signal), frame->payload()).value();
}

long frames_of(const SimulatedCanBus& bus, std::uint32_t id) { return std::ranges::count(bus.sent, id, &CanFrame::id); }

/// Ten milliseconds after ten, as its thread would.
void run(InstrumentSender& sender, double from_s, double to_s, const Instruments* instruments) {
  for (int i = 0; from_s + i * 0.01 < to_s - 1e-9; ++i) {
    if (instruments) sender.set(*instruments, from_s + i * 0.01);
    sender.pump(from_s + i * 0.01);
  }
}

}  // namespace

TEST_CASE("the shipped cluster shows speed revolutions gear lamps and temperatures and hears every control") {
  const CanPlan plan = cluster_plan();
  CHECK(plan.sent.size() == 4);
  CHECK(plan.heard.size() == 3);
  CHECK_FALSE(plan.needs_fd);
  std::size_t instruments = 0, controls = 0;
  for (const auto& sent : plan.sent)
    instruments += static_cast<std::size_t>(
        std::ranges::count_if(sent.signals, [](const SentSignal& s) { return s.carries.index() == 1; }));
  for (const auto& heard : plan.heard) controls += heard.signals.size();
  CHECK(instruments == instrument_quantities().size());
  CHECK(controls == control_quantities().size());
}

TEST_CASE("the instruments of a tick are what car lamps and weather say") {
  Snapshot snapshot;
  snapshot.driver_car = {.participant = 3, .speed_mps = -10.0, .gear = -1};
  snapshot.environment.temperature_k = 263.15;
  Participant car{.id = 3};
  car.lamps.set(Lamp::indicator_left, true);
  car.lamps.set(Lamp::high_beam, true);
  snapshot.participants.push_back(car);
  DriverInput input;
  input.parking_brake = true;
  const auto values =
      instruments_of(snapshot, input, {.engine_radps = 100.0 * std::numbers::pi, .anti_lock_active = true}, true);
  CHECK(values.speed_kmh == doctest::Approx(36.0));
  CHECK(values.engine_rpm == doctest::Approx(3000.0));
  CHECK(values.gear == -1.0);
  CHECK(values.outside_temperature_c == doctest::Approx(-10.0));
  CHECK((values.indicator_left == 1.0 && values.indicator_right == 0.0 && values.high_beam == 1.0));
  CHECK((values.parking_brake == 1.0 && values.anti_lock == 1.0 && values.controls_lost == 1.0 &&
         values.engine_stopped == 0.0));
}

TEST_CASE("each message leaves as often as its file says and counts its frames") {
  SimulatedCanBus bus;
  InstrumentSender sender(bus.opener(), cluster_plan());
  const Instruments driving{.ignition = 1.0,
                            .speed_kmh = 88.25,
                            .engine_rpm = 2500.0,
                            .gear = -1.0,
                            .outside_temperature_c = -12.5,
                            .indicator_left = 1.0};
  run(sender, 0.0, 1.0, &driving);
  CHECK(frames_of(bus, 256) == 50);
  CHECK(frames_of(bus, 257) == 50);
  CHECK(frames_of(bus, 258) == 20);
  CHECK(frames_of(bus, 259) == 10);
  CHECK(shown(bus, "SPEED", "speed_kmh") == doctest::Approx(88.25));
  CHECK(shown(bus, "ENGINE", "engine_rpm") == doctest::Approx(2500.0));
  CHECK(shown(bus, "ENGINE", "gear") == -1.0);
  CHECK(shown(bus, "ENGINE", "outside_temperature_c") == doctest::Approx(-12.5));
  CHECK(shown(bus, "LAMPS", "indicator_left") == 1.0);
  CHECK(shown(bus, "SPEED", "counter") == 49 % 16);
  CHECK(sender.counts().sent == 130);
  CHECK_FALSE(sender.take_error().has_value());
}

TEST_CASE("a simulation that falls silent leaves a cluster at rest that is kept alive and the end switches it off") {
  SimulatedCanBus bus;
  InstrumentSender sender(bus.opener(), cluster_plan());
  const Instruments driving{.ignition = 1.0, .speed_kmh = 100.0, .high_beam = 1.0};
  run(sender, 0.0, 0.5, &driving);
  run(sender, 0.5, 0.69, nullptr);
  CHECK(shown(bus, "SPEED", "speed_kmh") == 100.0);
  run(sender, 0.69, 1.5, nullptr);
  CHECK(shown(bus, "SPEED", "speed_kmh") == 0.0);
  CHECK(shown(bus, "LAMPS", "high_beam") == 0.0);
  CHECK(shown(bus, "IGNITION", "ignition") == 1.0);
  CHECK(frames_of(bus, 259) == 15);
  sender.finish(1.5);
  CHECK(shown(bus, "IGNITION", "ignition") == 0.0);
}

TEST_CASE("a sender that was stopped for a second sends each message once and no backlog") {
  SimulatedCanBus bus;
  InstrumentSender sender(bus.opener(), cluster_plan());
  sender.set({}, 0.0);
  sender.pump(0.0);
  bus.sent.clear();
  CHECK(sender.pump(1.0) == doctest::Approx(1.0));
  CHECK(bus.sent.size() == 4);
}

TEST_CASE("a full queue drops frames and is told once and its end once") {
  SimulatedCanBus bus;
  InstrumentSender sender(bus.opener(), cluster_plan());
  const Instruments driving{.speed_kmh = 50.0};
  bus.is_full = true;
  run(sender, 0.0, 1.0, &driving);
  CHECK(sender.counts().dropped == 130);
  CHECK(sender.take_error().value().what == "its queue is full and the instruments' frames are dropped");
  CHECK_FALSE(sender.take_error().has_value());
  bus.is_full = false;
  run(sender, 1.0, 2.0, &driving);
  CHECK(sender.take_error().value().what == "the instruments' frames leave again");
  CHECK(bus.sent.size() == 130);
}

TEST_CASE("an interface that goes down is opened again and what is sent then is the newest") {
  SimulatedCanBus bus;
  InstrumentSender sender(bus.opener(), cluster_plan());
  const Instruments slow{.speed_kmh = 10.0}, fast{.speed_kmh = 90.0};
  run(sender, 0.0, 0.5, &slow);
  bus.is_up = false;
  run(sender, 0.5, 1.7, &slow);
  CHECK(sender.counts().lost == 1);
  CHECK(sender.take_error().value().what == "sending failed: Network is down");
  CHECK(sender.take_error().value().what == "the interface is down");
  CHECK_FALSE(sender.take_error().has_value());
  bus.is_up = true;
  bus.sent.clear();
  run(sender, 1.7, 2.5, &fast);
  CHECK(bus.opened == 2);
  CHECK(sender.take_error().value().what == "the instruments are sent again");
  CHECK(std::ranges::none_of(bus.sent, [](const CanFrame& frame) {
    return frame == CanFrame{} || (frame.id == 256 && frame.data[1] < std::byte{0x20});
  }));
}

TEST_CASE("a controller that leaves the bus is told") {
  SimulatedCanBus bus;
  InstrumentSender sender(bus.opener(), cluster_plan());
  bus.notice = CanNotice{{"off the bus", "test0", "check"}, true};
  sender.pump(0.0);
  CHECK(sender.take_error().value().what == "off the bus");
}

TEST_CASE("a controller off the bus is a lost bus until it says that it is back, or sends again what it had refused") {
  for (const bool says_so : {true, false}) {
    CAPTURE(says_so);
    SimulatedCanBus bus;
    InstrumentSender sender(bus.opener(), cluster_plan());
    run(sender, 0.0, 0.5, nullptr);
    CHECK_FALSE(sender.is_lost());
    bus.notice = CanNotice{{"off the bus", "test0", "check"}, true};
    run(sender, 0.5, 0.6, nullptr);  // Frames go into its queue still.
    CHECK(sender.is_lost());
    bus.is_full = true;
    run(sender, 0.6, 2.0, nullptr);
    CHECK(sender.is_lost());
    if (says_so) {
      bus.notice = CanNotice{{"on the bus again", "test0", "nothing to do"}, false};
      run(sender, 2.0, 2.05, nullptr);
      CHECK(sender.is_lost());  // The queued frames wait.
    }
    bus.is_full = false;
    run(sender, 2.05, 2.2, nullptr);
    CHECK_FALSE(sender.is_lost());
  }
}

TEST_CASE("a queue that is full for a quarter of a second is a lost bus until a frame leaves") {
  SimulatedCanBus bus;
  InstrumentSender sender(bus.opener(), cluster_plan());
  run(sender, 0.0, 0.5, nullptr);
  bus.is_full = true;
  run(sender, 0.5, 0.7, nullptr);
  CHECK_FALSE(sender.is_lost());  // A moment's overload.
  run(sender, 0.7, 0.81, nullptr);
  CHECK(sender.is_lost());
  bus.is_full = false;
  run(sender, 0.81, 0.85, nullptr);
  CHECK_FALSE(sender.is_lost());
}

TEST_CASE("the rig gives other signals their quantities and constants") {
  const auto database = dbc::read_dbc(
      "BS_:\nBO_ 5 DASH: 12 X\n SG_ v : 7|16@0+ (0.1,0) [0|0] \"\" X\n SG_ alive : 16|8@1+ (1,0) [0|0] \"\" X\n SG_ n "
      ": 24|4@1+ (1,0) [0|0] \"\" X\n"
      "BO_ 6 OTHER: 8 X\n SG_ x : 0|8@1+ (1,0) [0|0] \"\" X\n",
      "own.dbc");
  REQUIRE(database.has_value());
  rig::Can can{.dbc = "own.dbc",
               .signals = {{"DASH.v", "speed_kmh"}, {"DASH.alive", "", 165.0}, {"DASH.n", "counter"}}};
  const auto plan = plan_can(*database, can);
  REQUIRE_MESSAGE(plan.has_value(), why_not(plan));
  CHECK(plan->needs_fd);
  SimulatedCanBus bus;
  InstrumentSender sender(bus.opener(), *plan);
  const Instruments driving{.speed_kmh = 25.6};
  run(sender, 0.0, 0.2, &driving);
  REQUIRE(bus.sent.size() == 2);
  CHECK((bus.sent[1].is_fd && bus.sent[1].bytes == 12));
  CHECK(bus.sent[1].data[0] == std::byte{0x01});
  CHECK(bus.sent[1].data[1] == std::byte{0x00});
  CHECK(bus.sent[1].data[2] == std::byte{165});
  CHECK(bus.sent[1].data[3] == std::byte{1});
  can.signals.push_back({"DASH.w", "speed_kmh"});
  CHECK(plan_can(*database, can).error().what == "[can.signals] names DASH.w, which own.dbc has not");
  can.signals.back() = {"OTHER.x", "velocity"};
  CHECK(plan_can(*database, can).error().what ==
        "[can.signals] gives OTHER.x the quantity \"velocity\", which there is not");
  can.signals = {{"DASH.v", "speed_kmh"}, {"DASH.n", "horn_switch"}};
  CHECK(plan_can(*database, can).error().what == "DASH would be sent and heard");
  CHECK(plan_can(*database, {.dbc = "own.dbc"}).error().what == "none of its signals carries anything of the car");
}

TEST_CASE("a multiplexed message is sent once for each selected value with that value's signals alone") {
  const auto database = dbc::read_dbc(
      "BS_:\nBO_ 5 DASH: 8 X\n SG_ Mode M : 0|8@1+ (2,1) [50|60] \"\" X\n SG_ speed_kmh m0 : 8|16@1+ (0.01,0) [0|0] "
      "\"\" X\n SG_ engine_rpm m1 : 8|16@1+ (1,0) [0|0] \"\" X\n SG_ unused m2 : 8|16@1+ (1,0) [0|0] \"\" X\n"
      " SG_ counter : 32|8@1+ (1,0) [0|0] \"\" X\n SG_ own m1 : 40|8@1+ (1,0) [0|0] \"\" X\n",
      "own.dbc");
  REQUIRE(database.has_value());
  rig::Can can{.dbc = "own.dbc", .signals = {{"DASH.own", "counter"}}};
  const auto plan = plan_can(*database, can);
  REQUIRE_MESSAGE(plan.has_value(), why_not(plan));
  const auto frames_of = [](const CanPlan& sent) {
    SimulatedCanBus bus;
    InstrumentSender sender(bus.opener(), sent);
    sender.set({.speed_kmh = 50.0, .engine_rpm = 3000.0}, 0.0);
    sender.pump(0.0);
    sender.pump(0.15);
    return bus.sent;
  };
  const auto frames = frames_of(*plan);
  REQUIRE(frames.size() == 4);
  for (std::size_t i = 0; i < 4; ++i) {
    const auto at = [&](std::size_t byte) { return std::to_integer<unsigned>(frames[i].data[byte]); };
    CAPTURE(i);
    CHECK(at(0) == i % 2);
    CHECK(at(1) + 256u * at(2) == (i % 2 == 0 ? 5000u : 3000u));
    CHECK(at(4) == i);
    CHECK(at(5) == (i % 2 == 0 ? 0u : i / 2));
  }
  can.signals.push_back({"DASH.Mode", "", 53.0});
  CHECK(frames_of(plan_can(*database, can).value()).size() == 2);
}

TEST_CASE("a message that cannot be read refuses the rig that uses it and no other") {
  const auto database = [](const std::string& signal) {
    return dbc::read_dbc(
               "BS_:\nBO_ 5 DASH: 8 X\n SG_ speed_kmh : 0|8@1+ (1,0) [0|0] \"\" X\nBO_ 6 LONG: 1785 X\n SG_ " + signal +
                   " : 0|8@1+ (1,0) [0|0] \"\" X\n",
               "own.dbc")
        .value();
  };
  CHECK(plan_can(database("part"), {}).value().sent.size() == 1);
  const auto named = plan_can(database("part"), {.signals = {{"LONG.part", "engine_rpm"}}});
  REQUIRE_FALSE(named.has_value());
  CHECK(named.error().what == "LONG has 1785 bytes, which no frame has");
  CHECK(named.error().where == "own.dbc:4");
  const auto called = plan_can(database("engine_rpm"), {});
  REQUIRE_FALSE(called.has_value());
  CHECK(called.error().what == "engine_rpm of LONG cannot be used: LONG has 1785 bytes, which no frame has");
}

TEST_CASE("a rig that names a message whose BO_ is damaged is refused with its line and any other is not") {
  const auto database = dbc::read_dbc(
      "BS_:\nBO_ 5 DASH: 8 X\n SG_ speed_kmh : 0|8@1+ (1,0) [0|0] \"\" X\n"
      "BX_ 6 LOST: 8 X\n SG_ part : 0|8@1+ (1,0) [0|0] \"\" X\n",
      "own.dbc");
  REQUIRE(database.has_value());
  CHECK(plan_can(*database, {}).value().sent.size() == 1);
  const auto named = plan_can(*database, {.signals = {{"LOST.part", "engine_rpm"}}});
  REQUIRE_FALSE(named.has_value());
  CHECK(named.error().what == "the line of the message LOST does not begin with BO_");
  CHECK(named.error().where == "own.dbc:4");
}

TEST_CASE("multiplexed signals that nothing can select are refused") {
  const auto refusal = [](const char* selecting) {
    const auto database = dbc::read_dbc(
        "BS_:\nBO_ 5 DASH: 8 X\n" + std::string(selecting) + " SG_ speed_kmh m9 : 8|16@1+ (0.01,0) [0|0] \"\" X\n",
        "own.dbc");
    const auto plan = plan_can(database.value(), {.dbc = "own.dbc"});
    REQUIRE_FALSE(plan.has_value());
    return plan.error().what;
  };
  CHECK(refusal("") == "DASH has multiplexed signals and none that selects them");
  CHECK(refusal(" SG_ Mode M : 0|2@1+ (1,0) [0|0] \"\" X\n") == "Mode of DASH cannot hold 9, which selects a signal");
}

TEST_CASE("multiplexed controls are read in frames that select them alone and each selection has to beat") {
  const auto database = dbc::read_dbc(
      "BS_:\nBO_ 5 PEDALS: 8 X\n SG_ Mode M : 0|8@1+ (1,0) [0|0] \"\" X\n SG_ accelerator_percent m0 : 8|8@1+ (1,0) "
      "[0|0] \"\" X\n SG_ brake_percent m1 : 8|8@1+ (1,0) [0|0] \"\" X\n",
      "own.dbc");
  SimulatedCanBus bus;
  CarConnection car(can_controls_opener(bus.opener(), plan_can(database.value(), {}).value(), 7.85),
                    {.calibration = {.steering_lock_rad = 7.85}});
  const auto hear = [&](unsigned char mode, unsigned char percent) {
    CanFrame frame{5, false, false, 8, {}};
    frame.data[0] = std::byte{mode};
    frame.data[1] = std::byte{percent};
    bus.waiting.push_back(frame);
  };
  auto reading = car.poll(0.0);
  for (int i = 1; i < 20; ++i) {
    hear(0, 80);
    hear(1, 20);
    hear(2, 60);
    reading = car.poll(0.01 * i);
  }
  CHECK(reading.input.accelerator == relative(0.8, 0.02));
  CHECK(reading.input.brake == relative(0.2, 0.02));
  CHECK_FALSE(reading.is_stale);
  for (int i = 20; i < 50; ++i) {
    hear(1, 20);
    reading = car.poll(0.01 * i);
  }
  CHECK(reading.is_stale);
}

TEST_CASE("controls on the bus drive and a node that falls silent makes the car stale") {
  SimulatedCanBus bus;
  CarConnection car(can_controls_opener(bus.opener(), cluster_plan(), 7.85),
                    {.calibration = {.steering_lock_rad = 7.85}});
  const auto steering = frame_of("STEERING", {{"steering_wheel_deg", -90.0}});
  const auto pedals = frame_of("PEDALS", {{"accelerator_percent", 40.0}, {"brake_percent", 5.0}});
  const auto stalks = frame_of(
      "STALKS",
      {{"indicator_right_switch", 1.0}, {"selector_position", 4.0}, {"gear_position", 3.0}, {"horn_switch", 1.0}});
  CarReading reading;
  double now_s = 0.0;
  const auto drive = [&](int ticks, bool with_pedals) {
    for (int i = 0; i < ticks; ++i, now_s += 0.01) {
      bus.waiting.push_back(steering);
      if (with_pedals) bus.waiting.push_back(pedals);
      if (i % 5 == 0) bus.waiting.push_back(stalks);
      reading = car.poll(now_s);
    }
  };
  drive(20, true);
  CHECK_FALSE(reading.is_stale);
  CHECK(reading.input.steering_wheel_rad == relative(-std::numbers::pi / 2, 0.001));
  CHECK(reading.input.accelerator == relative(0.4, 0.001));
  CHECK(reading.input.brake == relative(0.05, 0.01));
  CHECK((reading.input.indicator == IndicatorStalk::right && reading.input.horn));
  CHECK((reading.input.selector == GearSelector::manual && reading.input.gear == 3));
  drive(20, false);
  CHECK(reading.is_stale);
  CHECK(reading.input.accelerator == 0.0);
  drive(20, true);
  CHECK_FALSE(reading.is_stale);
  bus.is_up = false;
  reading = car.poll(now_s);
  CHECK((!reading.is_connected && reading.is_stale));
  bus.is_up = true;
  now_s += 1.0;
  drive(20, true);
  CHECK((reading.is_connected && !reading.is_stale && reading.input.accelerator > 0.39));
}

TEST_CASE("no value of a signal makes controls that there are not") {
  const double wild[] = {std::numeric_limits<double>::infinity(), -1e300, 1e300, 7.0, -2.0, 0.49};
  for (const double a : wild)
    for (const double b : wild) {
      const auto input = driver_input_of(
          {.steering_wheel_deg = a, .accelerator_percent = b, .selector_position = a, .gear_position = b}, {});
      CHECK(std::isfinite(input.steering_wheel_rad));
      CHECK((input.accelerator >= 0.0 && input.accelerator <= 1.0));
      CHECK(static_cast<int>(input.selector) <= 4);
      CHECK((input.gear >= -1 && input.gear <= 6));
      const auto report = encode_controls(input);
      CHECK(decode_report(car_layouts().front(), {}, report).has_value());
    }
}

TEST_CASE("frames pass a socket in the kernel's own form and a full one drops") {
  int ends[2];
  REQUIRE(socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_NONBLOCK, 0, ends) == 0);
  const auto bus = can_bus_of_socket(ends[0], "test0");
  const CanFrame classic{0x1ABCDEF, true, false, 3, {std::byte{1}, std::byte{2}, std::byte{3}}};
  REQUIRE(bus->send(classic).value());
  can_frame raw{};
  REQUIRE(read(ends[1], &raw, sizeof raw) == sizeof raw);
  CHECK((raw.can_id == (0x1ABCDEFu | CAN_EFF_FLAG) && raw.len == 3 && raw.data[2] == 3));
  CanFrame fd{0x123, false, true, 64, {}};
  fd.data[63] = std::byte{9};
  REQUIRE(bus->send(fd).value());
  canfd_frame raw_fd{};
  REQUIRE(read(ends[1], &raw_fd, sizeof raw_fd) == sizeof raw_fd);
  CHECK((raw_fd.can_id == 0x123 && raw_fd.len == 64 && raw_fd.data[63] == 9));

  can_frame error{};
  error.can_id = CAN_ERR_FLAG | CAN_ERR_BUSOFF;
  error.len = CAN_ERR_DLC;
  const char nonsense[7] = {};
  can_frame too_long{};
  too_long.len = 255;
  REQUIRE(write(ends[1], &error, sizeof error) == sizeof error);
  REQUIRE(write(ends[1], nonsense, sizeof nonsense) == sizeof nonsense);
  REQUIRE(write(ends[1], &too_long, sizeof too_long) == sizeof too_long);
  REQUIRE(write(ends[1], &raw, sizeof raw) == sizeof raw);
  REQUIRE(write(ends[1], &raw_fd, sizeof raw_fd) == sizeof raw_fd);
  CHECK(bus->receive().value() == classic);
  CHECK(bus->receive().value() == fd);
  CHECK(bus->receive().value() == std::nullopt);
  const auto off = bus->take_notice();
  REQUIRE(off.has_value());
  CHECK(off->told.what == "the controller is off the bus after too many errors");
  CHECK(off->is_off);
  CHECK_FALSE(bus->take_notice().has_value());
  error.can_id = CAN_ERR_FLAG | CAN_ERR_RESTARTED;
  REQUIRE(write(ends[1], &error, sizeof error) == sizeof error);
  CHECK(bus->receive().value() == std::nullopt);
  CHECK_FALSE(bus->take_notice().value().is_off);

  bool is_full = false;
  for (int i = 0; i < 100'000 && !is_full; ++i) is_full = !bus->send(fd).value();
  CHECK(is_full);
  close(ends[1]);
  CHECK_FALSE(bus->send(fd).has_value());
}

TEST_CASE("an interface that is not there says so") {
  const auto bus = open_socket_can("septet-none0", false);
  REQUIRE_FALSE(bus.has_value());
  CHECK(bus.error().where == "CAN interface septet-none0");
}

}  // namespace septet::car_io
