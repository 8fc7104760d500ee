// The figures of docs/simulated-driver.md: measured and printed here, and compared with the literature's range.

#include <algorithm>
#include <numeric>

#include "logging/study/measures/glances.hpp"
#include "tests/engine/driver/closed_loop.hpp"

namespace septet::driver {
namespace {

/// The lead car of the reaction test.
constexpr double brakes_at_s = 40.0, braking_mps2 = 6.0, speed_mps = 25.0;

constexpr const char* drivers[] = {"experienced", "plain", "novice", "tired"};

DriverParameters staying_in_lane(const char* name) {
  DriverParameters driver = *find_driver(name);
  driver.lanes.threshold_mps2 = 100.0;
  return driver;
}

/// From the front bumper of one to the front bumper of the next, over the speed of the one behind.
double time_headway_s(const ClosedLoop& loop) {
  const Vec3 between = loop.snapshot.participants[1].world_from_vehicle.position_m -
                       loop.snapshot.participants[0].world_from_vehicle.position_m;
  return glm::length(between) / loop.snapshot.driver_car.speed_mps;
}

}  // namespace

TEST_CASE("the drivers follow with a time headway as the literature has it") {
  for (const char* name : drivers) {
    ClosedLoop loop(staying_in_lane(name), 2, -3, 100.0, 25.0);
    loop.others = [](double time_s, std::vector<Participant>& vehicles) {
      vehicles.push_back(vehicle_on_motorway(2, "volvo-s80", -3, 150.0 + 25.0 * time_s, 25.0));
    };
    loop.run(40.0);
    double sum_s = 0.0, least_s = 1e9;
    for (int second = 0; second < 100; ++second) {
      loop.run(1.0);
      const double headway_s = time_headway_s(loop);
      sum_s += headway_s / 100.0;
      least_s = std::min(least_s, headway_s);
    }
    MESSAGE(std::string(name) << ": time headway behind a car at 90 km/h " << sum_s << " s, least " << least_s << " s");
    CHECK(sum_s > 1.0);
    CHECK(sum_s < 3.0);
    CHECK(least_s > 0.8);
  }
}

TEST_CASE("the drivers brake behind a braking car as late as the literature has it") {
  for (const char* name : drivers) {
    double sum_s = 0.0;
    constexpr int seeds = 5;
    for (int seed = 1; seed <= seeds; ++seed) {
      ClosedLoop loop(staying_in_lane(name), static_cast<std::uint64_t>(seed), -3, 100.0, 25.0);
      loop.others = [](double time_s, std::vector<Participant>& vehicles) {
        const double braked_s = std::clamp(time_s - brakes_at_s, 0.0, speed_mps / braking_mps2);
        const double way_m =
            speed_mps * std::min(time_s, brakes_at_s) + speed_mps * braked_s - 0.5 * braking_mps2 * braked_s * braked_s;
        vehicles.push_back(vehicle_on_motorway(2, "volvo-s80", -3, 150.0 + way_m, speed_mps - braking_mps2 * braked_s));
      };
      loop.run(brakes_at_s);
      const double before = loop.snapshot.simulated_time_s;
      while (loop.input.brake < 0.02 && loop.snapshot.simulated_time_s < before + 5.0) loop.tick();
      sum_s += (loop.snapshot.simulated_time_s - before) / seeds;
    }
    MESSAGE(std::string(name) << ": from the lead car's braking with 6 m/s2 to the own brake pedal " << sum_s << " s");
    CHECK(sum_s > 0.6);
    CHECK(sum_s < 2.5);
  }
}

TEST_CASE("the drivers look into the mirrors as briefly as the literature has it") {
  for (const char* name : drivers) {
    ClosedLoop loop(staying_in_lane(name), 4, -3, 100.0, 28.0);
    loop.run(240.0);
    const auto glances = logging::find_glances(loop.samples);
    REQUIRE(glances.size() > 3);
    double sum_s = 0.0, longest_s = 0.0;
    for (const auto& glance : glances) {
      sum_s += glance.duration_s;
      longest_s = std::max(longest_s, glance.duration_s);
    }
    MESSAGE(std::string(name) << ": a glance every " << 240.0 / static_cast<double>(glances.size()) << " s, mean "
                              << sum_s / static_cast<double>(glances.size()) << " s, longest " << longest_s << " s");
    CHECK(longest_s < 2.5);
  }
}

}  // namespace septet::driver
