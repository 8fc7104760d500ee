#include <algorithm>
#include <numeric>
#include <string>
#include <vector>

#include "engine/world/limited_sight.hpp"
#include "logging/study/measures/glances.hpp"
#include "logging/study/measures/lane_changes.hpp"
#include "logging/study/measures/lateral_position.hpp"
#include "tests/engine/driver/closed_loop.hpp"
#include "tests/relative.hpp"

namespace septet::driver {
namespace {

/// SD of lateral position over five minutes at 100 km/h on the empty motorway.
double lane_keeping_sd_m(const char* name, std::uint64_t seed) {
  DriverParameters driver = *find_driver(name);
  driver.speed.limit_factor = 100.0 / 120.0;
  driver.lanes.threshold_mps2 = 100.0;  // Stays in the lane.
  ClosedLoop loop(driver, seed, -3, 100.0, 27.8);
  loop.run(10.0);
  loop.samples.clear();
  loop.run(200.0);
  CHECK(logging::find_lane_changes(loop.samples).empty());
  return logging::compute_lateral_position_statistics(loop.samples, {}).sd_m;
}

/// A driver who knows this car's gears.
DriverParameters who_knows(const vehicle::VehicleParameters& car, const char* name) {
  DriverParameters driver = *find_driver(name);
  driver.car.has_clutch = true;
  driver.car.gears = car.powertrain.gear_count;
  for (int gear = 0; gear < driver.car.gears; ++gear)
    driver.car.engine_radps_per_mps[gear] =
        car.powertrain.gear_ratio[gear] * car.powertrain.final_ratio / car.tyre.radius_m;
  return driver;
}

double mean_lane_keeping_sd_m(const char* name) {
  double sum = 0.0;
  for (std::uint64_t seed = 1; seed <= 3; ++seed) sum += lane_keeping_sd_m(name, seed);
  return sum / 3.0;
}

}  // namespace

TEST_CASE("the plain driver keeps the lane at 100 km per hour with an SD of 15 to 35 cm") {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const double sd_m = lane_keeping_sd_m("plain", seed);
    MESSAGE("seed ", seed, ": SD of lateral position ", sd_m, " m");
    CHECK(sd_m > 0.15);
    CHECK(sd_m < 0.35);
  }
}

TEST_CASE("an experienced driver keeps the lane closer than a novice and a tired one loosest") {
  const double experienced = mean_lane_keeping_sd_m("experienced"), novice = mean_lane_keeping_sd_m("novice"),
               tired = mean_lane_keeping_sd_m("tired");
  MESSAGE("experienced ", experienced, " m, novice ", novice, " m, tired ", tired, " m");
  CHECK(experienced < novice);
  CHECK(novice < tired);
}

TEST_CASE("without its noise the driver keeps to the middle of the lane through every bend") {
  DriverParameters driver = *find_driver("plain");
  driver.steering.position_noise_m = driver.steering.heading_noise_rad = 0.0;
  driver.mirrors.interval_s = 1e9;
  driver.mirrors.glance_s = 0.01;
  driver.lanes.threshold_mps2 = 100.0;
  ClosedLoop loop(driver, 1, -3, 100.0, 30.0);
  loop.run(150.0);
  for (const logging::Sample& sample : loop.samples) REQUIRE(std::abs(sample.lateral_position_m) < 0.35);
}

TEST_CASE("a drive that begins in a bend begins in the middle of the lane") {
  DriverParameters driver = *find_driver("plain");
  driver.steering.position_noise_m = driver.steering.heading_noise_rad = 0.0;
  driver.mirrors.interval_s = 1e9;
  driver.mirrors.glance_s = 0.01;
  driver.lanes.threshold_mps2 = 100.0;
  // Left with 1,800 m, banked; and right with 1,500 m.
  for (const double s_m : {600.0, 2100.0}) {
    ClosedLoop loop(driver, 1, -4, s_m, 30.0);
    loop.run(ClosedLoop::tick_s);
    const double taken_rad = loop.input.steering_wheel_rad;
    loop.run(12.0);
    MESSAGE("hand wheel at the start " << taken_rad << " rad, 12 s later " << loop.input.steering_wheel_rad << " rad");
    CHECK(taken_rad == relative(loop.input.steering_wheel_rad, 0.25));
    for (const logging::Sample& sample : loop.samples) REQUIRE(std::abs(sample.lateral_position_m) < 0.12);
  }
}

