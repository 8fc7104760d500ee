#include "command-line/command/town_scenario.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "engine/core/regular_file.hpp"
#include "engine/core/whole_file.hpp"
#include "engine/document/markup.hpp"
#include "engine/road/opendrive_reader.hpp"
#include "engine/traffic/network/lane_graph.hpp"
#include "engine/traffic/yield_line.hpp"
#include "program/console.hpp"

namespace septet::server {
namespace {
namespace fs = std::filesystem;

constexpr int usual_vehicles = 60;
constexpr double start_m = 10.0, least_start_m = 20.0;  ///< Of the car on its street, and the shortest street for it.

/// Signals of one junction by who has green together.
using Groups = std::array<std::vector<std::string>, 2>;

/// The longest way outside of junctions of which a drive goes on, else the longest.
const traffic::Way* first_street(const traffic::LaneGraph& graph) {
  const traffic::Way* best = nullptr;
  for (const traffic::Way& way : graph.ways) {
    if (way.in_junction() || way.length_m < least_start_m) continue;
    if (best == nullptr || std::pair(way.goes_on, way.length_m) > std::pair(best->goes_on, best->length_m)) best = &way;
  }
  return best;
}

/// The junction that a way leads into; no_index: it leads into none.
std::uint32_t junction_beyond(const traffic::LaneGraph& graph, const traffic::Way& way) {
  for (const traffic::WayIndex next : graph.next_of(way))
    if (graph.ways[next].in_junction()) return graph.ways[next].junction;
  return road::no_index;
}

/// Vehicles' lights by junction; those of one approach, and of the one against it, are one group.
std::map<std::uint32_t, Groups> lights_by_junction(const road::RoadNetwork& network, const traffic::LaneGraph& graph) {
  std::map<std::uint32_t, Groups> junctions;
  std::map<std::uint32_t, Vec3> first_comes;
  std::map<std::pair<road::RoadIndex, bool>, bool> done;
  for (const traffic::Way& way : graph.ways) {
    const std::uint32_t junction = junction_beyond(graph, way);
    if (!way.has_light || way.in_junction() || junction == road::no_index) continue;
    if (std::exchange(done[{way.road, way.along_s}], true)) continue;
    const Vec3& comes = graph.points[way.points.first + way.points.count - 1].tangent;
    const Vec3& first = first_comes.emplace(junction, comes).first->second;
    const std::size_t group = std::abs(comes.x * first.x + comes.y * first.y) < std::sqrt(0.5) ? 1 : 0;
    for (const road::Signal& signal : network.roads[way.road].signals)
      if (signal.is_vehicle_light() && traffic::applies_along_s(network.roads[way.road], signal) == way.along_s)
        junctions[junction][group].push_back(signal.id);
  }
  return junctions;
}

std::string phases_of(const std::string& name, const Groups& groups) {
  struct Step {
    double seconds;
    std::string_view goes, waits;  ///< What the group whose turn it is shows, and the other one.
  };
  static constexpr std::array<Step, 4> steps{
      {{20.0, "green", "red"}, {3.0, "amber", "red"}, {2.0, "red", "red"}, {1.0, "red", "red-amber"}}};
  std::string text = fmt::format("      <TrafficSignalController name=\"{}\">\n", document::escaped(name));
  for (std::size_t turn = 0; turn < 2; ++turn)
    for (const Step& step : steps) {
      text += fmt::format("        <Phase name=\"{} of {}\" duration=\"{}\">\n", step.goes, turn + 1, step.seconds);
      for (std::size_t group = 0; group < 2; ++group)
        for (const std::string& signal : groups[group])
          text += fmt::format("          <TrafficSignalState trafficSignalId=\"{}\" state=\"{}\"/>\n",
                              document::escaped(signal), group == turn ? step.goes : step.waits);
      text += "        </Phase>\n";
    }
  return text + "      </TrafficSignalController>\n";
}

constexpr std::string_view head = R"(<?xml version="1.0" encoding="UTF-8"?>
<!-- Written by septet drive for the road beside it. Change it as you like: it is not written again. -->
<OpenSCENARIO>
  <FileHeader revMajor="1" revMinor="3" date="2026-01-01T12:00:00" author="Septet" description="A town of your own"/>
  <ParameterDeclarations>
    <ParameterDeclaration name="vehicles" parameterType="unsignedInt" value="{vehicles}"/>
  </ParameterDeclarations>
  <CatalogLocations/>
  <RoadNetwork>
    <LogicFile filepath="{road}"/>
)";

constexpr std::string_view body = R"(  </RoadNetwork>
  <Entities>
    <ScenarioObject name="ego">
      <Vehicle name="volvo-s80" vehicleCategory="car" role="civil" mass="1677">
        <BoundingBox>
          <Center x="1.311" y="0" z="0.7175"/>
          <Dimensions width="1.831" length="4.822" height="1.435"/>
        </BoundingBox>
        <Performance maxSpeed="62.6" maxAcceleration="4" maxDeceleration="9"/>
        <Axles>
          <FrontAxle maxSteering="0.61" wheelDiameter="0.642" trackWidth="1.57" positionX="2.791" positionZ="0.321"/>
          <RearAxle maxSteering="0" wheelDiameter="0.642" trackWidth="1.57" positionX="0" positionZ="0.321"/>
        </Axles>
      </Vehicle>
    </ScenarioObject>
  </Entities>
  <Storyboard>
    <Init>
      <Actions>
        <GlobalAction>
          <TrafficAction trafficName="town traffic">
            <TrafficSwarmAction innerRadius="30" semiMajorAxis="400" semiMinorAxis="400" offset="0" numberOfVehicles="$vehicles">
              <CentralObject entityRef="ego"/>
              <TrafficDefinition name="town by day">
                <VehicleCategoryDistribution>
                  <VehicleCategoryDistributionEntry category="car" weight="0.86"/>
                  <VehicleCategoryDistributionEntry category="van" weight="0.1"/>
                  <VehicleCategoryDistributionEntry category="truck" weight="0.04"/>
                </VehicleCategoryDistribution>
                <ControllerDistribution>
                  <ControllerDistributionEntry weight="1">
                    <Controller name="septet-traffic" controllerType="movement">
                      <Properties/>
                    </Controller>
                  </ControllerDistributionEntry>
                </ControllerDistribution>
              </TrafficDefinition>
              <DirectionOfTravelDistribution same="0.5" opposite="0.5"/>
            </TrafficSwarmAction>
          </TrafficAction>
        </GlobalAction>
        <Private entityRef="ego">
          <PrivateAction>
            <TeleportAction>
              <Position>
                <LanePosition roadId="{road}" laneId="{lane}" s="{s:.2f}" offset="0"/>
              </Position>
            </TeleportAction>
          </PrivateAction>
        </Private>
      </Actions>
    </Init>
    <StopTrigger>
      <ConditionGroup>
        <Condition name="an hour" delay="0" conditionEdge="none">
          <ByValueCondition>
            <SimulationTimeCondition value="3600" rule="greaterOrEqual"/>
          </ByValueCondition>
        </Condition>
      </ConditionGroup>
    </StopTrigger>
  </Storyboard>
</OpenSCENARIO>
)";

}  // namespace

