/// Crashes that were staged and published, beside what the law says of them.
///
/// Two-car crashes: NHTSA tests 4363, 4364, 4438 and 4474, as Rose et al. analysed them (Restitution Modeling for Crush
/// Analysis: Theory and Validation, SAE 2006-01-0908); their figures as joe-cormier/pycrash quotes them
/// (projects/validation impact momentum/src/test_inputs_rose.py, vehicle_data_collection.py). The place and the normal
/// of the contact are that paper's; restitution and friction are ours, neither is fitted. The paper's changes of speed
/// come from planar impact mechanics fitted to the tests, not straight from an accelerometer.
///
/// A wall: NHTSA test 10146 (New Car Assessment Program, Toyota Camry 2018, full width): mass and speed from its EV5
/// file, the rest integrated from its four accelerometers at the rear seat's crossmember (channels 93, 94, 99, 100, the
/// mean of the last ms before the touch taken off).

#include <array>
#include <cmath>
#include <string>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "tests/engine/physics/impact/two_bodies.hpp"
#include "tests/relative.hpp"

using namespace septet;
using namespace septet::impact;

namespace {

constexpr double foot_m = 0.3048, pound_kg = 0.45359237, slug_ft2_kgm2 = 1.3558179483, mph_mps = 0.44704;

struct StagedVehicle {
  double weight_lb, inertia_slug_ft2;
  double arm_ft, arm_deg;  ///< To the contact, from its own x axis.
  double heading_deg, speed_mph;
  double delta_v_mph;  ///< Published.
};

struct StagedCrash {
  const char* name;
  StagedVehicle first, second;
  double normal_deg;
};

// The paper's angles run clockwise.
constexpr std::array<StagedCrash, 4> crashes{{
    {"4363: Honda Accord and Chevrolet Blazer",
     {3451.1, 2152, 2.6, 23.8, 180, 35.1, 39.5},
     {4695.4, 2805, 5.7, 10.6, 32, 35.0, 29.1},
     55.0},
    {"4364: Honda Accord and Chevrolet Trailblazer",
     {3451.1, 2152, 2.3, 45.7, 180, 35.0, 40.1},
     {5192.5, 3563, 7.1, 11.2, 30, 34.9, 26.6},
     51.9},
    {"4438: Honda Accord and Mitsubishi Montero",
     {3305.7, 2066, 2.8, 35.3, 180, 34.7, 39.7},
     {4725.3, 2889, 5.0, 13.2, 30, 35.0, 27.8},
     50.7},
    {"4474: Honda Accord and Mitsubishi Montero Sport",
     {3305.7, 2066, 2.9, 34.7, 180, 35.0, 40.5},
     {4657.0, 2863, 5.5, 15.2, 31.6, 35.0, 28.7},
     51.8},
}};

Body body_of(const StagedVehicle& vehicle) {
  return body_at(vehicle.weight_lb * pound_kg, vehicle.inertia_slug_ft2 * slug_ft2_kgm2,
                 polar(vehicle.arm_ft * foot_m, -(vehicle.heading_deg + vehicle.arm_deg)),
                 polar(vehicle.speed_mph * mph_mps, -vehicle.heading_deg));
}

}  // namespace

TEST_CASE("published crashes of two cars change their speeds by what the law says, within 15 %") {
  for (const StagedCrash& crash : crashes) {
    Body first = body_of(crash.first), second = body_of(crash.second);
    const Body first_before = first, second_before = second;
    const Place place{Vec2(0.0), polar(1.0, 180.0 - crash.normal_deg)};
    const Vec2 relative_mps = velocity_at(first, -first.mass_centre_m) - velocity_at(second, -second.mass_centre_m);
    const Rule rule{restitution(glm::dot(relative_mps, place.normal)), vehicle_friction()};
    const auto impulse = impulse_at(first, second, place, rule);
    REQUIRE(impulse);
    const CrushCurve curve =
        crush_curve({first.mass_kg, passenger_car_crush()}, {second.mass_kg, passenger_car_crush()});
    Pulse pulse = pulse_of(*impulse, place.normal, curve, rule.restitution);
    while (!is_over(pulse)) advance_pulse(0.001, pulse, first, second);
    const double first_mph = glm::distance(first.velocity_mps, first_before.velocity_mps) / mph_mps;
    const double second_mph = glm::distance(second.velocity_mps, second_before.velocity_mps) / mph_mps;
    MESSAGE(std::string(crash.name) << ": " << first_mph << " mph (published " << crash.first.delta_v_mph << "), "
                                    << second_mph << " mph (published " << crash.second.delta_v_mph << ")");
    CHECK(first_mph == relative(crash.first.delta_v_mph, 0.15));
    CHECK(second_mph == relative(crash.second.delta_v_mph, 0.15));
  }
}

TEST_CASE("a car of 1719 kg at 57.09 km/h gets from a wall what NHTSA measured, within 15 %") {
  constexpr double speed_mps = 57.09 / 3.6, measured_delta_v_mps = 18.56, measured_crush_m = 0.740,
                   measured_stop_s = 0.0736;
  Side car = car_at({-4, 0}, 0, {speed_mps, 0}, 1719.0);
  car.outline = box_outline({-4, 0}, {1, 0}, {4.896 / 2, 1.837 / 2}, vehicle_corner_m());
  const Encounter met = encounter(car, wall_from({0, -10}, {0, 10}), 0.001);
  REQUIRE(met.impact);
  const double delta_v_mps = speed_mps - met.first.body.velocity_mps.x;
  const Pulse& pulse = met.impact->pulse;
  MESSAGE("change of speed " << delta_v_mps << " m/s (measured 18.56), crush " << met.most_overlap_m
                             << " m (0.740), stopped after " << pulse.compression_s << " s (0.0736)");
  CHECK(delta_v_mps == relative(measured_delta_v_mps, 0.15));
  CHECK(met.most_overlap_m == relative(measured_crush_m, 0.15));
  CHECK(pulse.compression_s == relative(measured_stop_s, 0.15));
}
