#include "car-io/program/game_program.hpp"

#include <charconv>
#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#include <fmt/core.h>

#include "car-io/actuator_writer.hpp"
#include "car-io/can/can_bus.hpp"
#include "car-io/can/instrument_sender.hpp"
#include "car-io/can/rig_can.hpp"
#include "car-io/car_connection.hpp"
#include "car-io/games/game_drive.hpp"
#include "car-io/games/uinput_wheel.hpp"
#include "car-io/joystick/joystick_controls.hpp"
#include "engine/core/regular_file.hpp"
#include "engine/net/udp_socket.hpp"
#include "engine/rig/rig.hpp"
#include "program/clock.hpp"
#include "program/console.hpp"
#include "program/go_word.hpp"
#include "program/stop_signal.hpp"

namespace septet::car_io {
namespace {

void tell_person(const std::string& what) { program::say("septet-car: " + what); }

/// A game's datagrams and the port that they come to.
struct GameSocket {
  TelemetryFormat format;
  net::UdpSocket socket;
};

Expected<TelemetryFormat> format_called(const std::string& name) {
  if (!name.ends_with(".toml")) {
    const auto known = find_telemetry_format(name);
    if (!known) return tl::unexpected(known.error());
    return **known;
  }
  const auto text = read_regular_file(name, 1 << 20);
  if (!text) return tl::unexpected(text.error());
  return read_telemetry_format(*text, name);
}

Expected<GameSocket> open_game(const std::string& text, const std::string& listen) {
  const auto equals = text.rfind('=');
  auto format = format_called(text.substr(0, equals));
  if (!format) return tl::unexpected(format.error());
  std::uint16_t port = format->port;
  if (equals != std::string::npos) {
    const std::string_view digits = std::string_view(text).substr(equals + 1);
    const auto [end, problem] = std::from_chars(digits.data(), digits.data() + digits.size(), port);
    if (problem != std::errc() || end != digits.data() + digits.size()) port = 0;
  }
  if (port == 0) return failure("it names no port", "--game " + text, "write it as outgauge=30000");
  const auto ip = net::parse_ip(listen, "--listen");
  if (!ip) return tl::unexpected(ip.error());
  auto socket = net::UdpSocket::open({.bind = {*ip, port}, .buffer_bytes = 1 << 18});
  if (!socket)
    return failure(socket.error().what, "--game " + text + ", " + socket.error().where,
                   fmt::format("give each --game a port of its own, --game {}=PORT, and set it in the game, too; "
                               "`ss -lunp sport = :{}` names another program that has this one",
                               text.substr(0, equals), port));
  tell_person(fmt::format("{} is heard at {}:{}", format->name, listen, port));
  return GameSocket{std::move(*format), std::move(*socket)};
}

/// The cluster of a rig with [can]; null without.
Expected<std::unique_ptr<InstrumentThread>> open_instruments(const rig::Rig& rig, const std::filesystem::path& file) {
  if (!rig.can) return std::unique_ptr<InstrumentThread>();
  auto can = read_rig_can(rig, file);
  if (!can) return tl::unexpected(can.error());
  if (can->notice) tell_person(describe(*can->notice));
  if (can->plan.sent.empty()) return std::unique_ptr<InstrumentThread>();
  const auto open = [interface = rig.can->interface, needs_fd = can->plan.needs_fd] {
    return open_socket_can(interface, needs_fd);
  };
  return std::make_unique<InstrumentThread>(InstrumentSender(open, std::move(can->plan)));
}

}  // namespace

Expected<void> run_serve(const ServeOptions& options) {
  const auto text = read_regular_file(options.rig);
  if (!text) return tl::unexpected(text.error());
  const auto rig = rig::read_rig(*text, options.rig.string());
  if (!rig) return tl::unexpected(rig.error());
  if (rig->car.source != rig::CarSource::hid && rig->car.source != rig::CarSource::automatic &&
      rig->car.source != rig::CarSource::joystick)
    return failure("its car is no HID device and no joystick", options.rig.string(),
                   "set [car] source = \"hid\" or \"joystick\"");
  const bool is_joystick = rig->car.source == rig::CarSource::joystick;
  const auto layout = find_car_layout(is_joystick ? "septet-car" : rig->car.layout);
  if (!layout) return tl::unexpected(layout.error());
  std::vector<GameSocket> games;
  for (const std::string& game : options.games) {
    auto opened = open_game(game, options.listen);
    if (!opened) return tl::unexpected(opened.error());
    games.push_back(std::move(*opened));
  }
  const OpenHidDevice open = car_opener(rig->car);
  if (const auto device = open(); !device) return tl::unexpected(device.error());
  auto instruments = open_instruments(*rig, options.rig);
  if (!instruments) return tl::unexpected(instruments.error());
  auto wheel = UinputWheel::create();
  if (!wheel) return tl::unexpected(wheel.error());
  program::catch_stop_signals();
  tell_person("games find the wheel \"Septet game wheel\"; Ctrl-C ends it");

  const double lock_rad = rig->car.calibration.steering_lock_rad;
  const auto calibration = is_joystick ? rig::CarCalibration{.steering_lock_rad = lock_rad} : rig->car.calibration;
  CarConnection car(open, {.layout = *layout, .calibration = calibration});
  ActuatorWriter writer(open, {.layout = *layout,
                               .has_steering_force = rig->car.actuators.steering_most > 0.0,
                               .sticky = true,
                               .tells_cut = false,
                               .rise_s = 1.0});
  GameDrive drive(rig->car.actuators, lock_rad);
  ForceEffects effects;
  program::GoWord console;
  while (!program::should_stop()) {
    if (console.take_rearm()) drive.rearm();
    const double now_s = program::monotonic_s();
    const CarReading reading = car.poll(now_s);
    if (auto shown = wheel->show(reading.input, lock_rad); !shown) return shown;
    if (auto taken = wheel->take_effects(effects, now_s); !taken) return taken;
    constexpr int most_datagrams = 64;
    for (GameSocket& game : games)
      for (int i = 0; i < most_datagrams; ++i) {
        const auto datagram = game.socket.receive();
        if (!datagram) break;
        drive.receive(game.format, datagram->bytes, now_s);
      }
    if (writer.is_cut()) drive.cut("septet-car was silent");
    if (*instruments) drive.set_bus_lost((*instruments)->is_lost());
    writer.set(drive.actuate(reading, effects, now_s));
    if (*instruments) {
      if (const auto shown = drive.instruments(now_s)) (*instruments)->set(*shown);
      if (const auto error = (*instruments)->take_error()) tell_person(describe(*error));
    }
    for (const std::string& message : drive.take_messages()) tell_person(message);
    if (const auto error = car.take_error()) tell_person(describe(*error));
    if (const auto error = writer.take_error()) tell_person(describe(*error));
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  return {};
}

}  // namespace septet::car_io
