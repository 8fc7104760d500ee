#include "sim-server/drive/car_motion.hpp"

namespace septet::server {

car_io::CarMotion car_motion(const simulation::Model& model, const simulation::State& state) {
  const auto out = vehicle::outputs(model.car, state.car);
  car_io::CarMotion motion;
  motion.speed_mps = out.speed_mps;
  motion.engine_radps = state.car.powertrain.engine_running ? out.engine_radps : 0.0;
  motion.engine_load = state.input.accelerator;
  motion.cylinders = model.car.powertrain.cylinders;
  motion.wheel_radius_m = model.car.tyre.radius_m;
  motion.anti_lock_active = out.anti_lock_active;
  motion.steering_torque_nm = out.steering_torque_nm;
  return motion;
}

}  // namespace septet::server
