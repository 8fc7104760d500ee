#include <algorithm>
#include <cmath>

#include <fmt/core.h>

#include "engine/core/check.hpp"
#include "engine/math/angle_units.hpp"
#include "engine/physics/vehicle/manoeuvre_car.hpp"
#include "engine/physics/vehicle/suspension.hpp"
#include "engine/physics/vehicle/tyre.hpp"

// Stop (ISO 21994), coast-down, acceleration; and the list of all manoeuvres.

namespace septet::vehicle {
namespace {

/// Slip at which the tyre brakes hardest under this load on this surface.
double best_braking_slip(const TyreParameters& tyre, double load_n, double friction) {
  double best_slip = 0.0, best_n = 0.0;
  for (double slip = 0.002; slip < 0.4; slip += 0.002) {
    TyreContact contact;
    contact.load_n = load_n;
    contact.friction = friction;
    contact.forward_mps = 20.0;
    contact.rolling_mps = 20.0 * (1.0 - slip);
    contact.sliding_mps = {20.0 * slip, 0.0};
    const double force_n = -steady_force(tyre, contact).force_n.x;
    if (force_n > best_n) {
      best_n = force_n;
      best_slip = slip;
    }
  }
  return best_slip;
}

/// Brake torques that hold every wheel at a slip, which builds up to the best one over 0.15 s.
ChassisInput ideal_braking(const ManoeuvreCar& car, double best_slip, double speed_mps) {
  constexpr double build_up_s = 0.15, rate_per_s = 200.0;
  const VehicleParameters& parameters = car.parameters();
  const double slip = best_slip * std::min(1.0, car.time_s() / build_up_s);
  ChassisInput chassis;
  for (int i = 0; i < wheel_count; ++i) {
    const WheelState& wheel = car.state().wheels[i];
    const double radius_m = parameters.tyre.radius_m;
    const double wanted_radps = (1.0 - slip) * speed_mps / radius_m;
    chassis.brake_torque_nm[i] =
        std::max(0.0, -wheel.force_n.x * radius_m + parameters.suspension[axle_of(i)].wheel_inertia_kgm2 * rate_per_s *
                                                        (wheel.spin_radps - wanted_radps));
  }
  return chassis;
}

/// Adds a fault where a manoeuvre with the wheel held straight ends beside its lane.
void require_straight(ManoeuvreReport& report) {
  constexpr double half_lane_m = 1.75, most_turn_rad = 0.2;
  double aside_m = 0.0, turn_rad = 0.0;
  for (const ManoeuvreSample& sample : report.series) {
    aside_m = std::max(aside_m, std::abs(sample.y_m));
    turn_rad = std::max(turn_rad, std::abs(sample.heading_rad));
  }
  if (turn_rad > most_turn_rad || aside_m > half_lane_m)
    report.faults.push_back(fmt::format("the car did not go straight: it turned by {:.0f} deg and went {:.1f} m aside",
                                        turn_rad * degrees_per_radian, aside_m));
}

}  // namespace

ManoeuvreReport stop(const VehicleParameters& parameters, const ManoeuvreOptions& options) {
  const double speed_mps = options.speed_mps > 0.0 ? options.speed_mps : 100.0 / 3.6;
  ManoeuvreCar car(parameters, options, speed_mps);
  const double load_n = 0.25 * parameters.body.mass_kg * gravity_mps2;
  const double slip = best_braking_slip(parameters.tyre, load_n, car.friction());
  const double entry_mps = car.sample().speed_mps;
  car.begin();
  car.input().accelerator = 0.0;
  car.input().brake = 1.0;
  double distance_from_80_m = 0.0, distance_from_10_m = 0.0;
  while (car.time_s() < 120.0) {
    car.record();
    const ManoeuvreSample now = car.sample();
    if (now.speed_mps > 0.8 * entry_mps) distance_from_80_m = now.x_m;
    if (now.speed_mps > 0.1 * entry_mps) distance_from_10_m = now.x_m;
    if (now.speed_mps < 0.02) break;
    if (parameters.brakes.anti_lock)
      car.advance(0.0);
    else
      car.advance_with_torques(ideal_braking(car, slip, now.speed_mps));
  }
  const ManoeuvreSample last = car.sample();
  // Mean fully developed deceleration, from 80 to 10 % of the speed (UNECE R13-H).
  const double developed_mps2 =
      (0.64 - 0.01) * entry_mps * entry_mps / (2.0 * std::max(distance_from_10_m - distance_from_80_m, 1e-9));
  ManoeuvreReport report{
      "stop", "ISO 21994", {{"speed", entry_mps * 3.6, "km/h"}, {"friction", car.friction(), ""}}, car.series()};
  if (last.speed_mps < 0.02) {
    report.figures.push_back({"stopping distance", last.x_m, "m"});
    report.figures.push_back({"stopping time", car.time_s(), "s"});
    report.figures.push_back({"mean fully developed deceleration", developed_mps2, "m/s2"});
  } else {
    report.faults.push_back(fmt::format("the car did not stop within {:.0f} s: it still goes at {:.1f} km/h",
                                        car.time_s(), last.speed_mps * 3.6));
  }
  report.figures.push_back({"lateral deviation", last.y_m, "m"});
  require_straight(report);
  return report;
}

ManoeuvreReport coast_down(const VehicleParameters& parameters, const ManoeuvreOptions& options) {
  const double speed_mps = options.speed_mps > 0.0 ? options.speed_mps : 120.0 / 3.6;
  ManoeuvreCar car(parameters, options, speed_mps);
  car.begin();
  car.input().accelerator = 0.0;
  car.input().selector = GearSelector::neutral;
  double at_100_mps2 = 0.0, at_50_mps2 = 0.0;
  while (car.time_s() < 300.0) {
    car.record();
    const ManoeuvreSample now = car.sample();
    if (now.speed_mps > 100.0 / 3.6) at_100_mps2 = now.longitudinal_acceleration_mps2;
    if (now.speed_mps > 50.0 / 3.6) at_50_mps2 = now.longitudinal_acceleration_mps2;
    if (now.speed_mps < 20.0 / 3.6) break;
    car.advance(0.0);
  }
  ManoeuvreReport report{"coast-down", "ISO 10521-1, in neutral", {{"speed", speed_mps * 3.6, "km/h"}}, car.series()};
  if (speed_mps > 100.0 / 3.6) report.figures.push_back({"deceleration at 100 km/h", -at_100_mps2, "m/s2"});
  if (speed_mps > 50.0 / 3.6) report.figures.push_back({"deceleration at 50 km/h", -at_50_mps2, "m/s2"});
  if (car.sample().speed_mps < 20.0 / 3.6) {
    report.figures.push_back({"time", car.time_s(), "s"});
    report.figures.push_back({"distance", car.sample().x_m, "m"});
  } else {
    report.faults.push_back(
        fmt::format("20 km/h was not reached in {:.0f} s: the car still goes at {:.1f} km/h, as one without drag does",
                    car.time_s(), car.sample().speed_mps * 3.6));
  }
  require_straight(report);
  return report;
}

ManoeuvreReport acceleration(const VehicleParameters& parameters, const ManoeuvreOptions& options) {
  constexpr double sixty_mph_mps = 26.8224;
  ManoeuvreCar car(parameters, options, 0.0);
  car.input().brake = 1.0;
  for (int i = 0; i < 1500; ++i) car.advance(0.0);  // In gear, on the brake.
  car.begin();
  car.input().brake = 0.0;
  car.input().accelerator = 1.0;
  while (car.time_s() < 100.0) {
    car.record();
    car.advance(0.0);
  }
  ManoeuvreReport report{"acceleration", "full throttle from rest", {}, car.series()};
  const auto speed = [](const ManoeuvreSample& s) { return s.speed_mps; };
  const auto time = [](const ManoeuvreSample& s) { return s.time_s; };
  const double fastest_mps = std::ranges::max(car.series(), {}, speed).speed_mps,
               last_mps = car.series().back().speed_mps;
  const auto reach = [&](const char* figure, const char* name, double speed_mps) {
    if (fastest_mps >= speed_mps)
      report.figures.push_back({figure, first_crossing(car.series(), speed, speed_mps, time), "s"});
    else
      report.faults.push_back(fmt::format("{} was not reached in {:.0f} s: the fastest was {:.1f} km/h", name,
                                          car.time_s(), fastest_mps * 3.6));
  };
  reach("0-60 mph", "60 mph", sixty_mph_mps);
  reach("0-100 km/h", "100 km/h", 100.0 / 3.6);
  const double gained_mps2 = (last_mps - car.series()[car.series().size() - 501].speed_mps) / 5.0;
  if (std::abs(gained_mps2) < 0.1) {
    report.figures.push_back({"top speed", last_mps * 3.6, "km/h"});
    report.figures.push_back({"top speed in mph", last_mps * 2.2369362920544, "mph"});
  } else {
    report.faults.push_back(
        fmt::format("there is no top speed: after {:.0f} s at {:.1f} km/h the speed still changes by {:.2f} m/s2",
                    car.time_s(), last_mps * 3.6, gained_mps2));
  }
  require_straight(report);
  return report;
}

double ManoeuvreReport::figure(std::string_view name) const {
  for (const Figure& figure : figures)
    if (figure.name == name) return figure.value;
  SEPTET_CHECK(false, "no figure \"{}\" in {}", name, manoeuvre);
}

namespace {
struct Entry {
  std::string_view name;
  ManoeuvreReport (*run)(const VehicleParameters&, const ManoeuvreOptions&);
};
constexpr Entry entries[] = {
    {"steady-circle", steady_circle},
    {"step-steer", step_steer},
    {"double-lane-change", double_lane_change},
    {"sine-with-dwell", sine_with_dwell},
    {"stop", stop},
    {"coast-down", coast_down},
    {"acceleration", acceleration},
};
}  // namespace

std::vector<std::string_view> manoeuvre_names() {
  std::vector<std::string_view> names;
  for (const Entry& entry : entries) names.push_back(entry.name);
  return names;
}

Expected<ManoeuvreReport> run_manoeuvre(std::string_view name, const VehicleParameters& parameters,
                                        const ManoeuvreOptions& options) {
  std::string known;
  for (const Entry& entry : entries) {
    if (entry.name == name) {
      ManoeuvreReport report = entry.run(parameters, options);
      find_faults(report);
      return report;
    }
    known += (known.empty() ? "" : ", ") + std::string(entry.name);
  }
  return failure("is not a manoeuvre", std::string(name), "use one of " + known);
}

}  // namespace septet::vehicle
