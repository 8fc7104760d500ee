// Steps in a road under the driver's car: the ground gives it no energy, and a step higher than a wheel climbs stops
// it.
#include "engine/simulation/ground_faces.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "engine/simulation/driver_car.hpp"
#include "tests/engine/physics/vehicle/car.hpp"
#include "tests/engine/physics/vehicle/mechanical_energy.hpp"
#include "tests/engine/road/road_files.hpp"

using namespace septet;
using namespace septet::simulation;

namespace {

Model model_on(const std::string& xml) {
  Model model;
  model.roads = road::read_or_fail(xml);
  model.scenario.entities.resize(1);
  model.scenario.entities[0].model = *find_vehicle_model("volvo-s80");
  model.driver_entity = 0;
  model.car = vehicle::read_car("volvo-s80");
  return model;
}

/// 200 m along x, 200 m wide, whose elevation rises by `step_m` at s = 40.
std::string stepped(double step_m) {
  road::SmallRoad road{.length_m = 200.0};
  road.profiles = "<elevationProfile>" + road::elevation(0.0) + road::elevation(step_m, 40.0) + "</elevationProfile>";
  road.sections = road::lane_section(road::lane(1, 100.0), road::lane(-1, 100.0));
  return road.xml();
}

/// Result of a drive over a step, coasting in neutral.
struct Drive {
  double most_over_start_j = -1e30,
         most_gain_j = 0.0;    ///< Of energy: over that of the beginning, and over the least so far.
  double most_rise_m = -1e30;  ///< Of the centre of mass.
  double farthest_x_m = 0.0, end_speed_mps = 0.0, start_j = 0.0;
  bool struck = false;
  std::uint32_t bad_numbers = 0;
};

Drive drive_over(const Model& model, double speed_mps, double heading_rad, double seconds = 4.0, double before_m = 6.0,
                 double steering_wheel_rad = 0.0) {
  State state;
  const RigidTransform start{Vec3(40.0 - before_m * std::cos(heading_rad), -before_m * std::sin(heading_rad), 0.0),
                             glm::angleAxis(heading_rad, Vec3(0.0, 0.0, 1.0))};
  state.car = vehicle::standstill(model.car, start, speed_mps);
  state.input.selector = GearSelector::neutral;
  state.input.steering_wheel_rad = steering_wheel_rad;
  Drive drive;
  drive.start_j = vehicle::mechanical_energy_j(model.car, state.car);
  const double start_z_m = state.car.world_from_body.position_m.z;
  double least_j = drive.start_j;
  std::vector<Event> events;
  for (int tick = 0; tick < seconds * tick_rate_hz; ++tick) {
    advance_car(model, state, events);
    const Vec3& at = state.car.world_from_body.position_m;
    const double energy_j = vehicle::mechanical_energy_j(model.car, state.car);
    least_j = std::min(least_j, energy_j);
    drive.most_over_start_j = std::max(drive.most_over_start_j, energy_j - drive.start_j);
    drive.most_gain_j = std::max(drive.most_gain_j, energy_j - least_j);
    drive.most_rise_m = std::max(drive.most_rise_m, at.z - start_z_m);
    drive.farthest_x_m = std::max(drive.farthest_x_m, at.x);
  }
  drive.end_speed_mps = glm::length(state.car.velocity_mps);
  drive.struck = std::ranges::any_of(events, [](const Event& event) { return event.kind == "collision"; });
  drive.bad_numbers = state.car.bad_numbers;
  return drive;
}

}  // namespace

TEST_CASE("over no step of a road does the ground give the car energy") {
  // An impact returns stored energy only: a crushed front and a suspension return less than a quarter.
  for (const double step_m :
       {0.02, 0.05, 0.1, 0.2, 0.24, 0.3, 0.5, 1.0, 3.0, 30.0, -0.05, -0.2, -0.5, -1.0, -3.0, -30.0}) {
    const Model model = model_on(stepped(step_m));
    for (const double speed_mps : {3.0, 10.0, 20.0, 45.0})
      for (const double heading_rad : {0.0, 0.4, 1.0}) {
        CAPTURE(step_m);
        CAPTURE(speed_mps);
        CAPTURE(heading_rad);
        const Drive drive = drive_over(model, speed_mps, heading_rad);
        const double fallen_j = std::max(0.0, -step_m) * model.car.body.mass_kg * 9.81;
        CHECK(drive.bad_numbers == 0);
        CHECK(drive.most_over_start_j < 1.0);
        CHECK(drive.most_gain_j < 1500.0 + 0.25 * (drive.start_j + fallen_j));
        CHECK(drive.most_rise_m < 1.6);  // 0.24 m at 45 m/s lifts one side, 1.5 m.
      }
  }
}

