#pragma once
/// A car on a level test track, with the operations common to all manoeuvres: hold a speed, freeze the throttle,
/// record.

#include <functional>

#include "engine/physics/vehicle/manoeuvre.hpp"
#include "engine/physics/vehicle/vehicle.hpp"

namespace septet::vehicle {

inline constexpr double manoeuvre_step_s = 0.001;
inline constexpr double sample_interval_s = 0.01;

class ManoeuvreCar {
 public:
  /// Rolls straight ahead at this speed, settled for options.settle_s with the speed held.
  ManoeuvreCar(const VehicleParameters& parameters, const ManoeuvreOptions& options, double speed_mps);

  /// Advances by one step with this road-wheel angle; pedals as left by hold_speed, freeze or input().
  void advance(double steer_rad);
  /// Like advance, but with given wheel torques instead of pedals.
  void advance_with_torques(const ChassisInput& chassis);
  /// Sets the accelerator so as to hold this speed from the next step on.
  void hold_speed(double speed_mps);
  /// Keeps the present gear.
  void hold_gear();
  DriverInput& input() { return input_; }

  const VehicleParameters& parameters() const { return parameters_; }
  const VehicleState& state() const { return state_; }
  double time_s() const { return static_cast<double>(steps_) * manoeuvre_step_s; }
  double friction() const { return ground_[0].friction; }
  ManoeuvreSample sample() const;
  /// Sets the clock to zero and the origin here, and clears the series.
  void begin();
  /// Takes a sample when one is due.
  void record();
  const std::vector<ManoeuvreSample>& series() const { return series_; }

 private:
  VehicleParameters parameters_;
  Ground ground_;
  DriverInput input_;
  VehicleState state_;
  double integral_ = 0.0;
  double steer_rad_ = 0.0;
  long steps_ = 0;
  std::vector<ManoeuvreSample> series_;
};

/// Value of `quantity` where `key` first rises through `at`, by linear interpolation along the
/// series; the last value if it never does.
double first_crossing(const std::vector<ManoeuvreSample>& series,
                      const std::function<double(const ManoeuvreSample&)>& key, double at,
                      const std::function<double(const ManoeuvreSample&)>& quantity);

}  // namespace septet::vehicle
