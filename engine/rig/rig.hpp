#pragma once
/// The rig: screens and devices around the driver, and the machines' network. One TOML file (rigs/*.toml);
/// rigs/README.md explains it.
///
/// Lengths are metres in the car's frame (vehicle frame: x forward, y left, z up, origin on the ground below the middle
/// of the rear axle). Reading a rig is the only function that can fail, and its errors name file, line and remedy.

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
};

/// A mirror of the car: its glass, and whether it is real or shown by a screen.
struct Mirror {
  std::string name;
  Window glass;           ///< Glass as the driver sees it from the eye point.
  double radius_m = 0.0;  ///< Radius of a convex glass's curvature; 0: flat.
  double from_rad = 0.0,
         to_rad = 0.0;  ///< Headings of the head, to the left, that count as a look at it: from ≤ heading < to.
};

/// One picture within a screen: the whole of it, or an inset such as a mirror.
struct View {
  Window window;
  std::optional<std::size_t> mirror;  ///< Index of the mirror whose view it shows; `window` is then its glass.
  bool mirrored = false;              ///< Flipped left to right, as seen in a mirror.
  /// Its place on the screen, as fractions from the upper left corner.
  double left = 0.0, top = 0.0, width = 1.0, height = 1.0;
};

struct Screen {
  std::string name;
  std::uint32_t width_px = 640, height_px = 480;
  std::string machine;  ///< Host that drives it; empty: the server's own machine.
  /// Number of its machine's monitor, from 0; absent: the window system's choice, full screen the first.
  std::optional<std::uint32_t> monitor;
  bool full_screen = false;       ///< Cover the monitor.
  bool show_interior = false;     ///< Draw the car's bonnet and dashboard (a desktop has no car around it).
  bool instruments = false;       ///< Draw speed, gear and indicators, where no real car shows them.
  bool only_instruments = false;  ///< It shows the car's dials and lamps, and nothing of the road; it has no insets.
  std::vector<View> views;        ///< The first one fills the screen.
};

enum class TickTransport : std::uint8_t { automatic, multicast, unicast };

struct Network {
  std::string server_address = "127.0.0.1";  ///< Address at which screens find the server.
  std::uint16_t scene_port = 4750;           ///< UDP, secure unicast lane; 0: any free port (one machine only).
  std::string tick_group = "239.77.77.77";
  std::uint16_t tick_port = 4751;
  std::string
      /// The server's address on the rig's network: it listens there only. Empty: on all addresses of a rig of several
      /// machines.
      interface_address;
  TickTransport transport = TickTransport::automatic;
  std::uint32_t max_payload_bytes = 1200;
  double playout_delay_ticks = 2.0;
};

/// `automatic`: the HID device where it is plugged in, else the keyboard (or gamepad) of a screen's window. `can`: the
/// rig's CAN bus. `joystick`: any input device of Linux, by [car.joystick].
enum class CarSource : std::uint8_t { simulated_driver, hid, keyboard, automatic, can, joystick };

/// Difference of one axis of a particular device from its report layout: readings on the layout's own scale (hand
/// wheel: −1 full right to 1 full left; pedal: 0 released to 1 floored). `septet-car calibrate` records and prints
/// them.
struct AxisCalibration {
  double min = 0.0;        ///< Reading at one end: full right, or released.
  double centre = 0.0;     ///< Hand wheel only: reading held straight.
  double max = 1.0;        ///< Reading at the other end: full left, or floored.
  double dead_zone = 0.0;  ///< Share of the travel, around straight or from released, that reads as 0.
  bool inverted = false;   ///< The device counts in the opposite direction.
};

/// Angle of full steering, and each axis.
struct CarCalibration {
  double steering_lock_rad = 2.5 * std::numbers::pi;  ///< 2½ turns from lock to lock.
  AxisCalibration steering{.min = -1.0}, accelerator, brake, clutch;
  bool gear_lever = false;  ///< Without one, a layout's gear buttons do not count and the gearbox is in drive.
};

/// Settings of the car's fan, shaker and steering motor; outputs are shares of the device's maximum, 0 to 1.
struct CarActuators {
  double fan_full_speed_mps = 41.7;  ///< The fan is full from here on (150 km/h).
  /// Quantity of the wind that is linear in the car's speed: the air's speed, or its force, which grows with the
  /// square of that.
  enum class Wind : std::uint8_t { air_speed, force } fan_follows = Wind::air_speed;
  double fan_least = 0.2;  ///< Share at which the fan just turns.
  std::vector<Vec2>
      /// Measured curve: shares of the fan and the air's speed there, both rising. Empty: linear from fan_least.
      fan_curve;
  double fan_most = 1.0;
  double vibration_most = 0.6;
  /// Measured at the seat with the shaker at its full, root mean square; 0: not measured, no dose.
  double vibration_full_mps2 = 0.0;
  double vibration_dose_mps2 = 0.5;  ///< Daily exposure A(8) at which the shaker is cut.
  double steering_full_nm = 8.0;     ///< Torque at the hand wheel for full force.
  double steering_most = 0.0;        ///< 0: the hand wheel has no motor.
  /// Effects of a joystick's wheel by itself beside that, where it has them, as shares of its force: a power-steered
  /// car's damper and friction, so that it does not tremble and does not run on. Cars have no spring to the middle.
  double wheel_spring = 0.0, wheel_damper = 0.10, wheel_friction = 0.04;
};