TEST_CASE("over no ridge or trench however narrow and oblique does the ground give the car energy") {
  struct Comb {
    double step_m, tooth_m;
    int teeth;
  };
  for (const Comb& comb : {Comb{0.2, 0.15, 1},
                           {0.1, 0.15, 20},
                           {0.2, 0.3, 20},
                           {-0.1, 0.3, 1},
                           {-0.3, 0.6, 1},
                           {-0.3, 0.3, 20},
                           {-1.0, 0.3, 1},
                           {-1.0, 0.6, 20}}) {
    CAPTURE(comb.step_m);
    CAPTURE(comb.tooth_m);
    std::string records = road::elevation(0.0);
    for (int i = 0; i < 2 * comb.teeth; ++i)
      records += road::elevation(i % 2 == 0 ? comb.step_m : 0.0, 40.0 + comb.tooth_m * i);
    road::SmallRoad road{.length_m = 200.0};
    road.profiles = "<elevationProfile>" + records + "</elevationProfile>";
    road.sections = road::lane_section(road::lane(1, 100.0), road::lane(-1, 100.0));
    const Model model = model_on(road.xml());
    for (const double speed_mps : {3.0, 10.0, 45.0})
      for (const double heading_rad : {0.0, 0.4, 1.0, 1.2})
        for (const double steering_wheel_rad : {0.0, 2.0}) {
          CAPTURE(speed_mps);
          CAPTURE(heading_rad);
          CAPTURE(steering_wheel_rad);
          const Drive drive = drive_over(model, speed_mps, heading_rad, 4.0, 9.0, steering_wheel_rad);
          CHECK(drive.bad_numbers == 0);
          CHECK(drive.most_over_start_j < 1.0);
        }
  }
}

TEST_CASE("over no twist, lane height, shape or row of steps of a road does the ground give the car energy") {
  const auto cubic = [](const char* name, double s_m, double a, const char* more = "") {
    return fmt::format("<{} s=\"{}\" {} a=\"{}\" b=\"0\" c=\"0\" d=\"0\"/>", name, s_m, more, a);
  };
  const auto wide = [](const std::string& profiles, const std::string& in_lane = "") {
    road::SmallRoad road{.length_m = 200.0};
    road.profiles = profiles;
    road.sections = "<laneSection s=\"0\"><left>" + road::lane(1, 20.0, in_lane) + "</left><center>" +
                    road::lane(0, 0) + "</center><right>" + road::lane(-1, 20.0, in_lane) + "</right></laneSection>";
    return road.xml();
  };
  std::vector<std::pair<std::string, std::string>> roads;
  for (const double roll_rad : {0.02, 0.1, 0.3, -0.3}) {
    roads.emplace_back(fmt::format("superelevation {}", roll_rad),
                       wide("<lateralProfile>" + cubic("superelevation", 0, 0.0) +
                            cubic("superelevation", 40, roll_rad) + "</lateralProfile>"));
    roads.emplace_back(
        fmt::format("superelevation for a metre {}", roll_rad),
        wide("<lateralProfile>" + cubic("superelevation", 0, 0.0) + cubic("superelevation", 40, roll_rad) +
             cubic("superelevation", 41, 0.0) + "</lateralProfile>"));
    roads.emplace_back(fmt::format("crossfall {}", roll_rad),
                       wide("<lateralProfile>" + cubic("crossfall", 0, 0.0, "side=\"both\"") +
                            cubic("crossfall", 40, roll_rad, "side=\"both\"") + "</lateralProfile>"));
  }
  for (const double step_m : {0.1, 0.3, 2.0, -0.1, -2.0}) {
    roads.emplace_back(fmt::format("lane height {}", step_m),
                       wide("", fmt::format("<height sOffset=\"0\" inner=\"0\" outer=\"0\"/><height sOffset=\"40\" "
                                            "inner=\"{0}\" outer=\"{0}\"/>",
                                            step_m)));
    roads.emplace_back(fmt::format("shape {}", step_m),
                       wide(fmt::format("<lateralProfile>{}{}</lateralProfile>", cubic("shape", 0, 0.0, "t=\"-25\""),
                                        cubic("shape", 0, step_m, "t=\"1\""))));
    if (step_m < -1.0) continue;  // Trenches narrower than a wheel, as deep as a man.
    roads.emplace_back(fmt::format("comb {}", step_m), [&] {
      std::string records;
      for (int i = 0; i < 40; ++i) records += cubic("elevation", 40.0 + 0.3 * i, i % 2 == 1 ? step_m : 0.0);
      return wide("<elevationProfile>" + cubic("elevation", 0, 0.0) + records + "</elevationProfile>");
    }());
  }
  for (const auto& named : roads) {
    const Model model = model_on(named.second);
    for (const double speed_mps : {3.0, 15.0, 45.0})
      for (const double heading_rad : {0.0, 0.5, 1.2}) {
        CAPTURE(named.first);
        CAPTURE(speed_mps);
        CAPTURE(heading_rad);
        const Drive drive = drive_over(model, speed_mps, heading_rad, 5.0, 9.0);
        CHECK(drive.bad_numbers == 0);
        CHECK(drive.most_over_start_j < 1.0);
        CHECK(drive.most_rise_m < 0.5 * speed_mps * speed_mps / 9.81 + 0.5);
      }
  }
}

