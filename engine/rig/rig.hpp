#pragma once
/// The rig: what surrounds the driver, and how the machines talk. One TOML file (rigs/*.toml); rigs/README.md explains it.
///
/// Lengths are metres in the car's frame (vehicle frame: x forward, y left, z up, origin on the ground below the middle of
/// the rear axle). Reading a rig is the only function that can fail, and its errors name file, line and remedy.

#include <array>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/expected.hpp"
#include "engine/math/rigid_transform.hpp"

namespace septet::rig {

/// A flat rectangle in space that the driver looks through.
struct Window {
  Vec3 lower_left_m, lower_right_m, upper_left_m;
  Vec3 upper_right_m() const { return lower_right_m + upper_left_m - lower_left_m; }
};

/// A mirror of the car: where its glass is, whether a real one hangs there or a screen shows what is seen in it.
struct Mirror {
  std::string name;
  Window glass;           ///< As the driver sees it from the eye point.
  double radius_m = 0.0;  ///< Of a convex glass's curvature; 0: flat.
  double from_rad = 0.0,
         to_rad = 0.0;  ///< Headings of the head, to the left, that count as a look at it: from ≤ heading < to.
};

/// One picture within a screen: the whole of it, or an inset such as a mirror.
struct View {
  Window window;
  std::optional<std::size_t> mirror;  ///< What is seen in this one of the rig's; `window` is then its glass.
  bool mirrored = false;              ///< Flipped left to right, as seen in a mirror.
  /// Where it lies on the screen, as fractions from the upper left corner.
  double left = 0.0, top = 0.0, width = 1.0, height = 1.0;
};

struct Screen {
  std::string name;
  std::uint32_t width_px = 640, height_px = 480;
  std::string machine;  ///< Host that drives it; empty: the server's own machine.
  std::optional<std::uint32_t>
      monitor;               ///< Of its machine, from 0; nothing: where the window system likes, full screen the first.
  bool full_screen = false;  ///< Cover the monitor.
  bool show_interior = false;     ///< Draw the car's bonnet and dashboard (a desktop has no car around it).
  bool instruments = false;       ///< Draw speed, gear and indicators, where no real car shows them.
  bool only_instruments = false;  ///< It shows the car's dials and lamps, and nothing of the road; it has no insets.
  std::vector<View> views;        ///< The first one fills the screen.
};

enum class TickTransport : std::uint8_t { automatic, multicast, unicast };

struct Network {
  std::string server_address = "127.0.0.1";  ///< Where screens find the server.
  std::uint16_t scene_port = 4750;           ///< UDP, secure unicast lane; 0: any free port (one machine only).
  std::string tick_group = "239.77.77.77";
  std::uint16_t tick_port = 4751;
  std::string
      interface_address;  ///< The server's address on the rig's network: it listens there only. Empty: on all of a rig of several machines.
  TickTransport transport = TickTransport::automatic;
  std::uint32_t max_payload_bytes = 1200;
  double playout_delay_ticks = 2.0;
};

/// `automatic`: the HID device where it is plugged in, else the keyboard (or gamepad) of a screen's window. `can`: the rig's CAN bus.
/// `joystick`: any input device of Linux, by [car.joystick].
enum class CarSource : std::uint8_t { simulated_driver, hid, keyboard, automatic, can, joystick };

/// How one axis of a particular device differs from its report layout: readings on the layout's own scale (hand wheel: −1 full
/// right to 1 full left; pedal: 0 released to 1 floored). `septet-car calibrate` records and prints them.
struct AxisCalibration {
  double min = 0.0;        ///< Reading at one end: full right, or released.
  double centre = 0.0;     ///< Hand wheel only: reading held straight.
  double max = 1.0;        ///< Reading at the other end: full left, or floored.
  double dead_zone = 0.0;  ///< Share of the travel, around straight or from released, that reads as 0.
  bool inverted = false;   ///< The device counts the other way round.
};

/// How far full steering is, and each axis.
struct CarCalibration {
  double steering_lock_rad = 2.5 * std::numbers::pi;  ///< 2½ turns from lock to lock.
  AxisCalibration steering{.min = -1.0}, accelerator, brake, clutch;
  bool gear_lever = false;  ///< Without one, a layout's gear buttons do not count and the gearbox is in drive.
};

/// What the car's fan, shaker and steering motor may do; outputs are shares of what the device can, 0 to 1.
struct CarActuators {
  double fan_full_speed_mps = 41.7;  ///< The fan is full from here on (150 km/h).
  /// What of the wind is linear in the car's speed: the air's speed, or its force, which grows with the square of that.
  enum class Wind : std::uint8_t { air_speed, force } fan_follows = Wind::air_speed;
  double fan_least = 0.2;  ///< Share at which the fan just turns.
  std::vector<Vec2>
      fan_curve;  ///< As it was measured: shares of the fan and the air's speed there, both rising. Empty: linear from fan_least.
  double fan_most = 1.0;
  double vibration_most = 0.6;
  double vibration_full_mps2 =
      0.0;  ///< Measured at the seat with the shaker at its full, root mean square; 0: not measured, no dose.
  double vibration_dose_mps2 = 0.5;  ///< Daily exposure A(8) at which the shaker is cut.
  double steering_full_nm = 8.0;     ///< Torque at the hand wheel that full force means.
  double steering_most = 0.0;        ///< 0: the hand wheel has no motor.
  /// What a joystick's wheel does by itself beside that, where it can, as shares of its force: a power-steered car's damper and friction, so
  /// that it does not tremble and does not run on. A spring to the middle is no car's.
  double wheel_spring = 0.0, wheel_damper = 0.10, wheel_friction = 0.04;
};

/// What one control of the car is on an input device (evdev): an axis with its values at both ends, or a button.
struct JoystickControl {
  std::string name;  ///< "steering", "accelerator", …, "horn", "gear_1": as `septet-car learn` prints them.
  bool is_axis = false;
  std::uint16_t code = 0;  ///< Linux' ABS_ or BTN_ number.
  double at_zero = 0.0,
         at_one = 1.0;     ///< Of an axis: straight and full left; released and floored. Either may be the greater.
  double dead_zone = 0.0;  ///< Share of the travel that reads as 0.
};

/// How a HID device is opened: through its hidraw node, or past the kernel's driver by libusb; automatic: hidraw, else libusb.
enum class HidAccess : std::uint8_t { automatic, hidraw, libusb };

/// Of a USB device that is no HID device: where its reports come from and go to.
struct UsbEndpoints {
  std::uint8_t interface = 0;
  std::uint8_t in = 0x81;  ///< Interrupt or bulk, as the next.
  std::uint8_t out = 0;    ///< 0: it takes outputs as requests (car-io/REPORTS.md).
};

struct Car {
  CarSource source = CarSource::simulated_driver;
  std::uint16_t vendor_id = 0x1209, product_id = 0x0001;
  std::string serial;
  std::string machine;          ///< Host with the device, where septet-car runs; empty: the server's own machine.
  std::string keyboard_screen;  ///< Whose keyboard or gamepad drives; empty: any screen's at the server's own machine.
  HidAccess access = HidAccess::automatic;
  std::optional<UsbEndpoints> usb;    ///< Then it is opened by libusb.
  std::string layout = "septet-car";  ///< Report layout of the device (car-io/REPORTS.md).
  std::string vehicle = "volvo-s80";  ///< Parameter file below vehicles/.
  std::string driver = "plain";       ///< Which simulated driver.
  CarCalibration calibration;
  CarActuators actuators;
  bool names_actuators = false;  ///< Whether the rig has a [car.actuators] table.
  std::vector<JoystickControl> joystick;
};

/// What one signal of the DBC file carries, where its own name does not say so.
struct CanSignal {
  std::string signal;     ///< "MESSAGE.SIGNAL".
  std::string quantity;   ///< One of car-io/can/README.md; empty: the constant.
  double constant = 0.0;  ///< Sent always.
};

/// The CAN bus of instruments and controls, at the server's own machine.
struct Can {
  std::string interface;            ///< Linux' name of it: can0, vcan0.
  std::string dbc = "cluster.dbc";  ///< File that says what the frames mean, from the rig file's folder.
  std::vector<CanSignal> signals;
};

/// Which number of a head tracker is meant, and which way it counts.
struct HeadAxis {
  enum class Of : std::uint8_t { x, y, z, yaw, pitch, roll } of = Of::x;
  bool inverted = false;
};

/// Where a head tracker's UDP datagrams come in, in OpenTrack's format (car-io/head).
struct HeadTracking {
  std::string listen = "127.0.0.1";  ///< The server's own address that they come to.
  std::uint16_t port = 4242;
  HeadAxis forward{HeadAxis::Of::z, true}, left{HeadAxis::Of::x, true}, up{HeadAxis::Of::y, false},
      turn_left{HeadAxis::Of::yaw, true};
  Vec3 reach_m{0.3, 0.3, 0.2};  ///< How far to each side of the eye point the eyes may be, along the car's axes.
};

/// Where the driver hears the drive, at the server's own machine.
struct Sound {
  std::string device;  ///< OpenAL's name of it; empty: the usual one.
  enum class Speakers : std::uint8_t { stereo, surround_51, headphones } speakers = Speakers::stereo;
  double volume_db = 0.0;  ///< 0: full scale is a pressure of 1 Pa.
};

struct Rig {
  std::string name;
  Vec3 eye_point_m{0.0};
  std::vector<Screen> screens;
  std::vector<Mirror> mirrors;
  Network network;
  Car car;
  std::optional<Can> can;
  std::optional<Sound> sound;
  std::optional<HeadTracking> head;
};

/// The screens whose keyboard or gamepad drives: none unless the rig's car is driven so.
std::set<std::string> driving_screens(const Rig& rig);

/// Where the driver's look straight ahead meets the plane of the screen, as fractions of the screen from its upper left (beyond
/// 0 to 1: it passes the screen); nothing for a screen that does not stand ahead.
std::optional<Vec2> point_ahead(const Rig& rig, const Screen& screen);
/// The screen that the driver looks ahead through, or that is nearest to it.
const Screen& screen_ahead(const Rig& rig);

/// Parses the text of a rig file; `name` is used in messages. Unknown keys are errors, so that a misspelt one is noticed.
Expected<Rig> read_rig(std::string_view toml, std::string_view name);

}  // namespace septet::rig
