// Impacts of the driver's car with other vehicles: what they are given, and what is told of them.

#include "engine/simulation/car_impacts.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "engine/physics/impact/restitution.hpp"
#include "engine/simulation/collisions.hpp"
#include "engine/simulation/driver_car.hpp"
#include "tests/engine/physics/vehicle/car.hpp"
#include "tests/engine/simulation/placed_participant.hpp"
#include "tests/relative.hpp"

using namespace septet;
using namespace septet::simulation;

namespace {

Model volvo(double scenario_mass_kg = 0.0) {
  Model model;
  model.scenario.entities.resize(2);
  model.scenario.entities[0].model = *find_vehicle_model("volvo-s80");
  model.scenario.entities[1].mass_kg = scenario_mass_kg;
  model.driver_entity = 0;
  model.car = vehicle::read_car("volvo-s80");
  return model;
}

/// The driver's car along x and another vehicle that it has just run into; no ground, so that no tyre takes part.
struct Meeting {
  Model model;
  State state;
  std::vector<Participant> participants;
  std::vector<Event> events;

  Meeting(Model with, double speed_mps, Participant other) : model(std::move(with)) {
    state.car = vehicle::standstill(model.car, {}, speed_mps);
    participants = {driven_car(model, state).participant, std::move(other)};
  }
  void find() { find_collisions(model, participants[0], participants, state, events); }
  /// Seconds of steps as the car makes them; returns the time until the last impulse.
  double run(double time_s) {
    double last_s = 0.0;
    for (double t_s = 0.0; t_s < time_s; t_s += tick_s / 8.0) {
      state.car.world_from_body.position_m += tick_s / 8.0 * state.car.velocity_mps;
      if (!state.impacts.empty()) last_s = t_s;
      advance_impacts(model, tick_s / 8.0, state);
    }
    return last_s;
  }
  double yaw_radps() const { return (state.car.world_from_body.orientation * state.car.angular_velocity_radps).z; }
  double told(const std::string& key) const {
    const std::string& detail = events.at(0).detail;
    return std::stod(detail.substr(detail.find(key + "=") + key.size() + 1));
  }
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
    Meeting meeting(volvo(row.scenario_kg), 22.0, ahead(row.model, 0.1, 0.0, 2.0));
    CHECK(mass_kg(meeting.model, meeting.participants[1]) == row.kg);
    meeting.find();
    REQUIRE(meeting.state.impacts.size() == 1);
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
  Meeting meeting(volvo(), 8.0, behind);
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
  Meeting meeting(volvo(), 13.5, crossing);
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
  Meeting meeting(volvo(), 20.0, ahead("saloon", 0.4, width_m - 0.07, 0.0));
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
  Meeting meeting(volvo(), 15.0, ahead("saloon", 0.05, 0.4, 0.0));
  meeting.find();
  double integral_mps = 0.0;
  const Vec2 before_ns = meeting.model.car.body.mass_kg * Vec2(meeting.state.car.velocity_mps) +
                         1500.0 * meeting.state.impacts.at(0).struck.velocity_mps;
  Vec2 struck_mps(0.0);
  for (int i = 0; i < 200 && !meeting.state.impacts.empty(); ++i) {
    const double due_s = meeting.state.impacts[0].due_s;
    meeting.state.car.acceleration_mps2 = Vec3(0.0);
    struck_mps = meeting.state.impacts[0].struck.velocity_mps;
    const Vec2 now_ns = meeting.model.car.body.mass_kg * Vec2(meeting.state.car.velocity_mps) + 1500.0 * struck_mps;
    CHECK(glm::distance(now_ns, before_ns) < 1e-9 * glm::length(before_ns));
    advance_impacts(meeting.model, 0.001, meeting.state);
    integral_mps += (0.001 + due_s) * meeting.state.car.acceleration_mps2.x;
  }
  CHECK(integral_mps == relative(meeting.state.car.velocity_mps.x - 15.0, 1e-9));
}

TEST_CASE("those that touch and do not approach are told once, and nothing begins") {
  Meeting meeting(volvo(), 10.0, ahead("saloon", 0.1, 0.0, 12.0));
  for (int i = 0; i < 3; ++i) meeting.find();
  CHECK(meeting.events.size() == 1);
  CHECK(meeting.told("closing_speed_mps") == 0.0);
  CHECK(meeting.state.impacts.empty());
  CHECK(meeting.state.effects.crashes.struck_by_driver.empty());
}