/// One control of the car on an input device (evdev): an axis with its values at both ends, or a button.
struct JoystickControl {
  std::string name;  ///< "steering", "accelerator", …, "horn", "gear_1": as `septet-car learn` prints them.
  bool is_axis = false;
  std::uint16_t code = 0;  ///< Linux' ABS_ or BTN_ number.
  double at_zero = 0.0,
         at_one = 1.0;  ///< Values of an axis: straight and full left; released and floored. Either may be the greater.
  double dead_zone = 0.0;  ///< Share of the travel that reads as 0.
};

/// Access to a HID device: through its hidraw node, or past the kernel's driver by libusb; automatic: hidraw, else
/// libusb.
enum class HidAccess : std::uint8_t { automatic, hidraw, libusb };

/// Endpoints for reports of a USB device that is no HID device.
struct UsbEndpoints {
  std::uint8_t interface = 0;
  std::uint8_t in = 0x81;  ///< Interrupt or bulk, as the next.
  std::uint8_t out = 0;    ///< 0: it takes outputs as requests (car-io/REPORTS.md).
};

struct Car {
  CarSource source = CarSource::simulated_driver;
  std::uint16_t vendor_id = 0x1209, product_id = 0x0001;
  std::string serial;
  std::string machine;  ///< Host with the device, where septet-car runs; empty: the server's own machine.
  /// Screen whose keyboard or gamepad drives; empty: any screen's at the server's own machine.
  std::string keyboard_screen;
  HidAccess access = HidAccess::automatic;
  std::optional<UsbEndpoints> usb;    ///< Set: it is opened by libusb.
  std::string layout = "septet-car";  ///< Report layout of the device (car-io/REPORTS.md).
  std::string vehicle = "volvo-s80";  ///< Parameter file below vehicles/.
  std::string driver = "plain";       ///< Name of the simulated driver.
  CarCalibration calibration;
  CarActuators actuators;
  bool names_actuators = false;  ///< True where the rig has a [car.actuators] table.
  std::vector<JoystickControl> joystick;
};

/// Meaning of one signal of the DBC file, where its own name does not give it.
struct CanSignal {
  std::string signal;     ///< "MESSAGE.SIGNAL".
  std::string quantity;   ///< One of car-io/can/README.md; empty: the constant.
  double constant = 0.0;  ///< Sent always.
};

/// The CAN bus of instruments and controls, at the server's own machine.
struct Can {
  std::string interface;            ///< Linux' name of it: can0, vcan0.
  std::string dbc = "cluster.dbc";  ///< File with the frames' meaning, from the rig file's folder.
  std::vector<CanSignal> signals;
};

/// Index of a head tracker's number, and its sign.
struct HeadAxis {
  enum class Of : std::uint8_t { x, y, z, yaw, pitch, roll } of = Of::x;
  bool inverted = false;
};

/// Source of a head tracker's UDP datagrams, in OpenTrack's format (car-io/head).
struct HeadTracking {
  std::string listen = "127.0.0.1";  ///< The server's own address at which they arrive.
  std::uint16_t port = 4242;
  HeadAxis forward{HeadAxis::Of::z, true}, left{HeadAxis::Of::x, true}, up{HeadAxis::Of::y, false},
      turn_left{HeadAxis::Of::yaw, true};
  Vec3 reach_m{0.3, 0.3, 0.2};  ///< Range of the eyes to each side of the eye point, along the car's axes.
};

/// Sound device of the drive, at the server's own machine.
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

/// The screens whose keyboard or gamepad drives: empty unless the rig's car is driven so.
std::set<std::string> driving_screens(const Rig& rig);

/// Place where the driver's look straight ahead meets the plane of the screen, as fractions of the screen from its
/// upper left (beyond 0 to 1: it passes the screen); empty for a screen that does not stand ahead.
std::optional<Vec2> point_ahead(const Rig& rig, const Screen& screen);
/// The screen straight ahead of the driver, or the nearest to it.
const Screen& screen_ahead(const Rig& rig);

/// Parses the text of a rig file; `name` is used in messages. Unknown keys are errors, so that a misspelt one is
/// noticed.
Expected<Rig> read_rig(std::string_view toml, std::string_view name);

}  // namespace septet::rig
