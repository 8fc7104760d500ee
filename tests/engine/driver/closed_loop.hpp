#pragma once
/// The driver, the S80 and the motorway in a loop: the product's own step and log samples, without files, screens or a
/// swarm.

#include <functional>
#include <string>

#include <doctest/doctest.h>
#include <fmt/core.h>

#include "car-io/car_connection.hpp"
#include "car-io/simulated_driver_car.hpp"
#include "engine/driver/simulated_driver.hpp"
#include "engine/road/lane_geometry.hpp"
#include "engine/road/lane_links.hpp"
#include "engine/scenario/read/scenario_reader.hpp"
#include "engine/simulation/server_step.hpp"
#include "logging/session/records.hpp"
#include "tests/engine/physics/vehicle/car.hpp"
#include "tests/engine/road/road_files.hpp"
#include "tests/why_not.hpp"

namespace septet::driver {

using road::motorway;
using vehicle::read_car;

inline const vehicle::VehicleParameters& volvo() {
  static const vehicle::VehicleParameters car = read_car("volvo-s80");
  return car;
}

/// A scenario of one car at rest on the motorway.
inline const scenario::Scenario& one_car() {
  static const scenario::Scenario scenario = [] {
    const auto read = scenario::read_scenario(
        R"(<OpenSCENARIO><FileHeader revMajor="1" revMinor="3" date="2026-01-01T00:00:00" description="" author=""/><CatalogLocations/>)"
        R"(<RoadNetwork><LogicFile filepath="motorway.xodr"/></RoadNetwork><Entities><ScenarioObject name="ego">)"
        R"(<Vehicle name="volvo-s80" vehicleCategory="car"><BoundingBox><Center x="1.311" y="0" z="0.7175"/>)"
        R"(<Dimensions width="1.831" length="4.822" height="1.435"/></BoundingBox>)"
        R"(<Performance maxSpeed="62.6" maxAcceleration="4" maxDeceleration="9"/><Axles>)"
        R"(<FrontAxle maxSteering="0.61" wheelDiameter="0.642" trackWidth="1.57" positionX="2.791" positionZ="0.321"/>)"
        R"(<RearAxle maxSteering="0" wheelDiameter="0.642" trackWidth="1.57" positionX="0" positionZ="0.321"/>)"
        R"(</Axles></Vehicle></ScenarioObject></Entities><Storyboard><Init><Actions><Private entityRef="ego"><PrivateAction>)"
        R"(<TeleportAction><Position><LanePosition roadId="1" laneId="-3" s="100"/></Position></TeleportAction>)"
        R"(</PrivateAction></Private></Actions></Init></Storyboard></OpenSCENARIO>)",
        "one car", scenario::files_in("."));
    REQUIRE_MESSAGE(read.has_value(), why_not(read));
    return *read;
  }();
  return scenario;
}

/// Other traffic: the vehicles that a test places.
class StagedTraffic final : public traffic::TrafficEngine {
 public:
  using Stage = std::function<void(double time_s, std::vector<Participant>& vehicles)>;
  explicit StagedTraffic(const Stage& stage) : stage_(stage) {}

  void start(const traffic::TrafficParameters&, std::span<const traffic::ForeignVehicle>) override {}
  void stop() override {}
  void advance(std::span<const traffic::ForeignVehicle>, double dt_s) override {
    vehicles_.clear();
    if (stage_) stage_(static_cast<double>(++ticks_) * dt_s, vehicles_);
  }
  void append_participants(std::vector<Participant>& participants) const override {
    participants.insert(participants.end(), vehicles_.begin(), vehicles_.end());
  }
  void add_to_hash(StateHash&) const override {}

 private:
  const Stage& stage_;
  Tick ticks_ = 0;
  std::vector<Participant> vehicles_;
};

class ClosedLoop {
 public:
  static constexpr double tick_s = 1.0 / simulation::tick_rate_hz;

  ClosedLoop(const std::string& driver_name, std::uint64_t seed, int lane, double s_m, double speed_mps)
      : ClosedLoop(*find_driver(driver_name), seed, lane, s_m, speed_mps) {}

  ClosedLoop(const DriverParameters& driver, std::uint64_t seed, int lane, double s_m, double speed_mps,
             const vehicle::VehicleParameters& car = volvo())
      : person_(driver, seed, motorway()), connection_(person_.opener(), {}) {
    model_.roads = motorway();
    model_.scenario = one_car();
    model_.driver_entity = 0;
    model_.car = car;
    auto started = simulation::initial_state(model_, std::make_unique<StagedTraffic>(others));
    REQUIRE_MESSAGE(started.has_value(), why_not(started));
    state_ = std::move(*started);
    const auto place = road::evaluate_lane(motorway(), {0, lane, s_m, 0.0});
    state_.car = vehicle::standstill(car, road::world_from_lane(place), speed_mps);
    snapshot = simulation::capture_snapshot(model_, state_);
  }
  ClosedLoop(const ClosedLoop&) = delete;  // The traffic refers to `others`.

  /// Other vehicles of the next snapshots.
  StagedTraffic::Stage others;

  void tick() {
    person_.drive(snapshot, tick_s);
    input = connection_.poll(state_.time_s()).input;
    std::vector<simulation::Event> events;
    snapshot = simulation::server_step(model_, input, state_, events, std::move(snapshot));
    if (logging::is_sample_due(snapshot.tick, simulation::tick_rate_hz))
      samples.push_back(logging::take_sample(snapshot, std::nullopt));
  }
  void run(double time_s) {
    for (int i = 0; i < static_cast<int>(time_s / tick_s + 0.5); ++i) tick();
  }

  Snapshot snapshot;
  DriverInput input;
  std::vector<logging::Sample> samples;

  std::uint64_t hash() const { return snapshot.state_hash; }
  bool engine_running() const { return state_.car.powertrain.engine_running; }

 private:
  simulation::Model model_;
  simulation::State state_;
  car_io::SimulatedDriverCar person_;
  car_io::CarConnection connection_;
};

/// A vehicle that keeps a lane of the motorway's first road at a constant speed.
inline Participant vehicle_on_motorway(ParticipantId id, const char* model, int lane, double s_m, double speed_mps) {
  Participant vehicle;
  vehicle.id = id;
  vehicle.model = *find_vehicle_model(model);
  const auto start = road::advance(motorway(), {0, lane, 0.0, 0.0}, s_m).position;
  vehicle.world_from_vehicle = road::world_from_lane(road::evaluate_lane(motorway(), start));
  vehicle.velocity_mps = vehicle.world_from_vehicle.orientation * Vec3(speed_mps, 0, 0);
  return vehicle;
}

}  // namespace septet::driver
