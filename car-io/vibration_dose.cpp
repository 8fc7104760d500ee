#include "car-io/vibration_dose.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <utility>

#include <fmt/core.h>

namespace septet::car_io {

double vertical_weight(double frequency_hz) {
  if (!(frequency_hz > 0.0 && frequency_hz < 1e4)) return 0.0;
  // ISO 2631-1:1997, Annex A: band limits, acceleration to velocity, upward step of Wk.
  constexpr double f1 = 0.4, f2 = 100.0, f3 = 12.5, f4 = 12.5, q4 = 0.63, f5 = 2.37, q5 = 0.91, f6 = 3.35, q6 = 0.91;
  constexpr double butterworth = std::numbers::sqrt2;
  const std::complex<double> p(0.0, 2.0 * std::numbers::pi * frequency_hz);
  const auto w = [](double hz) { return 2.0 * std::numbers::pi * hz; };
  const auto high_pass = 1.0 / (1.0 + butterworth * w(f1) / p + (w(f1) / p) * (w(f1) / p));
  const auto low_pass = 1.0 / (1.0 + butterworth * p / w(f2) + (p / w(f2)) * (p / w(f2)));
  const auto transition = (1.0 + p / w(f3)) / (1.0 + p / (q4 * w(f4)) + (p / w(f4)) * (p / w(f4)));
  const auto step = (1.0 + p / (q5 * w(f5)) + (p / w(f5)) * (p / w(f5))) /
                    (1.0 + p / (q6 * w(f6)) + (p / w(f6)) * (p / w(f6))) * (f5 / f6) * (f5 / f6);
  return std::abs(high_pass * low_pass * transition * step);
}

void VibrationDose::add(const Actuators& actuators, double full_mps2, double dt_s) {
  const double a_w = actuators.vibration * full_mps2 * vertical_weight(actuators.vibration_hz);
  if (std::isfinite(a_w)) exposure_m2ps3 += a_w * a_w * dt_s;
}

double VibrationDose::a8_mps2() const {
  constexpr double day_s = 8.0 * 3600.0;
  return std::sqrt(exposure_m2ps3 / day_s);
}

Actuators DoseLimit::pass(Actuators wanted, const rig::CarActuators& limits, double dt_s) {
  if (!is_reached_) dose_.add(wanted, limits.vibration_full_mps2, dt_s);
  is_reached_ = is_reached_ || dose_.a8_mps2() > limits.vibration_dose_mps2;
  if (is_reached_) wanted.vibration = 0.0;
  return wanted;
}

std::optional<std::string> DoseLimit::take_message() {
  if (!is_reached_ || std::exchange(is_told_, true)) return std::nullopt;
  return fmt::format("the shaker is cut: the driver has had {:.2f} m/s2 over eight hours' time (2002/44/EC)",
                     dose_.a8_mps2());
}

}  // namespace septet::car_io
