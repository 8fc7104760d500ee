#include "engine/rig/rig.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <set>

#include <fmt/core.h>
#include <toml++/toml.h>

#include "engine/core/printable.hpp"
#include "engine/document/table_reader.hpp"
#include "engine/document/toml_table.hpp"
#include "engine/rig/network_reader.hpp"
#include "engine/rig/sight_reader.hpp"

namespace septet::rig {
namespace {

using document::TableReader;

constexpr std::string_view joystick_controls[] = {
    "steering", "accelerator", "brake",     "clutch",        "indicator_left", "indicator_right", "hazard_lights",
    "horn",     "low_beam",    "high_beam", "parking_brake", "reverse",        "gear_1",          "gear_2",
    "gear_3",   "gear_4",      "gear_5",    "gear_6",        "gear_reverse",   "emergency_stop",  "rearm"};

View read_inset(const toml::table& table, const std::vector<Mirror>& mirrors, std::string_view file, Error& error) {
  TableReader reader(table, file, "screen.inset", error);
  View view;
  if (table.contains("mirror")) {
    const std::string name = reader.get_string("mirror", "");
    const auto found = std::ranges::find(mirrors, name, &Mirror::name);
    if (found == mirrors.end()) {
      reader.report("mirror", fmt::format("there is no mirror \"{}\"", printable(name)),
                    "name a [[mirror]] of the rig");
    } else {
      view.mirror = static_cast<std::size_t>(found - mirrors.begin());
      view.window = found->glass;
    }
  }
  view.mirrored = view.mirror ? true : reader.get_bool("mirrored", true);
  view.left = reader.get_double("left", 0.0, 0.0, 1.0);
  view.top = reader.get_double("top", 0.0, 0.0, 1.0);
  view.width = reader.get_double("width", 0.2, 0.01, 1.0);
  view.height = reader.get_double("height", 0.1, 0.01, 1.0);
  if (view.left + view.width > 1.0 || view.top + view.height > 1.0)
    reader.report("left", "an inset reaches over the edge of its screen",
                  "keep left + width and top + height at most 1");
  if (!table.contains("mirror")) read_window(reader, view.window);
  reader.finish(documented_in);
  return view;
}

/// A host's name; it also names the folder with that machine's keys.
std::string read_machine(TableReader& reader) {
  std::string machine = reader.get_string("machine", "");
  constexpr std::string_view usable = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-.";
  if (machine.starts_with('.') || machine.find_first_not_of(usable) != std::string::npos)
    reader.report("machine", fmt::format("machine is \"{}\"", machine),
                  "use a host name: letters, digits, hyphens and points");
  return machine;
}

Screen read_screen(const toml::table& table, const std::vector<Mirror>& mirrors, std::string_view file, Error& error) {
  TableReader reader(table, file, "screen", error);
  Screen screen;
  screen.name = reader.get_string("name", "");
  constexpr std::size_t longest_name = 63;  // It names files, and a machine's key.
  if (screen.name.empty() || screen.name.size() > longest_name ||
      screen.name.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789-") != std::string::npos)
    reader.report("name", fmt::format("screen.name is \"{}\"", printable(screen.name, longest_name)),
                  fmt::format("use small letters, digits and hyphens, {} at most", longest_name));
  screen.width_px = static_cast<std::uint32_t>(reader.get_integer("width_px", screen.width_px, 16, 16384));
  screen.height_px = static_cast<std::uint32_t>(reader.get_integer("height_px", screen.height_px, 16, 16384));
  if (screen.name == "car" || screen.name == "server")
    reader.report("name", fmt::format("screen.name is \"{}\", which is the name of another key", screen.name),
                  "call the screen otherwise");
  screen.machine = read_machine(reader);
  if (const auto monitor = reader.get_integer("monitor", -1, 0, 63); monitor >= 0)
    screen.monitor = static_cast<std::uint32_t>(monitor);
  screen.full_screen = reader.get_bool("full_screen", false);
  screen.show_interior = reader.get_bool("show_interior", false);
  screen.instruments = reader.get_bool("instruments", false);
  screen.only_instruments = reader.get_choice("shows", 0, {"road", "instruments"}) == 1;
  View whole;
  read_window(reader, whole.window);
  screen.views.push_back(whole);
  for (const toml::table* inset : reader.get_tables("inset"))
    screen.views.push_back(read_inset(*inset, mirrors, file, error));
  if (screen.only_instruments && screen.views.size() > 1)
    reader.report("shows", "a screen that shows the instruments has insets",
                  "put the insets on a screen that shows the road");
  reader.finish(documented_in);
  return screen;
}

AxisCalibration read_axis(TableReader& calibration, std::string_view axis, AxisCalibration fallback,
                          std::string_view file, Error& error) {
  const toml::table* table = calibration.get_table(axis);
  if (!table) return fallback;
  TableReader reader(*table, file, fmt::format("car.calibration.{}", axis), error);
  AxisCalibration result = fallback;
  result.min = reader.get_double("min", fallback.min, -2.0, 2.0);
  result.max = reader.get_double("max", fallback.max, -2.0, 2.0);
  const bool is_wheel = fallback.min < 0.0;
  result.centre = is_wheel ? reader.get_double("centre", fallback.centre, -2.0, 2.0) : result.min;
  result.dead_zone = reader.get_double("dead_zone", fallback.dead_zone, 0.0, 0.5);
  result.inverted = reader.get_bool("inverted", fallback.inverted);
  if (result.max - result.min < 0.05)
    reader.report("max", fmt::format("the {}'s max is not above its min by 0.05 or more", axis),
                  "calibrate it again with septet-car calibrate");
  else if (is_wheel && (result.centre - result.min < 0.02 || result.max - result.centre < 0.02))
    reader.report("centre", fmt::format("the {}'s centre does not lie between min and max", axis),
                  "calibrate it again with septet-car calibrate");
  reader.finish(documented_in);
  return result;
}

CarCalibration read_calibration(const toml::table& table, std::string_view file, Error& error) {
  TableReader reader(table, file, "car.calibration", error);
  CarCalibration calibration;
  calibration.steering_lock_rad = reader.get_double("steering_lock_rad", calibration.steering_lock_rad, 0.1, 30.0);
  calibration.gear_lever = reader.get_bool("gear_lever", calibration.gear_lever);
  calibration.steering = read_axis(reader, "steering", calibration.steering, file, error);
  calibration.accelerator = read_axis(reader, "accelerator", calibration.accelerator, file, error);
  calibration.brake = read_axis(reader, "brake", calibration.brake, file, error);
  calibration.clutch = read_axis(reader, "clutch", calibration.clutch, file, error);
  reader.finish(documented_in);
  return calibration;
}

std::vector<Vec2> read_fan_curve(const toml::array& points, TableReader& reader) {
  std::vector<Vec2> curve;
  for (const toml::node& node : points) {
    const toml::array* pair = node.as_array();
    const auto share = pair && pair->size() == 2 ? pair->get(0)->value<double>() : std::nullopt;
    const auto speed = pair && pair->size() == 2 ? pair->get(1)->value<double>() : std::nullopt;
    const bool is_point = share && speed && *share >= 0.0 && *share <= 1.0 && *speed >= 0.0 && *speed < 1000.0;
    if (!is_point || (!curve.empty() && (*share <= curve.back().x || *speed <= curve.back().y))) {
      reader.report("fan_curve", "car.actuators.fan_curve is no rising list of [share, air speed]",
                    "write what was measured, as [[0.2, 2.0], [0.6, 7.5], [1.0, 12.0]]");
      return {};
    }
    curve.emplace_back(*share, *speed);
  }
  if (curve.size() < 2 || curve.size() > 100)
    reader.report("fan_curve", "car.actuators.fan_curve has not between 2 and 100 points", "measure at five or so");
  return curve.size() < 2 ? std::vector<Vec2>{} : curve;
}

CarActuators read_actuators(const toml::table& table, std::string_view file, Error& error) {
  TableReader reader(table, file, "car.actuators", error);
  CarActuators actuators;
  actuators.fan_full_speed_mps = reader.get_double("fan_full_speed_mps", actuators.fan_full_speed_mps, 1.0, 200.0);
  actuators.fan_follows = static_cast<CarActuators::Wind>(reader.get_choice("fan_follows", 0, {"air-speed", "force"}));
  actuators.fan_least = reader.get_double("fan_least", actuators.fan_least, 0.0, 1.0);
  if (const toml::array* points = reader.get_array("fan_curve")) actuators.fan_curve = read_fan_curve(*points, reader);
  actuators.fan_most = reader.get_double("fan_most", actuators.fan_most, 0.0, 1.0);
  if (actuators.fan_least > actuators.fan_most)
    reader.report("fan_least", "the fan just turns at more than its most", "give fan_least below fan_most");
  actuators.vibration_most = reader.get_double("vibration_most", actuators.vibration_most, 0.0, 1.0);
  actuators.vibration_full_mps2 = reader.get_double("vibration_full_mps2", actuators.vibration_full_mps2, 0.0, 100.0);
  actuators.vibration_dose_mps2 = reader.get_double("vibration_dose_mps2", actuators.vibration_dose_mps2, 0.01, 1.15);
  actuators.steering_full_nm = reader.get_double("steering_full_nm", actuators.steering_full_nm, 0.1, 100.0);
  actuators.steering_most = reader.get_double("steering_most", actuators.steering_most, 0.0, 1.0);
  actuators.wheel_spring = reader.get_double("wheel_spring", actuators.wheel_spring, 0.0, 1.0);
  actuators.wheel_damper = reader.get_double("wheel_damper", actuators.wheel_damper, 0.0, 1.0);
  actuators.wheel_friction = reader.get_double("wheel_friction", actuators.wheel_friction, 0.0, 1.0);
  reader.finish(documented_in);
  return actuators;
}

std::vector<JoystickControl> read_joystick(const toml::table& table, std::string_view file, Error& error) {
  TableReader reader(table, file, "car.joystick", error);
  std::vector<JoystickControl> controls;
  for (const std::string_view name : joystick_controls) {
    const toml::table* found = reader.get_table(name);
    if (!found) continue;
    TableReader control(*found, file, fmt::format("car.joystick.{}", name), error);
    JoystickControl result{.name = std::string(name)};
    result.is_axis = found->contains("axis");
    constexpr std::int64_t most_axes = 63, most_keys = 767;  // Linux' ABS_MAX and KEY_MAX.
    result.code = static_cast<std::uint16_t>(result.is_axis ? control.get_integer("axis", 0, 0, most_axes)
                                                            : control.get_integer("button", 0, 1, most_keys));
    if (!result.is_axis && !found->contains("button"))
      control.report("button", fmt::format("{} is given neither an axis nor a button", name),
                     "let septet-car learn find it");
    if (result.is_axis) {
      constexpr double most = 2147483648.0;
      result.at_zero = control.get_double("at_zero", 0.0, -most, most);
      result.at_one = control.get_double("at_one", 1.0, -most, most);
      result.dead_zone = control.get_double("dead_zone", 0.0, 0.0, 0.5);
      if (result.at_zero == result.at_one)
        control.report("at_one", "both ends of the axis are one", "let septet-car learn find them");
    }
    control.finish(documented_in);
    controls.push_back(std::move(result));
  }
  reader.finish(documented_in);
  return controls;
}

UsbEndpoints read_usb(const toml::table& table, std::string_view file, Error& error) {
  TableReader reader(table, file, "car.usb", error);
  constexpr std::int64_t direction_in = 0x80, most_endpoints = 15;  // USB 2.0, 9.6.6.
  UsbEndpoints usb;
  usb.interface = static_cast<std::uint8_t>(reader.get_integer("interface", usb.interface, 0, 255));
  usb.in = static_cast<std::uint8_t>(reader.get_integer("in", usb.in, direction_in + 1, direction_in + most_endpoints));
  usb.out = static_cast<std::uint8_t>(reader.get_integer("out", usb.out, 0, most_endpoints));
  reader.finish(documented_in);
  return usb;
}

Car read_car(const toml::table& table, std::string_view file, Error& error) {
  TableReader reader(table, file, "car", error);
  Car car;
  car.source = static_cast<CarSource>(
      reader.get_choice("source", 0, {"simulated-driver", "hid", "keyboard", "automatic", "can", "joystick"}));
  car.vendor_id = static_cast<std::uint16_t>(reader.get_integer("vendor_id", car.vendor_id, 0, 65535));
  car.product_id = static_cast<std::uint16_t>(reader.get_integer("product_id", car.product_id, 0, 65535));
  car.serial = reader.get_string("serial", car.serial);
  car.machine = read_machine(reader);
  car.keyboard_screen = reader.get_string("keyboard_screen", car.keyboard_screen);
  car.access = static_cast<HidAccess>(reader.get_choice("access", 0, {"automatic", "hidraw", "libusb"}));
  if (const auto* usb = reader.get_table("usb")) car.usb = read_usb(*usb, file, error);
  if (car.usb && car.access == HidAccess::hidraw)
    reader.report("access", "car.access is \"hidraw\", and [car.usb] names endpoints, which libusb opens",
                  "leave one of them out");
  car.layout = reader.get_string("layout", car.layout);
  car.vehicle = reader.get_string("vehicle", car.vehicle);
  car.driver = reader.get_string("driver", car.driver);
  if (const auto* calibration = reader.get_table("calibration"))
    car.calibration = read_calibration(*calibration, file, error);
  if (const auto* actuators = reader.get_table("actuators")) {
    car.actuators = read_actuators(*actuators, file, error);
    car.names_actuators = true;
  }
  if (const auto* joystick = reader.get_table("joystick")) car.joystick = read_joystick(*joystick, file, error);
  if (car.source == CarSource::joystick && car.joystick.empty())
    reader.report("source", "car.source is \"joystick\", and no control of it is known",
                  "add the [car.joystick] that septet-car learn prints");
  reader.finish(documented_in);
  return car;
}

/// The DBC file's names are resolved where it is read.
CanSignal read_can_signal(TableReader& reader, std::string_view signal, const toml::node& node) {
  CanSignal result{std::string(signal), node.value<std::string>().value_or(""), node.value<double>().value_or(0.0)};
  const auto point = signal.find('.');
  if (point == 0 || point == std::string_view::npos || point + 1 == signal.size())
    reader.report(signal, fmt::format("\"{}\" names no signal", signal), "write \"MESSAGE.SIGNAL\" in quotes");
  else if (result.quantity.empty() && !(node.is_number() && std::abs(result.constant) < 1e15))
    reader.report(signal, fmt::format("the signal \"{}\" is given neither a quantity nor a number", signal),
                  "name one of car-io/can/README.md, or a constant");
  return result;
}

Can read_can(const toml::table& table, std::string_view file, Error& error) {
  TableReader reader(table, file, "can", error);
  Can can;
  can.interface = reader.get_string("interface", "");
  constexpr std::size_t longest = 15;  // Linux' IFNAMSIZ with its 0.
  if (can.interface.empty() || can.interface.size() > longest ||
      can.interface.find_first_of(std::string_view("/ :\t\n\0", 6)) != std::string::npos)
    reader.report("interface", "can.interface names no network interface",
                  "write one that `ip link` lists, such as can0");
  can.dbc = reader.get_string("dbc", can.dbc);
  if (can.dbc.empty()) reader.report("dbc", "can.dbc is empty", "name a DBC file");
  if (const auto* signals = reader.get_table("signals")) {
    TableReader names(*signals, file, "can.signals", error);
    for (const auto& [signal, node] : *signals) can.signals.push_back(read_can_signal(names, signal.str(), node));
  }
  reader.finish(documented_in);
  return can;
}

Sound read_sound(const toml::table& table, std::string_view file, Error& error) {
  TableReader reader(table, file, "sound", error);
  Sound sound;
  sound.device = reader.get_string("device", "");
  sound.speakers = static_cast<Sound::Speakers>(reader.get_choice("speakers", 0, {"stereo", "5.1", "headphones"}));
  sound.volume_db = reader.get_double("volume_db", sound.volume_db, -60.0, 40.0);
  reader.finish(documented_in);
  return sound;
}

/// A keyboard must be able to reach the car, where the rig requires one.
void check_keyboard(const Rig& rig, TableReader& reader) {
  const std::string& name = rig.car.keyboard_screen;
  if (!name.empty() && std::ranges::find(rig.screens, name, &Screen::name) == rig.screens.end())
    reader.report("car", fmt::format("car.keyboard_screen is \"{}\", and there is no such screen", name),
                  "name one of the rig's screens");
  else if (rig.car.source == CarSource::keyboard && !rig.screens.empty() && driving_screens(rig).empty())
    reader.report("car", "no screen is at the server's own machine, so that no keyboard drives",
                  "name the driver's screen in car.keyboard_screen");
}

}  // namespace

std::set<std::string> driving_screens(const Rig& rig) {
  std::set<std::string> names;
  if (rig.car.source != CarSource::keyboard) return names;
  for (const Screen& screen : rig.screens)
    if (rig.car.keyboard_screen.empty() ? screen.machine.empty() : screen.name == rig.car.keyboard_screen)
      names.insert(screen.name);
  return names;
}

std::optional<Vec2> point_ahead(const Rig& rig, const Screen& screen) {
  const Window& window = screen.views.front().window;
  const Vec3 right = window.lower_right_m - window.lower_left_m, up = window.upper_left_m - window.lower_left_m;
  const Vec3 normal = glm::cross(right, up);
  if (std::abs(normal.x) < 1e-9 * glm::length(normal)) return std::nullopt;
  const double distance_m = glm::dot(window.lower_left_m - rig.eye_point_m, normal) / normal.x;
  if (distance_m <= 0.0) return std::nullopt;
  const Vec3 offset_m = rig.eye_point_m + Vec3(distance_m, 0.0, 0.0) - window.lower_left_m;
  return Vec2(glm::dot(offset_m, right) / glm::dot(right, right), 1.0 - glm::dot(offset_m, up) / glm::dot(up, up));
}

const Screen& screen_ahead(const Rig& rig) {
  const auto beside = [&](const Screen& screen) {
    const auto point = screen.only_instruments ? std::nullopt : point_ahead(rig, screen);
    return point ? glm::distance(*point, glm::clamp(*point, 0.0, 1.0)) : std::numeric_limits<double>::infinity();
  };
  return *std::ranges::min_element(rig.screens, {}, beside);
}

Expected<Rig> read_rig(std::string_view text, std::string_view name) {
  const auto document = document::parse_toml(text, name);
  if (!document) return tl::unexpected(document.error());
  Error error;
  TableReader reader(*document, name, "rig", error);
  Rig rig;
  rig.name = reader.get_string("name", "");
  rig.eye_point_m = reader.get_point("eye_point_m");
  if (const auto* table = reader.get_table("network")) rig.network = read_network(*table, name, error);
  if (const auto* table = reader.get_table("car")) rig.car = read_car(*table, name, error);
  if (const auto* table = reader.get_table("can")) rig.can = read_can(*table, name, error);
  if (const auto* table = reader.get_table("sound")) rig.sound = read_sound(*table, name, error);
  if (rig.car.source == CarSource::can && (!rig.can || !rig.car.machine.empty()))
    reader.report("car", "car.source is \"can\", and the rig has no CAN bus at the server's own machine",
                  "add a [can] table, and leave car.machine out");
  if (const auto* table = reader.get_table("head")) rig.head = read_head(*table, name, error);
  std::set<std::string> names;
  for (const toml::table* table : reader.get_tables("mirror")) {
    rig.mirrors.push_back(read_mirror(*table, rig.eye_point_m, name, error));
    if (!names.insert(rig.mirrors.back().name).second)
      reader.report("mirror", fmt::format("two mirrors are called \"{}\"", rig.mirrors.back().name),
                    "give each its own name");
  }
  if (rig.mirrors.size() > 16) reader.report("mirror", "the rig has more than 16 mirrors", "leave some out");
  names.clear();
  for (const toml::table* table : reader.get_tables("screen")) {
    rig.screens.push_back(read_screen(*table, rig.mirrors, name, error));
    if (!names.insert(rig.screens.back().name).second)
      reader.report("screen", fmt::format("two screens are called \"{}\"", rig.screens.back().name),
                    "give each its own name");
  }
  check_keyboard(rig, reader);
  if (error.what.empty()) check_sight(rig, reader);
  if (std::ranges::all_of(rig.screens, &Screen::only_instruments))
    reader.report("screen", rig.screens.empty() ? "the rig has no screen" : "no screen of the rig shows the road",
                  "add a [[screen]]");
  if (rig.screens.size() > 64) reader.report("screen", "the rig has more than 64 screens", "split it");
  reader.finish(documented_in);
  if (!error.what.empty()) return tl::unexpected(error);
  return rig;
}

}  // namespace septet::rig
