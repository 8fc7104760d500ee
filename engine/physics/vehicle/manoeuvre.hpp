#pragma once
/// The standard manoeuvres of test tracks. Each starts from settled straight running, returns its figures and the time
/// series behind them, and is a pure function.
///
/// Angles of steer are those of the road wheels in the mean of the axle: hand wheel over steering ratio, by ISO 8855.
/// Left turns, unless said otherwise.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/expected.hpp"
#include "engine/core/figure.hpp"
#include "engine/physics/vehicle/vehicle_parameters.hpp"
#include "engine/world/driver_input.hpp"

namespace septet::vehicle {

/// One instant, in the axes of ISO 8855.
struct ManoeuvreSample {
  double time_s = 0.0;
  double x_m = 0.0, y_m = 0.0;  ///< Place of the centre of the sprung mass.
  double heading_rad = 0.0;
  double steer_rad = 0.0;  ///< Hand wheel over ratio.
  double speed_mps = 0.0;
  double yaw_rate_radps = 0.0;
  double lateral_acceleration_mps2 = 0.0, longitudinal_acceleration_mps2 = 0.0;
  double sideslip_rad = 0.0, roll_rad = 0.0;
  double steering_torque_nm = 0.0;
  double least_wheel_load_n = 0.0;
};

struct ManoeuvreReport {
  std::string manoeuvre;  ///< Name on the command line.
  std::string standard;
  std::vector<Figure> figures;
  std::vector<ManoeuvreSample> series;
  /// Reasons why the figures do not describe the car, or a figure is missing: "60 mph was not reached in 100 s: …".
  std::vector<std::string> faults;

  /// The figure of this name; it must exist.
  double figure(std::string_view name) const;
};

struct ManoeuvreOptions {
  double speed_mps = 0.0;  ///< 0: the manoeuvre's usual speed.
  double friction = 0.0;   ///< 0: that of the surface of the tyre's data.
  double steer_rad = 0.0;  ///< Amplitude of step steer and sine with dwell; 0: found by the manoeuvre.
  double settle_s = 8.0;   ///< Straight running before the manoeuvre begins.
  /// Absent: on for the sine with dwell, which is its test, and for given inputs; off otherwise. Only where the car has
  /// one.
  std::optional<bool> stability_control;
};

/// ISO 4138: constant speed (100 km/h), steering wheel turned slowly until the front axle slides or a wheel lifts.
/// Figures at 2 and 4 m/s² and slopes between 1 and 3: understeer gradient, yaw gain, sideslip, roll.
ManoeuvreReport steady_circle(const VehicleParameters& parameters, const ManoeuvreOptions& options);

/// ISO 7401: step to the angle that gives 4 m/s², at 0.4 rad/s of the road wheels, throttle frozen (80 km/h).
ManoeuvreReport step_steer(const VehicleParameters& parameters, const ManoeuvreOptions& options);

/// ISO 3888-1: double lane change (80 km/h) by a driver who looks 0.6 s ahead, throttle frozen.
ManoeuvreReport double_lane_change(const VehicleParameters& parameters, const ManoeuvreOptions& options);

/// ISO 19365: sine with dwell, 0.7 Hz, 0.5 s, at 80 km/h in neutral throttle; amplitude 5 times the angle for 0.3 g.
ManoeuvreReport sine_with_dwell(const VehicleParameters& parameters, const ManoeuvreOptions& options);

/// ISO 21994: full stop (100 km/h) with the anti-lock system, or without one with every wheel held at its best slip.
ManoeuvreReport stop(const VehicleParameters& parameters, const ManoeuvreOptions& options);

/// Rolling out in neutral (120 km/h) down to 20 km/h.
ManoeuvreReport coast_down(const VehicleParameters& parameters, const ManoeuvreOptions& options);

/// Full throttle from rest for 100 s: 0–60 mph, 0–100 km/h and top speed. A speed that was not reached is a fault and
/// no figure.
ManoeuvreReport acceleration(const VehicleParameters& parameters, const ManoeuvreOptions& options);

/// The driver's controls from `time_s` on; between two rows steering wheel and pedals change linearly.
struct TimedInput {
  double time_s = 0.0;
  DriverInput input;
};
/// Drives given inputs, from settled straight running at options.speed_mps (0: at rest) to the last row's time: the
/// peaks of the car's response. `rows`: at least two, times ascending.
ManoeuvreReport drive_inputs(const VehicleParameters& parameters, const ManoeuvreOptions& options,
                             const std::vector<TimedInput>& rows);

/// Appends the faults possible in every manoeuvre: non-finite numbers, a car that turned over or spun.
void find_faults(ManoeuvreReport& report);

/// Runs a manoeuvre by its name on the command line: steady-circle, step-steer, double-lane-change, sine-with-dwell,
/// stop, coast-down, acceleration.
Expected<ManoeuvreReport> run_manoeuvre(std::string_view name, const VehicleParameters& parameters,
                                        const ManoeuvreOptions& options);
std::vector<std::string_view> manoeuvre_names();

}  // namespace septet::vehicle
