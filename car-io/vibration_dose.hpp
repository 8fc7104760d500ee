#pragma once
/// The driver's exposure to the shaker's vibration: the daily exposure of Directive 2002/44/EC, Annex B, by ISO 2631-1.
///
/// a_w is the root mean square of the frequency-weighted acceleration at the seat; A(8) = √(∫ a_w² dt / 8 h). The
/// directive asks for action from 0.5 m/s² and allows 1.15 m/s². The shaker's acceleration at full scale is measured
/// once at the seat and stands in the rig (vibration_full_mps2); without it there is no dose.

#include <optional>
#include <string>

#include "car-io/car_report.hpp"
#include "engine/rig/rig.hpp"

namespace septet::car_io {

/// Weight of a vertical acceleration of this frequency, 0 to 1.05: Wk of ISO 2631-1:1997, 5.1, as its transfer function
/// gives it.
double vertical_weight(double frequency_hz);

struct VibrationDose {
  double exposure_m2ps3 = 0.0;  ///< ∫ a_w² dt.

  void add(const Actuators& actuators, double full_mps2, double dt_s);
  double a8_mps2() const;
};

/// A shaker that has used up a day's dose rests until the program ends.
class DoseLimit {
 public:
  /// Permitted part of `wanted` for the next dt_s.
  Actuators pass(Actuators wanted, const rig::CarActuators& limits, double dt_s);
  bool is_reached() const { return is_reached_; }
  /// Message for a person, once.
  std::optional<std::string> take_message();

 private:
  VibrationDose dose_;
  bool is_reached_ = false, is_told_ = false;
};

}  // namespace septet::car_io
