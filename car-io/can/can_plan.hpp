#pragma once
/// Signals of a DBC file and the car's quantities that they carry: instruments out, controls in.
///
/// A signal named like a quantity of the tables below carries that quantity; the rig's [can.signals] assigns one to
/// others, or a constant. README.md lists the quantities with their units.

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "car-io/can/dbc.hpp"
#include "engine/core/expected.hpp"
#include "engine/rig/rig.hpp"

namespace septet::car_io {

/// Values of a cluster; flags are 0 or 1.
struct Instruments {
  double ignition = 0.0;
  double speed_kmh = 0.0;
  double engine_rpm = 0.0;
  double gear = 0.0;      ///< −1 reverse, 0 neutral, 1…8.
  double selector = 0.0;  ///< GearSelector: 0 park to 4 manual.
  double coolant_temperature_c = 0.0, outside_temperature_c = 0.0;
  double fuel_percent = 0.0;
  double indicator_left = 0.0, indicator_right = 0.0;  ///< Lit now.
  double low_beam = 0.0, high_beam = 0.0, rear_fog = 0.0;
  double parking_brake = 0.0, anti_lock = 0.0;  ///< Warning lamps, likewise the next.
  double engine_stopped = 0.0, controls_lost = 0.0;
  double engine_fault = 0.0, tyre_pressure = 0.0, lamp_fault = 0.0;
};

/// The driver's controls, as signals carry them.
struct CanControls {
  double steering_wheel_deg = 0.0;  ///< Positive to the left.
  double accelerator_percent = 0.0, brake_percent = 0.0, clutch_percent = 0.0;
  double indicator_left_switch = 0.0, indicator_right_switch = 0.0;
  double hazard_switch = 0.0, horn_switch = 0.0;
  double low_beam_switch = 1.0, high_beam_switch = 0.0, parking_brake_switch = 0.0;
  double selector_position = 3.0;  ///< Values of GearSelector.
  double gear_position = 0.0;      ///< −1 reverse, 0 neutral, 1…6.
  double emergency_stop_switch = 0.0, rearm_switch = 0.0;
};

template <class Values>
struct Quantity {
  std::string_view name;
  double Values::*value;
};
std::span<const Quantity<Instruments>> instrument_quantities();
std::span<const Quantity<CanControls>> control_quantities();

/// Counts the frames of its message; clusters detect a hung sender by it.
struct FrameCounter {};

struct SentSignal {
  dbc::Signal signal;
  std::variant<double, double Instruments::*, FrameCounter> carries;  ///< A number: a constant.
};
/// A sent message; if multiplexed, with one selected value, which is among the signals as a constant. A plan has one
/// per value.
struct SentMessage {
  dbc::Message message;
  double period_s = 0.1;
  std::vector<SentSignal> signals;
};
struct HeardSignal {
  dbc::Signal signal;
  double CanControls::*control = nullptr;
};
/// A heard message, split likewise; signals present in every frame form an entry of their own.
struct HeardMessage {
  dbc::Message message;
  std::vector<HeardSignal> signals;
  bool must_beat = false;  ///< It carries the wheel or a pedal, so that its silence is a loss.
};
struct CanPlan {
  std::vector<SentMessage> sent;
  std::vector<HeardMessage> heard;
  bool needs_fd = false;
};

/// Error: an unknown signal or quantity, a message both sent and heard, overlapping signals, multiplexed ones that
/// nothing can select.
Expected<CanPlan> plan_can(const dbc::Database& database, const rig::Can& can);

}  // namespace septet::car_io
