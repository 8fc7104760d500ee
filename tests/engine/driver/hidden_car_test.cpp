#include <algorithm>
#include <optional>
#include <string>

#include <doctest/doctest.h>

#include "tests/engine/driver/closed_loop.hpp"

namespace septet::driver {
namespace {

constexpr ParticipantId leads = 1001, stands = 1002;
constexpr double speed_mps = 20.0, stands_at_m = 420.0, leaves_before_m = 70.0, leaves_in_s = 2.0;

/// On the third lane of the motorway, towards increasing s, so far to its left.
Participant on_lane(ParticipantId id, const char* model, double s_m, double left_m, double mps) {
  Participant vehicle = vehicle_on_motorway(id, model, -3, s_m, mps);
  vehicle.world_from_vehicle = road::world_from_lane(road::evaluate_lane(motorway(), {0, -3, s_m, left_m}));
  return vehicle;
}

struct Meeting {
  double brakes_at_m =
      0.0;  ///< Distance from the driver's front to the standing car's rear as the brake is first pressed.
  bool collided = false;
  double ends_mps = 0.0;
};

/// The driver follows a vehicle that changes over shortly before a car that stands in the lane.
Meeting behind(const char* leader, const char* temperament) {
  DriverParameters driver = *find_driver(temperament);
  driver.lanes.threshold_mps2 = 1e3;  // Keeps the lane.
  driver.speed.limit_factor = speed_mps / (120.0 / 3.6);
  ClosedLoop loop(driver, 1, -3, 100.0, speed_mps);
  const double ahead_m = 100.0 + 35.0;
  loop.others = [&](double time_s, std::vector<Participant>& vehicles) {
    const double s_m = ahead_m + speed_mps * time_s;
    const double gone = std::clamp((s_m - (stands_at_m - leaves_before_m)) / (leaves_in_s * speed_mps), 0.0, 1.0);
    vehicles.push_back(on_lane(leads, leader, s_m, 3.75 * gone, speed_mps));
    vehicles.push_back(on_lane(stands, "saloon", stands_at_m, 0.0, 0.0));
  };
  Meeting meeting;
  const VehicleModel &car = vehicle_models()[*find_vehicle_model("volvo-s80")],
                     &saloon = vehicle_models()[*find_vehicle_model("saloon")];
  for (int tick = 0; tick < 25 * 120; ++tick) {
    loop.tick();
    if (meeting.brakes_at_m == 0.0 && loop.input.brake > 0.0 && loop.snapshot.simulated_time_s > 3.0)
      meeting.brakes_at_m = stands_at_m - saloon.rear_overhang_m - loop.snapshot.driver_car.road_s_m - car.front_m();
  }
  meeting.collided = loop.snapshot.diagnostics.collisions > 0;
  meeting.ends_mps = loop.snapshot.driver_car.speed_mps;
  return meeting;
}

}  // namespace

TEST_CASE(
    "a driver brakes later for a car that a lorry hides than behind a saloon through which he sees it, and for neither "
    "too late") {
  for (const char* temperament : {"experienced", "plain", "novice", "tired"}) {
    CAPTURE(std::string(temperament));
    const Meeting hidden = behind("lorry", temperament), open = behind("saloon", temperament);
    CAPTURE(hidden.brakes_at_m);
    CAPTURE(open.brakes_at_m);
    CHECK(hidden.brakes_at_m < open.brakes_at_m - 10.0);
    CHECK_FALSE(hidden.collided);
    CHECK_FALSE(open.collided);
    CHECK(hidden.ends_mps < 0.5);
    CHECK(open.ends_mps < 0.5);
  }
}

}  // namespace septet::driver
