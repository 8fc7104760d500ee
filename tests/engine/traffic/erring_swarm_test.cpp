/// Errors of people at rates, in swarms.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

#include "engine/core/archive.hpp"
#include "engine/traffic/ring.hpp"
#include "engine/traffic/traffic_engine.hpp"
#include "tests/engine/traffic/lit_town.hpp"
#include "tests/engine/traffic/public_town.hpp"
#include "tests/engine/traffic/town_run.hpp"

namespace septet::traffic {
namespace {

constexpr double swarm_step_s = 1.0 / 30.0;

PeopleErrorRates all_at(double per_hour) {
  PeopleErrorRates rates;
  rates.per_hour.fill(per_hour);
  return rates;
}

/// Town01 with 40 vehicles, around its middle.
struct Swarm {
  road::RoadNetwork network = public_town("Town01");
  std::uint64_t seed = 5;
  std::unique_ptr<TrafficEngine> engine = own_traffic(network, seed);
  ForeignVehicle driver;
  std::vector<std::string> told;

  explicit Swarm(std::uint64_t with_seed = 5) : seed(with_seed), engine(own_traffic(network, with_seed)) {
    driver.model = *find_vehicle_model("volvo-s80");
    driver.world_from_vehicle.position_m = Vec3(0.5 * (network.low_m + network.high_m), 0.0);
  }
  void start() { engine->start(motorway_traffic(40, 2000.0), std::span(&driver, 1)); }
  void drive(double seconds) {
    for (double t = 0.0; t < seconds; t += swarm_step_s) {
      engine->advance(std::span(&driver, 1), swarm_step_s);
      for (const ToldError& error : engine->take_errors()) told.push_back(text_of(error));
    }
  }
  std::uint64_t hash() const {
    StateHash hash;
    engine->add_to_hash(hash);
    return hash.value();
  }
};

}  // namespace

TEST_CASE("rates of 0 change no hash of a town's traffic, and others do") {
  Swarm plain, at_zero, erring;
  CHECK(at_zero.engine->set_errors({}).has_value());
  CHECK(erring.engine->set_errors(all_at(100.0)).has_value());
  for (Swarm* swarm : {&plain, &at_zero, &erring}) {
    swarm->start();
    swarm->drive(30.0);
  }
  CHECK(at_zero.hash() == plain.hash());
  CHECK(erring.hash() != plain.hash());
  CHECK(plain.told.empty());
}

TEST_CASE("two towns of one seed err alike, and one of another seed otherwise") {
  const auto told = [](std::uint64_t seed) {
    Swarm swarm(seed);
    REQUIRE(swarm.engine->set_errors(all_at(200.0)).has_value());
    swarm.start();
    swarm.drive(60.0);
    return std::pair(swarm.told, swarm.hash());
  };
  const auto first = told(5);
  CHECK(first.first.size() > 10);
  CHECK(told(5) == first);
  CHECK(told(6).first != first.first);
}

TEST_CASE("a town saved in the middle of errors goes on from there as if it had not been saved") {
  Swarm swarm, again;
  REQUIRE(swarm.engine->set_errors(all_at(500.0)).has_value());
  swarm.start();
  swarm.drive(40.0);
  REQUIRE(swarm.engine->erring().size() > 1);
  CHECK(swarm.engine->overlook({}, 77).has_value());
  Bytes bytes;
  StateWriter writer(bytes);
  swarm.engine->save(writer);
  StateReader reader(bytes);
  again.engine->restore(reader);
  REQUIRE(reader.ok());
  CHECK(reader.remaining() == 0);
  CHECK(again.hash() == swarm.hash());
  swarm.told.clear();
  for (Swarm* one : {&swarm, &again}) one->drive(30.0);
  CHECK(again.hash() == swarm.hash());
  CHECK(again.told == swarm.told);
  CHECK(swarm.told.size() > 5);
}

TEST_CASE("lights are passed at red only where that error has a rate") {
  const LitTown town = shipped_town();
  const auto run = [&](double per_hour) {
    TrafficParameters parameters = motorway_traffic(60, 3000.0);
    parameters.errors.per_hour[static_cast<std::size_t>(PeopleError::red)] = per_hour;
    return run_town(town.network, town.graph, parameters, 300.0, 11, swarm_step_s, {}, {}, town.lights_at);
  };
  const TownRun usual = run(0.0);
  CHECK(usual.lit_lines > 20);
  CHECK(usual.reds == 0);
  CHECK(run(1000.0).reds > 0);
}

TEST_CASE("the traffic of a motorway says that its drivers never err") {
  const road::RoadNetwork network = ring_road(1000.0, 2);
  const auto engine = own_traffic(network, 1);
  CHECK_FALSE(engine->set_errors(all_at(1.0)).has_value());
  CHECK_FALSE(engine->overlook({}, 1).has_value());
}

}  // namespace septet::traffic
