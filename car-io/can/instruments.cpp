#include "car-io/can/instruments.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/world/car_warnings.hpp"

namespace septet::car_io {
namespace {

constexpr double warm_engine_c = 90.0, tank_percent = 60.0;
constexpr double kelvin_at_0_c = 273.15;
constexpr double shows_from_kmh = 0.5;  // Below, a car that stands trembles.

double lit(bool on) { return on ? 1.0 : 0.0; }

}  // namespace

Instruments instruments_of(const Snapshot& snapshot, const DriverInput& input, const CarMotion& motion,
                           bool has_lost_controls) {
  const DriverCar& car = snapshot.driver_car;
  const Participant* participant = find_participant(snapshot, car.participant);
  const Lamps lamps = participant ? participant->lamps : Lamps{};
  const double speed_kmh = std::abs(car.speed_mps) * 3.6;
  Instruments shown;
  shown.ignition = 1.0;
  shown.speed_kmh = speed_kmh < shows_from_kmh ? 0.0 : speed_kmh;
  shown.engine_rpm = std::max(motion.engine_radps, 0.0) * 30.0 / std::numbers::pi;
  shown.gear = car.gear;
  shown.selector = static_cast<double>(input.selector);
  shown.coolant_temperature_c = warm_engine_c;
  shown.outside_temperature_c = snapshot.environment.temperature_k - kelvin_at_0_c;
  shown.fuel_percent = tank_percent;
  shown.indicator_left = lit(lamps.has(Lamp::indicator_left));
  shown.indicator_right = lit(lamps.has(Lamp::indicator_right));
  shown.low_beam = lit(lamps.has(Lamp::low_beam));
  shown.high_beam = lit(lamps.has(Lamp::high_beam));
  shown.rear_fog = lit(lamps.has(Lamp::rear_fog));
  shown.parking_brake = lit(input.parking_brake);
  const CarWarnings warnings = car_warnings_of(snapshot);
  shown.anti_lock = lit(motion.anti_lock_active || warnings.anti_lock);
  shown.engine_fault = lit(warnings.engine);
  shown.tyre_pressure = lit(warnings.tyre_pressure);
  shown.lamp_fault = lit(warnings.lamp);
  shown.engine_stopped = lit(!(motion.engine_radps > 0.0));
  shown.controls_lost = lit(has_lost_controls);
  return shown;
}

}  // namespace septet::car_io