TEST_CASE("from a standstill the driver reaches the limit and holds it") {
  DriverParameters driver = *find_driver("plain");
  driver.lanes.threshold_mps2 = 100.0;
  ClosedLoop loop(driver, 3, -3, 100.0, 0.0);
  loop.run(60.0);
  for (const logging::Sample& sample : loop.samples) {
    if (sample.simulated_time_s < 45.0) continue;
    CHECK(sample.speed_mps * 3.6 > 108.0);
    CHECK(sample.speed_mps * 3.6 < 128.0);
  }
}

TEST_CASE(
    "behind a vehicle that brakes to a stop the driver stops without touching it and drives on "
    "after it") {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    DriverParameters driver = *find_driver("plain");
    driver.lanes.threshold_mps2 = 100.0;
    ClosedLoop loop(driver, seed, -3, 100.0, 25.0);
    double leader_s_m = 160.0, leader_speed_mps = 25.0, smallest_gap_m = 1e9, last_time_s = 0.0;
    loop.others = [&](double time_s, std::vector<Participant>& participants) {
      const double wanted = time_s < 10.0 ? 25.0 : time_s < 30.0 ? 0.0 : 25.0;
      const double dt_s = time_s - last_time_s;
      last_time_s = time_s;
      leader_speed_mps += std::clamp(wanted - leader_speed_mps, -6.0 * dt_s, 1.5 * dt_s);
      leader_s_m += leader_speed_mps * dt_s;
      participants.push_back(vehicle_on_motorway(2, "saloon", -3, leader_s_m, leader_speed_mps));
    };
    const VehicleModel& saloon = vehicle_models()[*find_vehicle_model("saloon")];
    const VehicleModel& own = vehicle_models()[*find_vehicle_model("volvo-s80")];
    double speed_at_29_s = 0.0;
    for (int tick = 0; tick < 60 * 120; ++tick) {
      loop.tick();
      smallest_gap_m =
          std::min(smallest_gap_m, leader_s_m - saloon.rear_overhang_m - loop.snapshot.driver_car.road_s_m +
                                       own.wheelbase_m - own.front_m());
      if (loop.snapshot.tick == 29 * 120) speed_at_29_s = loop.snapshot.driver_car.speed_mps;
    }
    CHECK(smallest_gap_m > 0.5);
    CHECK(std::abs(speed_at_29_s) < 0.3);
    CHECK(loop.snapshot.driver_car.speed_mps > 15.0);
  }
}

