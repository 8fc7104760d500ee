// Braking in a bend against the published multi-body model (vehicles/README.md).

#include "engine/physics/vehicle/suspension.hpp"
#include "tests/conformance/vehicle/reference_curve.hpp"

using namespace septet::vehicle;

namespace {

constexpr double degrees = 57.29577951308232;
constexpr double brake_s = 6.0, step_s = 0.001;

/// Torques that the published model makes of a commanded acceleration.
ChassisInput torques(const VehicleParameters& car, double steer_rad, double command_mps2) {
  ChassisInput input;
  input.steer_rad = steer_rad;
  const double torque_nm = car.body.mass_kg * car.tyre.radius_m * command_mps2;
  const auto& full_nm = car.brakes.full_torque_nm;
  for (int i = 0; i < wheel_count; ++i) {
    const double braked = full_nm[axle_of(i)] / (full_nm[0] + full_nm[1]);
    const double driven = axle_of(i) == 0 ? car.powertrain.front_share : 1.0 - car.powertrain.front_share;
    if (command_mps2 > 0.0)
      input.drive_torque_nm[i] = 0.5 * driven * torque_nm;
    else
      input.brake_torque_nm[i] = -0.5 * braked * torque_nm;
  }
  return input;
}

struct Error {
  const char* name;
  double most = 0.0;  ///< Of the difference over the reference's value.

  void add(double ours, double theirs) { most = std::max(most, std::abs(ours / theirs - 1.0)); }
};

/// Greatest errors from a tenth of a second of braking on, until `braked_s`.
std::vector<Error> greatest_errors(const VehicleParameters& car, const Curve& curve, double braked_s) {
  std::vector<Error> errors{{"speed"}, {"sideslip"}, {"yaw rate"}, {"lateral acceleration"}, {"roll"}, {"pitch"}};
  const auto& time = curve.at("t");
  VehicleState state = standstill(car, {}, curve.at("vx").front());
  const Ground ground = level_ground(0.0, car.tyre.reference_friction);
  double pitch_deg = 0.0, their_pitch_deg = 0.0;  // As the braking begins: the published body sinks a little in front.
  for (std::size_t row = 0; row + 1 < time.size() && time[row] < brake_s + braked_s + 1e-6; ++row) {
    const VehicleOutputs now = outputs(car, state);
    const auto theirs = [&](const char* name) { return curve.at(name)[row]; };
    if (std::abs(time[row] - brake_s) < 1e-6)
      pitch_deg = now.pitch_rad * degrees, their_pitch_deg = theirs("pitch_deg");
    if (time[row] > brake_s + 0.1 - 1e-6) {
      const double ours[] = {now.speed_mps,           -now.sideslip_rad * degrees,
                             -now.yaw_rate_radps,     -now.lateral_acceleration_mps2,
                             -now.roll_rad * degrees, now.pitch_rad * degrees - pitch_deg};
      const double published[] = {theirs("vx"), theirs("beta_deg"), theirs("yawrate"),
                                  theirs("ay"), theirs("roll_deg"), their_pitch_deg - theirs("pitch_deg")};
      for (std::size_t i = 0; i < errors.size(); ++i) errors[i].add(std::abs(ours[i]), std::abs(published[i]));
    }
    const ChassisInput input = torques(car, -theirs("delta"), theirs("command"));
    const auto steps = static_cast<int>((time[row + 1] - time[row]) / step_s + 0.5);
    for (int i = 0; i < steps; ++i) advance_chassis(car, input, ground, step_s, state);
  }
  return errors;
}

}  // namespace

TEST_CASE("braking in a bend turns the car as in the published model within ten percent for six tenths of a second") {
  struct Braking {
    const char* mps2;
    const char* curve;  ///< Its end.
    double until_s;
  };
  for (const Braking& braking : {Braking{"4", "_80", 0.6}, Braking{"6", "_80", 0.5}, Braking{"6", "_80_no_pull", 0.6}})
    for (const ReferenceCar& reference : reference_cars) {
      CAPTURE(std::string(reference.curve));
      CAPTURE(std::string(braking.mps2));
      // The 320i's wheels carry load throughout: its curve is the same with and without the road's pull.
      const bool pulled = std::string(reference.curve) != "BMW320i";
      const Curve curve = read_curve(std::string("brake") + braking.mps2 + "_" + reference.curve +
                                     (pulled ? braking.curve : "_80") + ".csv");
      for (const Error& error : greatest_errors(read_car(reference.vehicle), curve, braking.until_s)) {
        CAPTURE(std::string(error.name));
        CHECK(error.most < 0.1);
      }
    }
}
