// Steady cornering against the published multi-body model (vehicles/README.md).

#include "tests/conformance/vehicle/reference_curve.hpp"
#include "tests/relative.hpp"

using namespace septet::vehicle;
using septet::relative;

TEST_CASE("steer and yaw rate in steady cornering match the published model within two percent") {
  for (const ReferenceCar& reference : reference_cars)
    for (const int speed_kmph : {80, 100, 120}) {
      CAPTURE(std::string(reference.curve));
      CAPTURE(speed_kmph);
      const Curve curve = read_curve("ss_" + std::string(reference.curve) + "_" + std::to_string(speed_kmph) + ".csv");
      ManoeuvreOptions options;
      options.speed_mps = speed_kmph / 3.6;
      const ManoeuvreReport report = steady_circle(read_car(reference.vehicle), options);
      const auto ours = column(report, [](auto& s) { return s.lateral_acceleration_mps2; });
      const auto steer = column(report, [](auto& s) { return s.steer_rad; });
      const auto yaw = column(report, [](auto& s) { return s.yaw_rate_radps; });
      const auto roll = column(report, [](auto& s) { return s.roll_rad; });
      const auto& theirs = curve.at("ay");
      for (const double acceleration : {2.0, 3.0, 4.0, 5.0, 6.0}) {
        CAPTURE(acceleration);
        CHECK(where(ours, acceleration, steer) == relative(where(theirs, acceleration, curve.at("delta_rad")), 0.02));
        CHECK(where(ours, acceleration, yaw) == relative(where(theirs, acceleration, curve.at("yawrate")), 0.02));
        if (acceleration < 3.0) continue;  // Below, the published tyre's wobble shows in the roll.
        const double roll_deg = where(ours, acceleration, roll) * 57.29577951308232;
        CHECK(roll_deg == relative(-where(theirs, acceleration, curve.at("roll_deg")), 0.02));
      }
    }
}