TEST_CASE("a lorry in the way is overtaken after a look into the mirror and with the indicator on") {
  ClosedLoop loop("plain", 2, -4, 100.0, 30.0);
  const auto lorry_s_m = [](double time_s) { return 260.0 + 22.0 * time_s; };
  loop.others = [&](double time_s, std::vector<Participant>& participants) {
    participants.push_back(vehicle_on_motorway(2, "lorry", -4, lorry_s_m(time_s), 22.0));
  };
  double looked_s = -1.0, signalled_s = -1.0, crossed_s = -1.0, signal_ended_s = -1.0;
  for (int tick = 0; tick < 60 * 120; ++tick) {
    loop.tick();
    const double now_s = loop.snapshot.simulated_time_s;
    if (crossed_s >= 0.0) {
      if (signal_ended_s < 0.0 && loop.input.indicator == IndicatorStalk::off) signal_ended_s = now_s;
      continue;
    }
    if (loop.input.gaze_heading_rad > 0.5) looked_s = now_s;
    if (signalled_s < 0.0 && loop.input.indicator == IndicatorStalk::left) signalled_s = now_s;
    if (loop.snapshot.driver_car.lane == -3) crossed_s = now_s;
  }
  REQUIRE(crossed_s > 0.0);
  CHECK(signalled_s > 0.0);
  CHECK(crossed_s - signalled_s > 1.5);
  CHECK(looked_s > 0.0);
  CHECK(crossed_s - looked_s < 6.0);
  CHECK(loop.snapshot.driver_car.road_s_m > lorry_s_m(60.0));
  CHECK(loop.snapshot.driver_car.lane <= -4);  // Back to the outer lanes.
  CHECK(signal_ended_s > crossed_s);
  CHECK(signal_ended_s - crossed_s < 5.0);
  // The log agrees: twice at the mirror of that side, out and back in.
  const auto changes = logging::find_lane_changes(loop.samples);
  const auto glances = logging::find_glances(loop.samples);
  CHECK(changes.size() >= 2);
  for (const logging::LaneChange& change : changes) {
    const auto looks = std::ranges::count_if(glances, [&](const logging::Glance& glance) {
      return glance.area == (change.lanes_to_left > 0 ? "left mirror" : "right mirror") &&
             std::abs(change.simulated_time_s - 4.5 - glance.start_s) < 4.5;
    });
    CHECK(looks >= 2);
  }
}

TEST_CASE("no lane change is made into a vehicle alongside") {
  ClosedLoop loop("plain", 2, -4, 100.0, 25.0);
  loop.others = [&](double time_s, std::vector<Participant>& participants) {
    participants.push_back(vehicle_on_motorway(2, "lorry", -4, 170.0 + 22.0 * time_s, 22.0));
    // Company on both sides, from well behind to well ahead.
    for (int i = 0; i < 14; ++i)
      for (const int lane : {-3, -5})
        participants.push_back(vehicle_on_motorway(static_cast<ParticipantId>(10 + 2 * i + (lane == -5)), "saloon",
                                                   lane, i * 16.0 + 22.0 * time_s, 22.0));
  };
  loop.run(40.0);
  for (const logging::Sample& sample : loop.samples) CHECK(sample.lane == -4);
}

TEST_CASE("the driver follows an ambulance into its lane") {
  ClosedLoop loop("plain", 5, -5, 100.0, 28.0);
  loop.others = [&](double time_s, std::vector<Participant>& participants) {
    Participant ambulance = vehicle_on_motorway(2, "ambulance", -3, 180.0 + 29.0 * time_s, 29.0);
    ambulance.lamps.set(Lamp::beacon, true);
    participants.push_back(ambulance);
  };
  loop.run(50.0);
  CHECK(loop.snapshot.driver_car.lane == -3);
  CHECK(loop.snapshot.driver_car.road_s_m < 180.0 + 29.0 * 50.0 - 10.0);  // Not passed.
}

TEST_CASE("a driver of the same seed drives the same drive and another seed another") {
  const auto hash_of = [](std::uint64_t seed) {
    ClosedLoop loop("plain", seed, -3, 100.0, 27.0);
    loop.run(10.0);
    return loop.hash();
  };
  const auto first = hash_of(7);
  CHECK(hash_of(7) == first);
  CHECK(hash_of(8) != first);
}

TEST_CASE("the mirrors are looked into from habit about as often as the parameters say") {
  DriverParameters driver = *find_driver("plain");
  driver.lanes.threshold_mps2 = 100.0;
  ClosedLoop loop(driver, 4, -3, 100.0, 28.0);
  loop.run(180.0);
  const auto glances = logging::find_glances(loop.samples);
  const double interval_s = 180.0 / static_cast<double>(glances.size());
  CHECK(interval_s > 0.6 * driver.mirrors.interval_s);
  CHECK(interval_s < 1.8 * driver.mirrors.interval_s);
}

