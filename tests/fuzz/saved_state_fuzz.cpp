// Saved states, altered and signed again: traffic, a storyboard, debris and smoke on a short straight road. An accepted
// one is saved once more, and gives the same bytes back.
//
// The input is a list of patches, each of three bytes where, one how long, and so many bytes; one of no length cuts the
// state off there.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <span>
#include <string>

#include "engine/core/hash.hpp"
#include "engine/core/version.hpp"
#include "engine/road/opendrive_reader.hpp"
#include "engine/scenario/read/scenario_reader.hpp"
#include "engine/scenario/run/storyboard_runtime.hpp"
#include "engine/simulation/saved_state.hpp"
#include "tests/engine/road/road_text.hpp"

namespace septet {
std::string version_text() { return "fuzz"; }  // A state is of one build.
}  // namespace septet

namespace {

using namespace septet;

void require(bool holds) {
  if (!holds) std::abort();
}

/// 2 km straight, one lane to the left and two to the right.
std::string road_text() {
  return road::SmallRoad{
      .length_m = 2000.0, .sections = road::lane_section(road::left_lanes(1), road::right_lanes(2)), .id = "R"}
      .xml();
}

constexpr std::string_view scenario_text =
    R"(<OpenSCENARIO><FileHeader revMajor="1" revMinor="3" date="2026-01-01T00:00:00" description="" author=""/>
<CatalogLocations/><RoadNetwork><LogicFile filepath="test.xodr"/></RoadNetwork><Entities>
<ScenarioObject name="Ego"><Vehicle name="saloon" vehicleCategory="car"><BoundingBox><Center x="1.4" y="0" z="0.7"/><Dimensions width="1.8" length="4.6" height="1.4"/></BoundingBox>
<Performance maxSpeed="60" maxAcceleration="10" maxDeceleration="10"/><Axles><FrontAxle maxSteering="0.5" wheelDiameter="0.6" trackWidth="1.5" positionX="2.8" positionZ="0.3"/>
<RearAxle maxSteering="0" wheelDiameter="0.6" trackWidth="1.5" positionX="0" positionZ="0.3"/></Axles></Vehicle></ScenarioObject>
<ScenarioObject name="B"><MiscObject name="crate" mass="20" miscObjectCategory="obstacle"><BoundingBox><Center x="0" y="0" z="0.5"/><Dimensions width="1" length="1" height="1"/></BoundingBox></MiscObject></ScenarioObject>
</Entities><Storyboard><Init><Actions>
<Private entityRef="Ego"><PrivateAction><TeleportAction><Position><LanePosition roadId="R" laneId="-2" s="100"/></Position></TeleportAction></PrivateAction>
<PrivateAction><LongitudinalAction><SpeedAction><SpeedActionDynamics dynamicsShape="step" dynamicsDimension="time" value="0"/><SpeedActionTarget><AbsoluteTargetSpeed value="20"/></SpeedActionTarget></SpeedAction></LongitudinalAction></PrivateAction></Private>
<Private entityRef="B"><PrivateAction><TeleportAction><Position><RelativeLanePosition entityRef="Ego" dLane="1" ds="30"/></Position></TeleportAction></PrivateAction></Private>
</Actions></Init><StopTrigger/></Storyboard></OpenSCENARIO>)";

std::unique_ptr<traffic::TrafficEngine> engine_of(const simulation::Model& model) {
  return traffic::own_traffic(model.roads, model.seed);
}

struct Place {
  simulation::Model model;
  Bytes good;

  Place() {
    auto roads = road::read_opendrive(road_text(), "road");
    require(roads.has_value());
    model.roads = std::move(*roads);
    auto scenario = scenario::read_scenario(scenario_text, "scenario.xosc", {});
    require(scenario.has_value());
    model.scenario = std::move(*scenario);
    scenario::StepResult init;
    auto storyboard = scenario::start_scenario(model.scenario, model.roads, scenario::no_entity, init);
    require(storyboard.has_value());

    simulation::State state;
    state.scenario = std::move(*storyboard);
    state.traffic = engine_of(model);
    traffic::ForeignVehicle driver{.id = 1, .velocity_mps = {20.0, 0.0, 0.0}};
    driver.world_from_vehicle = state.scenario.entities.front().world_from_entity;
    state.traffic->start(traffic::motorway_traffic(12, 300.0), std::span(&driver, 1));
    state.traffic->advance(std::span(&driver, 1), simulation::tick_s);
    Random random(1);
    debris::spawn_part(state.effects.debris, debris::Part::lamp, driver.world_from_vehicle, Vec3(0.0), Vec3(0.0),
                       random);
    state.effects.debris.shards.push_back({.mass_kg = 0.01});
    smoke::Grid grid;
    grid.nx = grid.ny = grid.nz = 4;
    grid.wall.assign(64, 0);
    smoke::State& smoke = state.effects.fires.smoke.emplace(smoke::make_smoke(grid, {smoke::Emitter{}}, 1, 100));
    for (int i = 0; i < 8; ++i) require(smoke::add_particle(smoke, Vec3(1.5, 0.5 * i, 1.5), 0));
    auto saved = simulation::save_state(model, state);
    require(saved.has_value());
    good = std::move(*saved);
    const auto again = simulation::restore_state(model, engine_of(model), good, "fuzz");
    require(again.has_value() && simulation::save_state(model, *again) == good);
  }
};

Bytes altered(Bytes bytes, std::span<const std::uint8_t> script) {
  while (script.size() >= 4) {
    const std::size_t at = (script[0] | std::size_t{script[1]} << 8 | std::size_t{script[2]} << 16) % bytes.size();
    const std::size_t length = std::min<std::size_t>({script[3], script.size() - 4, bytes.size() - at});
    if (script[3] == 0) bytes.resize(std::max<std::size_t>(at, 1));
    std::memcpy(bytes.data() + at, script.data() + 4, script[3] == 0 ? 0 : length);
    script = script.subspan(4 + length);
  }
  if (bytes.size() < sizeof(std::uint64_t)) return bytes;
  const std::size_t end = bytes.size() - sizeof(std::uint64_t);
  StateHash hash;
  hash.add_bytes(std::span(bytes).first(end));
  const std::uint64_t value = hash.value();
  std::memcpy(bytes.data() + end, &value, sizeof value);
  return bytes;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const Place place;
  const Bytes bytes = altered(place.good, {data, size});
  auto state = simulation::restore_altered_state(place.model, engine_of(place.model), bytes, "fuzz");
  if (!state) {
    require(!state.error().what.empty() && !state.error().remedy.empty());
    return 0;
  }
  const auto saved = simulation::save_state(place.model, *state);
  require(saved.has_value());
  const auto again = simulation::restore_state(place.model, engine_of(place.model), *saved, "fuzz");
  require(again.has_value());
  require(simulation::save_state(place.model, *again) == *saved);
  return 0;
}
