// Impacts of the driver's car with other vehicles: what both are given, and what is told of them.

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "engine/physics/impact/restitution.hpp"
#include "engine/physics/vehicle/planar_body.hpp"
#include "tests/engine/simulation/crash_site.hpp"
#include "tests/relative.hpp"

using namespace septet;
using namespace septet::simulation;

namespace {

/// The driver's car along x and another vehicle that it has just run into; no wheel takes part.
struct Meeting : CrashSite {
  Meeting(double scenario_kg, double speed_mps, Participant other)
      : CrashSite(plane_model(1, scenario_kg), {}, speed_mps, {std::move(other)}) {}
  /// Ticks; returns the time until the last impulse.
  double run(double time_s) {
    double last_s = 0.0;
    for (double t_s = 0.0; t_s < time_s; t_s += tick_s) {
      const auto runs = [](const BodyContact& contact) { return !contact.engagement.pulses.empty(); };
      if (std::ranges::any_of(state.bodies.contacts, runs)) last_s = t_s;
      tick(false);
    }
    return last_s;
  }
  double yaw_radps() const { return (state.car.world_from_body.orientation * state.car.angular_velocity_radps).z; }
  double told(const std::string& key) const { return simulation::told(events.at(0), key); }
};

/// A vehicle whose rear the front of the Volvo at the origin has entered by `deep_m`.
Participant ahead(std::string_view model, double deep_m, double left_m, double speed_mps) {
  Participant other = placed_participant(first_scripted_participant + 1, model, 0.0, left_m, 0.0, speed_mps);
  const Participant car = placed_participant(1, "volvo-s80", 0.0, 0.0, 0.0, 0.0);
  other.world_from_vehicle.position_m.x =
      vehicle_models()[car.model].front_m() + vehicle_models()[other.model].rear_overhang_m - deep_m;
  return other;
}

}  // namespace

TEST_CASE(
    "who runs into another from behind loses what the two masses say, in the time of a crush, and by one mass each") {
  struct Row {
    const char* model;
    double scenario_kg, kg;
  };
  for (const Row& row : {Row{"saloon", 0.0, 1500.0}, Row{"saloon", 1450.0, 1450.0}, Row{"van", 3500.0, 3500.0},
                         Row{"lorry", 0.0, 16'000.0}}) {
    CAPTURE(std::string(row.model));
    Meeting meeting(row.scenario_kg, 22.0, ahead(row.model, 0.1, 0.0, 2.0));
    CHECK(mass_kg(meeting.model, meeting.participants[1]) == row.kg);
    meeting.find();
    REQUIRE(meeting.state.bodies.contacts.size() == 1);
    const double took_s = meeting.run(0.2), own_kg = meeting.model.car.body.mass_kg;
    const double expected_mps = (1.0 + impact::restitution(20.0)) * 20.0 * row.kg / (own_kg + row.kg);
    CHECK(22.0 - meeting.state.car.velocity_mps.x == relative(expected_mps, 1e-9));
    CHECK(meeting.told("delta_v_mps") == relative(expected_mps, 0.001));
    CHECK(meeting.told("closing_speed_mps") == relative(20.0, 1e-9));
    CHECK(took_s > 0.05);
    CHECK(took_s < 0.09);
    CHECK(std::abs(meeting.yaw_radps()) < 1e-9);
  }
}

TEST_CASE("who is run into from behind is pushed on") {
  Participant behind = placed_participant(first_scripted_participant + 1, "saloon", 0.0, 0.0, 0.0, 20.0);
  const VehicleModel& own = vehicle_models()[*find_vehicle_model("volvo-s80")];
  behind.world_from_vehicle.position_m.x = 0.1 - own.rear_overhang_m - vehicle_models()[behind.model].front_m();
  Meeting meeting(0.0, 8.0, behind);
  meeting.find();
  meeting.run(0.2);
  CHECK(meeting.state.car.velocity_mps.x > 8.0 + 6.0 * 1500.0 / meeting.model.car.body.mass_kg);
  CHECK(meeting.state.car.velocity_mps.x < 20.0);
}

TEST_CASE(
    "a car that runs into one that crosses is turned and dragged along, and its closing speed is that along the "
    "normal") {
  Participant crossing =
      placed_participant(first_scripted_participant + 1, "saloon", 0.0, 0.0, 1.5707963267948966, 12.0);
  const VehicleModel &own = vehicle_models()[*find_vehicle_model("volvo-s80")],
                     &other = vehicle_models()[crossing.model];
  crossing.world_from_vehicle.position_m = {own.front_m() + 0.5 * other.width_m - 0.05, -other.centre_x_m(), 0.0};
  Meeting meeting(0.0, 13.5, crossing);
  meeting.find();
  REQUIRE(meeting.events.size() == 1);
  CHECK(meeting.told("closing_speed_mps") == relative(13.5, 1e-3));
  meeting.run(0.2);
  CHECK(meeting.state.car.velocity_mps.x < 9.0);
  CHECK(meeting.state.car.velocity_mps.y > 0.5);
  CHECK(meeting.yaw_radps() > 0.5);
}

TEST_CASE("a scrape of seven centimetres is felt and told") {
  const double width_m = 0.5 * (vehicle_models()[*find_vehicle_model("volvo-s80")].width_m +
                                vehicle_models()[*find_vehicle_model("saloon")].width_m);
  Meeting meeting(0.0, 20.0, ahead("saloon", 0.4, width_m - 0.07, 0.0));
  meeting.find();
  REQUIRE(meeting.events.size() == 1);
  meeting.run(0.2);
  const Vec2 delta_v = Vec2(meeting.state.car.velocity_mps) - Vec2(20.0, 0.0);
  CHECK(meeting.told("delta_v_mps") == doctest::Approx(glm::length(delta_v)).epsilon(0.01).scale(1.0));
  CHECK(delta_v.x < -0.1);
  CHECK(delta_v.y < -0.1);
  CHECK(glm::length(delta_v) < 3.0);
}

TEST_CASE("the acceleration of an impact is in the car's own, and the momentum given is the momentum taken") {
  Meeting meeting(0.0, 15.0, ahead("saloon", 0.05, 0.4, 0.0));
  double integral_mps = 0.0;
  const Vec2 before = meeting.momentum();
  meeting.find();
  integral_mps += tick_s * meeting.state.car.acceleration_mps2.x;
  for (int i = 0; i < 20; ++i) {
    meeting.state.car.acceleration_mps2 = Vec3(0.0);
    meeting.tick(false);
    integral_mps += tick_s * meeting.state.car.acceleration_mps2.x;
    CHECK(glm::distance(meeting.momentum(), before) < 1e-9 * glm::length(before));
  }
  CHECK(integral_mps == relative(meeting.state.car.velocity_mps.x - 15.0, 1e-9));
  CHECK(glm::length(meeting.participants[1].velocity_mps) > 5.0);
}

TEST_CASE("those that touch and do not approach are told once, and nothing begins") {
  Meeting meeting(0.0, 10.0, ahead("saloon", 0.1, 0.0, 12.0));
  for (int i = 0; i < 3; ++i) meeting.find();
  CHECK(meeting.events.size() == 1);
  CHECK(meeting.told("closing_speed_mps") == 0.0);
  CHECK(meeting.state.bodies.empty());
  CHECK(meeting.state.effects.crashes.struck_vehicles.empty());
}