TEST_CASE("the driver takes a manual car from standstill to 100 km/h through its gears without stalling") {
  const vehicle::VehicleParameters car = read_car("volvo-s80-manual");
  for (const std::string who : {"plain", "novice", "tired"}) {
    CAPTURE(who);
    DriverParameters driver = who_knows(car, who.c_str());
    driver.speed.limit_factor *= 110.0 / 120.0;
    ClosedLoop loop(driver, 1, -3, 100.0, 0.0, car);
    std::string gears;
    double slipping_s = 0.0, reached_s = 0.0;
    while (gears != "12345" && loop.snapshot.simulated_time_s < 90.0) {
      loop.tick();
      REQUIRE(loop.engine_running());
      const int gear = loop.snapshot.driver_car.gear;
      if (gear > 0 && (gears.empty() || gears.back() != '0' + gear)) gears += static_cast<char>('0' + gear);
      if (loop.input.clutch > 0.25 && loop.input.clutch < 0.75) slipping_s += ClosedLoop::tick_s;
      if (reached_s == 0.0 && loop.snapshot.driver_car.speed_mps >= 100.0 / 3.6)
        reached_s = loop.snapshot.simulated_time_s;
    }
    MESSAGE(who << ": 100 km/h after " << reached_s << " s, in fifth gear after " << loop.snapshot.simulated_time_s
                << " s");
    CHECK(gears == "12345");
    CHECK(reached_s > 8.0);
    CHECK(slipping_s > 0.5);
  }
}

TEST_CASE("behind a car that stops the driver clutches in and drives off again") {
  const vehicle::VehicleParameters car = read_car("volvo-s80-manual");
  DriverParameters driver = who_knows(car, "plain");
  driver.lanes.threshold_mps2 = 100.0;
  ClosedLoop loop(driver, 3, -3, 100.0, 20.0, car);
  // It stands 250 m ahead for 30 s, then drives away.
  loop.others = [](double time_s, std::vector<Participant>& vehicles) {
    const double away_s = std::max(0.0, time_s - 30.0);
    vehicles.push_back(vehicle_on_motorway(2, "volvo-s80", -3, 350.0 + 15.0 * away_s, away_s > 0.0 ? 15.0 : 0.0));
  };
  bool stood = false;
  for (int tick = 0; tick < 50 * 120; ++tick) {
    loop.tick();
    REQUIRE(loop.engine_running());
    stood = stood || std::abs(loop.snapshot.driver_car.speed_mps) < 0.1;
  }
  CHECK(stood);
  CHECK(loop.snapshot.driver_car.speed_mps > 8.0);
}

TEST_CASE("a simulated driver goes so fast that he stops within what he sees and stands where he sees nothing") {
  ClosedLoop loop("plain", 1, -3, 100.0, 27.8);
  const auto settled_mps = [&](double seen_m) {
    for (int tick = 0; tick < 30 * 120; ++tick) {
      loop.snapshot.effects = {
          {limited_sight_effect_id, limited_sight_keyframe_kind,
           encode_limited_sights(std::vector<LimitedSight>{{simulation::driver_participant, seen_m}}),
           loop.snapshot.tick}};
      loop.tick();
    }
    return loop.snapshot.driver_car.speed_mps;
  };
  // 43 km/h at 50 m, as StVO § 3 allows at most 50 there.
  CHECK(settled_mps(50.0) == relative(12.1, 0.05));
  CHECK(settled_mps(20.0) == relative(6.9, 0.07));
  CHECK(settled_mps(2.0) < 0.5);  // He creeps.
  CHECK(settled_mps(0.0) < 0.05);
  CHECK(settled_mps(50.0) > 11.0);  // It lifts, and he goes on.
}

}  // namespace septet::driver