TEST_CASE("a face higher than a wheel's radius stops the car as a wall does and a low one is driven over") {
  for (const double step_m : {0.35, 1.0, 3.0, 30.0}) {
    const Model model = model_on(stepped(step_m));
    for (const double speed_mps : {3.0, 10.0, 20.0, 45.0})
      for (const double heading_rad : {0.0, 0.4, -0.4, 1.0, -1.0}) {
        CAPTURE(step_m);
        CAPTURE(speed_mps);
        CAPTURE(heading_rad);
        const Drive drive = drive_over(model, speed_mps, heading_rad);
        CHECK(drive.struck);
        CHECK(drive.farthest_x_m < 40.0);  // Its centre of mass.
        CHECK(drive.most_rise_m < 0.1);
      }
  }
  for (const double step_m : {0.05, 0.1, -0.1, -0.5}) {
    CAPTURE(step_m);
    const Drive drive = drive_over(model_on(stepped(step_m)), 15.0, 0.0);
    CHECK_FALSE(drive.struck);
    CHECK(drive.farthest_x_m > 60.0);
  }
}

TEST_CASE("a car that pushes against a face with all its power stays before it") {
  const Model model = model_on(stepped(1.0));
  State state;
  state.car = vehicle::standstill(model.car, {Vec3(30.0, 0.0, 0.0), Quat(1.0, 0.0, 0.0, 0.0)}, 5.0);
  state.input.accelerator = 1.0;
  std::vector<Event> events;
  for (int tick = 0; tick < 10 * 120; ++tick) advance_car(model, state, events);
  CHECK(state.car.world_from_body.position_m.x < 40.0);
  CHECK(std::abs(state.car.world_from_body.position_m.z - model.car.body.mass_centre_z_m) < 0.3);
}

TEST_CASE("a bridge over the road is no face and a road that lies higher beside it stops nobody who stays on his") {
  // Road b crosses 6 m above road a at x = 50.
  const auto one = [](const char* id, double x_m, double y_m, double heading_rad, double z_m) {
    return road::SmallRoad{.profiles = "<elevationProfile>" + road::elevation(z_m) + "</elevationProfile>",
                           .sections = road::lane_section(road::left_lanes(1), road::right_lanes(1)),
                           .id = id,
                           .x_m = x_m,
                           .y_m = y_m,
                           .heading_rad = heading_rad}
        .text();
  };
  const Model model = model_on(road::roads_text(one("a", 0, 0, 0, 0) + one("b", 50, -50, 1.5707963267948966, 6.0)));
  for (const double y_m : {-1.75, -3.2, 0.0}) {  // One with a corner beside its own lanes.
    CAPTURE(y_m);
    State state;
    state.car = vehicle::standstill(model.car, {Vec3(20.0, y_m, 0.0), Quat(1.0, 0.0, 0.0, 0.0)}, 15.0);
    std::vector<Event> events;
    advance_car(model, state, events);
    for (int tick = 0; tick < 4 * 120; ++tick) advance_car(model, state, events);
    CHECK(std::ranges::none_of(events, [](const Event& event) { return event.kind == "collision"; }));
    CHECK(state.car.world_from_body.position_m.x > 65.0);
    CHECK(std::abs(state.car.world_from_body.position_m.z - model.car.body.mass_centre_z_m) < 0.3);
  }
}