Expected<std::string> town_scenario(const road::RoadNetwork& network, const std::string& road_file) {
  const traffic::LaneGraph graph = traffic::build_lane_graph(network);
  const traffic::Way* street = first_street(graph);
  if (street == nullptr)
    return failure(fmt::format("no lane outside of a junction is {} m long, so that nobody can begin to drive there",
                               least_start_m),
                   road_file, "write a scenario for it, or take a larger piece of the map");
  std::string lights;
  for (const auto& [junction, groups] : lights_by_junction(network, graph))
    lights +=
        phases_of(junction < network.junctions.size() ? "junction " + network.junctions[junction].id : "merge", groups);
  if (!lights.empty()) lights = "    <TrafficSignals>\n" + lights + "    </TrafficSignals>\n";
  const road::LaneSection& section = network.roads[street->road].sections[street->section];
  const double s_m = street->along_s ? section.s_m + start_m : section.s_end_m - start_m;
  return fmt::format(head, fmt::arg("vehicles", usual_vehicles), fmt::arg("road", document::escaped(road_file))) +
         lights +
         fmt::format(body, fmt::arg("road", document::escaped(network.roads[street->road].id)),
                     fmt::arg("lane", street->lane), fmt::arg("s", s_m));
}

Expected<fs::path> scenario_beside(const fs::path& road) {
  fs::path scenario = road;
  scenario.replace_extension(".xosc");
  std::error_code ignored;
  if (fs::exists(scenario, ignored)) return scenario;
  const auto text =
      read_regular_file(road)
          .and_then([&](const std::string& xml) { return road::read_opendrive(xml, road.string()); })
          .and_then([&](const road::RoadNetwork& network) { return town_scenario(network, road.filename().string()); });
  if (!text) return tl::unexpected(text.error());
  if (const auto written = write_whole_file(scenario, "scenario", std::as_bytes(std::span(*text))); !written)
    return tl::unexpected(written.error());
  program::say(fmt::format("{} is written: a drive on {}, among {} vehicles", scenario.string(),
                           road.filename().string(), usual_vehicles));
  return scenario;
}

}  // namespace septet::server
