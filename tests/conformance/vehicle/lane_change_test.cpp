// Double lane change against the published multi-body model (vehicles/README.md).

#include <algorithm>

#include "tests/conformance/vehicle/reference_curve.hpp"
#include "tests/relative.hpp"

using namespace septet::vehicle;
using septet::relative;

namespace {
/// Largest magnitude on the course, which begins at X = 0.
double peak(const Curve& curve, const char* name) {
  double most = 0.0;
  for (std::size_t i = 0; i < curve.at("X").size(); ++i)
    if (curve.at("X")[i] > 0.0 && curve.at("X")[i] < 125.0) most = std::max(most, std::abs(curve.at(name)[i]));
  return most;
}
}  // namespace

TEST_CASE("the double lane change peaks where the published model peaks") {
  for (const ReferenceCar& reference : reference_cars) {
    CAPTURE(std::string(reference.curve));
    const Curve curve = read_curve("dlc_" + std::string(reference.curve) + "_80.csv");
    const ManoeuvreReport report = double_lane_change(read_car(reference.vehicle), {});
    CHECK(report.figure("peak lateral acceleration") == relative(peak(curve, "ay"), 0.05));
    CHECK(report.figure("peak yaw rate") == relative(peak(curve, "yawrate") * 57.29577951308232, 0.05));
    CHECK(report.figure("peak roll") == relative(peak(curve, "roll_deg"), 0.05));
    CHECK(report.figure("peak steer") == relative(peak(curve, "delta"), 0.05));
    CHECK(report.figure("peak sideslip") == relative(peak(curve, "beta_deg"), 0.05));
  }
}

TEST_CASE("stopping distances match those of the published tyre within two percent") {
  // Anchored distances for 100 km/h at longitudinal friction 1.0, 0.3 and 0.1, the same for all
  // three cars.
  struct Stop {
    double friction, distance_m;
  };
  for (const Stop& anchor : {Stop{1.0, 40.0}, Stop{0.3, 131.8}, Stop{0.1, 394.0}}) {
    CAPTURE(anchor.friction);
    ManoeuvreOptions options;
    options.friction = anchor.friction;
    const VehicleParameters car = read_car("commonroad-escort");
    CHECK(stop(car, options).figure("stopping distance") == relative(anchor.distance_m, 0.02));
  }
}
