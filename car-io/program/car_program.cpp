#include "car-io/program/car_program.hpp"

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <functional>
#include <string>
#include <string_view>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#include <fmt/core.h>

#include "car-io/joystick/joystick_controls.hpp"
#include "car-io/joystick/joystick_lesson.hpp"
#include "car-io/program/calibration.hpp"
#include "car-io/program/car_link.hpp"
#include "engine/core/regular_file.hpp"
#include "engine/net/keys.hpp"
#include "engine/net/udp_socket.hpp"
#include "program/clock.hpp"
#include "program/console.hpp"
#include "program/go_word.hpp"
#include "program/stop_signal.hpp"

namespace septet::car_io {
namespace {

void say(const std::string& what) { program::say("septet-car: " + what); }

OpenHidDevice find_device(const rig::Car& car) { return car_opener(car); }

/// The rig's car with its layout and its device.
struct CarHere {
  rig::Car car;
  const CarLayout* layout = nullptr;
  OpenHidDevice open;  ///< For several uses: a libusb device belongs to one program and one opener.
  std::unique_ptr<HidDevice> device;
};

Expected<CarHere> open_car(const std::filesystem::path& file) {
  const auto text = read_regular_file(file);
  if (!text) return tl::unexpected(text.error());
  auto rig = rig::read_rig(*text, file.string());
  if (!rig) return tl::unexpected(rig.error());
  const auto layout = find_car_layout(rig->car.source == rig::CarSource::joystick ? "septet-car" : rig->car.layout);
  if (!layout) return tl::unexpected(layout.error());
  const auto open = find_device(rig->car);
  auto device = open();
  if (!device) return tl::unexpected(device.error());
  return CarHere{rig->car, *layout, open, std::move(*device)};
}

Expected<CarHere> open_car_with_actuators(const std::filesystem::path& file) {
  auto here = open_car(file);
  if (!here || here->layout->has_actuators) return here;
  return failure(fmt::format("the layout {} has no actuators", here->layout->name), file.string(),
                 "choose another layout in [car]");
}

void sleep_s(double seconds) { std::this_thread::sleep_for(std::chrono::duration<double>(seconds)); }

}  // namespace

Expected<void> run_car(const DriveOptions& options) {
  if (options.keys.empty())
    return failure("it needs the folder of its keys", "--keys", "give one; --help lists the options");
  program::catch_stop_signals();
  const auto server = net::parse_address(options.server, "--server");
  if (!server) return tl::unexpected(server.error());
  const auto server_key = net::load_public_key(options.keys / "server.public");
  if (!server_key) return tl::unexpected(server_key.error());
  const auto identity = net::load_or_create_identity(options.keys / "car.key");
  if (!identity) return tl::unexpected(identity.error());
  auto socket = net::UdpSocket::open({{net::is_loopback(*server) ? net::loopback_ip : 0, 0}});
  if (!socket) return tl::unexpected(socket.error());
  say(fmt::format("the server's allowed-clients must hold the line: {} car", net::to_text(identity->public_key())));

  CarLink link(*socket, {*server, *server_key, *identity, {}}, find_device);
  program::GoWord console;
  while (!program::should_stop() && !link.finished()) {
    link.pump(program::monotonic_s());
    if (console.take_rearm()) {
      say("fan, shaker and wheel force shall run again");
      link.rearm(program::monotonic_s());
    }
    for (const auto& text : link.take_messages()) say(text);
    if (link.refusal()) return tl::unexpected(*link.refusal());
    // The device is polled about twice a millisecond; the server's datagrams wake this at once.
    const net::UdpSocket* waiting[] = {&*socket};
    net::wait_readable(waiting, link.has_device() ? 0.001 : 0.01);
  }
  link.close();
  return {};
}

Expected<void> run_calibration(const CalibrateOptions& options) {
  program::catch_stop_signals();
  auto here = open_car(options.rig);
  if (!here) return tl::unexpected(here.error());
  say(
      fmt::format("hold the wheel straight and touch nothing else; then, within {:.0f} s, turn it to "
                  "both ends and press each pedal down once",
                  options.seconds));
  CalibrationRecord record;
  for (const double end_s = program::monotonic_s() + options.seconds;
       program::monotonic_s() < end_s && !program::should_stop(); sleep_s(0.001)) {
    const auto report = here->device->read_newest();
    if (!report) return tl::unexpected(report.error());
    if (!*report) continue;
    const auto readings = read_axes(*here->layout, **report);
    if (!readings) return tl::unexpected(readings.error());
    record.add(*readings);
  }
  if (record.reports == 0)
    return failure("the device sent nothing", options.rig.string(), "check its power and firmware");
  const auto recorded = calibration_of(record, here->car.calibration);
  if (!recorded.unmoved.empty()) say(fmt::format("not moved, and left as the rig has it: {}", recorded.unmoved));
  std::fputs(calibration_toml(recorded.calibration).c_str(), stdout);
  return {};
}

namespace {

struct Trial {
  std::string what;
  Actuators actuators;
};

std::vector<Trial> trials_of(const rig::CarActuators& limits) {
  std::vector<Trial> trials;
  const double fan = std::min(0.5, limits.fan_most), shake = std::min(0.3, limits.vibration_most),
               force = std::min(0.2, limits.steering_most);
  if (fan > 0.0) trials.push_back({fmt::format("fan at {:.0f} %: air should come", fan * 100.0), {.fan = fan}});
  for (const double hz : {20.0, 40.0, 80.0})
    if (shake > 0.0)
      trials.push_back({fmt::format("shaker at {:.0f} % and {:.0f} Hz: the seat should shake, and higher each time",
                                    shake * 100.0, hz),
                        {.vibration = shake, .vibration_hz = hz}});
  if (force > 0.0) {
    trials.push_back(
        {fmt::format("hand wheel, {:.0f} % to the left: let it turn", force * 100.0), {.steering = force}});
    trials.push_back({fmt::format("hand wheel, {:.0f} % to the right", force * 100.0), {.steering = -force}});
  }
  return trials;
}

}  // namespace

Expected<void> run_trial(const TrialOptions& options) {
  program::catch_stop_signals();
  auto here = open_car_with_actuators(options.rig);
  if (!here) return tl::unexpected(here.error());
  ActuatorWriter writer(here->open,
                        {.layout = here->layout, .has_steering_force = here->car.actuators.steering_most > 0.0});
  std::optional<Error> fault;
  const auto hold = [&](const Actuators& actuators, double seconds) {
    for (const double end_s = program::monotonic_s() + seconds;
         program::monotonic_s() < end_s && !program::should_stop() && !fault; sleep_s(0.02)) {
      writer.set(actuators);
      fault = writer.take_error();
    }
  };
  for (const Trial& trial : trials_of(here->car.actuators)) {
    if (program::should_stop() || fault) break;
    say(trial.what);
    hold(trial.actuators, options.seconds);
    hold({}, 0.5);
  }
  if (fault) return tl::unexpected(std::move(*fault));
  if (!program::should_stop()) say("all is off again; the device keeps its watchdog");
  return {};
}

Expected<void> run_lesson(const std::string& name, LearnOptions options) {
  const auto colon = name.find(':');
  const auto read = [](std::string_view text, std::uint16_t& id) {
    const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), id, 16);
    return problem == std::errc() && end == text.data() + text.size();
  };
  if (colon == std::string::npos || !read(std::string_view(name).substr(0, colon), options.vendor_id) ||
      !read(std::string_view(name).substr(colon + 1), options.product_id))
    return failure("it is not of the form VENDOR:PRODUCT", name,
                   "write it as septet devices shows it, such as 046d:c24f");
  program::catch_stop_signals();
  auto device = open_input_device({options.vendor_id, options.product_id, options.serial});
  if (!device) return tl::unexpected(device.error());
  constexpr std::pair<const char*, const char*> questions[] = {
      {"steering", "turn the wheel fully to the left and back"},
      {"accelerator", "press the accelerator down and let go"},
      {"brake", "press the brake down and let go"},
      {"clutch", "press the clutch down and let go (wait, where there is none; likewise below)"},
      {"indicator_left", "press what shall indicate to the left"},
      {"indicator_right", "press what shall indicate to the right"},
      {"horn", "press the horn"},
      {"high_beam", "press what shall be the high beam"},
      {"parking_brake", "press what shall be the parking brake"},
      {"reverse", "press what shall switch between forwards and backwards (where there is no lever)"},
      {"gear_1", "put the lever into gear 1 and out again"},
      {"gear_2", "the same with gear 2"},
      {"gear_3", "gear 3"},
      {"gear_4", "gear 4"},
      {"gear_5", "gear 5"},
      {"gear_6", "gear 6"},
      {"gear_reverse", "reverse"},
      {"emergency_stop", "press the emergency stop, if there is one that this device reads, and release it"},
      {"rearm", "press what shall let the actuators run again after a fault (held for a second while driving)"}};
  std::vector<rig::JoystickControl> controls;
  for (const auto& question : questions) {
    JoystickLesson lesson;
    const auto watch = [&](double seconds, const std::function<void(const InputState&)>& show) -> Expected<void> {
      for (const double end_s = program::monotonic_s() + seconds;
           program::monotonic_s() < end_s && !program::should_stop(); sleep_s(0.005)) {
        const auto state = (*device)->read();
        if (!state) return tl::unexpected(state.error());
        show(**state);
      }
      return {};
    };
    say("hands and feet off");
    auto seen = watch(1.0, [&](const InputState& state) { lesson.show_rest(state); });
    if (seen && !program::should_stop()) {
      say(fmt::format("now, within {:.0f} s: {}", options.seconds, question.second));
      seen = watch(options.seconds, [&](const InputState& state) { lesson.show(state); });
    }
    if (!seen) return seen;
    if (program::should_stop()) return {};
    if (auto control = lesson.learnt(question.first))
      controls.push_back(std::move(*control));
    else
      say(fmt::format("nothing moved: {} is left out", question.first));
  }
  if (controls.empty())
    return failure("nothing has moved", name, "check that it is the one (septet devices), and its power");
  std::fputs(joystick_toml(controls).c_str(), stdout);
  return {};
}

Expected<void> run_actuators(const ActuateOptions& options) {
  program::catch_stop_signals();
  auto here = open_car_with_actuators(options.rig);
  if (!here) return tl::unexpected(here.error());
  ActuatorWriter writer(here->open, {.layout = here->layout, .has_steering_force = options.actuators.steering != 0.0});
  std::optional<Error> fault;
  for (const double end_s = program::monotonic_s() + options.seconds;
       program::monotonic_s() < end_s && !program::should_stop(); sleep_s(0.02)) {
    writer.set(options.actuators);
    if (auto error = writer.take_error(); error && !fault) fault = std::move(error);
  }
  if (fault) return tl::unexpected(std::move(*fault));
  return {};
}

}  // namespace septet::car_io
