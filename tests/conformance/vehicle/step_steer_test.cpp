// Step steer against the published multi-body model (vehicles/README.md).

#include "tests/conformance/vehicle/reference_curve.hpp"
#include "tests/relative.hpp"

using namespace septet::vehicle;
using septet::relative;

namespace {

/// Steady value (3 to 4 s) and time from half of the input to 90 % of it.
struct Response {
  double steady = 0.0, t90_s = 0.0;
};

Response respond(const std::vector<double>& time, const std::vector<double>& steer, const std::vector<double>& value) {
  Response response;
  double count = 0.0;
  for (std::size_t i = 0; i < time.size(); ++i)
    if (time[i] >= 3.0 && time[i] <= 4.0) {
      response.steady += value[i];
      count += 1.0;
    }
  response.steady /= count;
  response.t90_s = where(value, 0.9 * response.steady, time) - where(steer, 0.5 * steer.back(), time);
  return response;
}

std::vector<double> negated(std::vector<double> values) {
  for (double& value : values) value = -value;
  return values;
}

}  // namespace

TEST_CASE("a step of steer answers as fast and as strongly as in the published model") {
  for (const ReferenceCar& reference : reference_cars)
    for (const int speed_kmph : {80, 100}) {
      CAPTURE(std::string(reference.curve));
      CAPTURE(speed_kmph);
      const Curve curve =
          read_curve("step_" + std::string(reference.curve) + "_" + std::to_string(speed_kmph) + ".csv");
      const auto input = negated(curve.at("delta"));
      const Response yaw = respond(curve.at("t"), input, negated(curve.at("yawrate")));
      const Response lateral = respond(curve.at("t"), input, negated(curve.at("ay")));
      const VehicleParameters car = read_car(reference.vehicle);
      ManoeuvreOptions options;
      options.speed_mps = speed_kmph / 3.6;
      options.steer_rad = input.back();
      // The published tyre makes a car wobble in straight running (vehicles/README.md), by up to
      // 0.4 m/s². Ours starts at several phases of that wobble, so that the mean tells of the
      // response and not of the phase.
      double yaw_t90_s = 0.0, lateral_t90_s = 0.0;
      constexpr double phases_s[] = {3.0, 3.11, 3.22, 3.33};
      for (const double phase_s : phases_s) {
        options.settle_s = phase_s;
        const ManoeuvreReport report = step_steer(car, options);
        CHECK(report.figure("steady yaw rate") == relative(yaw.steady, 0.02));
        CHECK(report.figure("steady lateral acceleration") == relative(lateral.steady, 0.02));
        yaw_t90_s += report.figure("yaw rate t90") / std::size(phases_s);
        lateral_t90_s += report.figure("lateral acceleration t90") / std::size(phases_s);
      }
      CHECK(std::abs(yaw_t90_s - yaw.t90_s) < 0.015);
      CHECK(std::abs(lateral_t90_s - lateral.t90_s) < 0.015);
    }
}
