/// Towns of others: networks that SUMO's netgenerate draws, and a map in OpenStreetMap's words written here, become roads by
/// SUMO's netconvert as docs/your-town.md says. Without SUMO on this machine the tests say so and pass.

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

#include "command-line/command/town_scenario.hpp"
#include "engine/road/opendrive_reader.hpp"
#include "engine/scenario/read/scenario_reader.hpp"
#include "program/child_process.hpp"
#include "tests/checkout.hpp"
#include "tests/engine/traffic/lit_town.hpp"
#include "tests/engine/traffic/ten_routes.hpp"
#include "tests/engine/traffic/town_run.hpp"
#include "tests/shipped_files.hpp"
#include "tests/temporary_folder.hpp"
#include "tests/why_not.hpp"

namespace septet::server {
namespace {
namespace fs = std::filesystem;

bool has_sumo() {
  if (program::find_program("netconvert") && program::find_program("netgenerate")) return true;
  MESSAGE("skipped: SUMO is not installed");
  return false;
}

void run(const std::string& name, std::vector<std::string> arguments, const fs::path& folder) {
  CAPTURE(name);
  const fs::path log = folder / "log";
  auto process = program::ChildProcess::start({.program = program::find_program(name)->string(),
                                               .arguments = std::move(arguments),
                                               .environment = {},
                                               .log = log,
                                               .folder = folder});
  REQUIRE(process.has_value());
  while (!process->poll()) process->read_line(std::chrono::milliseconds(100));
  const std::string told = text_of(log);
  CAPTURE(told);
  REQUIRE(process->poll()->code == 0);
}

std::string listed(const std::vector<road::Finding>& findings) {
  std::string all;
  for (const road::Finding& finding : findings) all += describe(finding.error) + "\n";
  return all;
}

bool is_error(const road::Finding& finding) { return finding.severity == road::Severity::error; }

/// Checks a road and its scenario, and drives a swarm of 60 in it for five minutes.
void check_drivable(const fs::path& road_file) {
  const std::string text = text_of(road_file);
  const auto of_road = road::check_opendrive(text, road_file.filename().string());
  // Dead ends and the tightest corners bring warnings.
  CHECK_MESSAGE(std::ranges::none_of(of_road, is_error), listed(of_road));
  const auto file = scenario_beside(road_file);
  REQUIRE_MESSAGE(file.has_value(), why_not(file));
  const auto files = scenario::files_in(road_file.parent_path().string());
  const auto of_scenario = scenario::check_scenario(text_of(*file), file->filename().string(), files);
  CHECK_MESSAGE(of_scenario.empty(), listed(of_scenario));
  auto network = road::read_opendrive(text, road_file.filename().string());
  REQUIRE_MESSAGE(network.has_value(), why_not(network));
  auto scenario = scenario::read_scenario(text_of(*file), file->filename().string(), files);
  REQUIRE_MESSAGE(scenario.has_value(), why_not(scenario));
  const traffic::LitTown town = traffic::lit_town(std::move(*network), std::move(*scenario));
  const traffic::TownRun driven = traffic::run_town(town.network, town.graph, traffic::motorway_traffic(60, 3000.0),
                                                    300.0, 11, 1.0 / 30.0, {}, {}, town.lights_at);
  MESSAGE(road_file.stem().string() << ": " << town.network.roads.size() << " roads, " << driven.mean_mps()
                                    << " m/s, longest stand " << driven.longest_stand_s << " s, fewest there "
                                    << driven.least_there << ", past red " << driven.reds << " of " << driven.lit_lines
                                    << ", hard brakings " << driven.hard_brakings);
  CHECK(driven.overlaps.empty());
  CHECK(driven.longest_stand_s < 180.0);
  CHECK(driven.reds == 0);
  CHECK(driven.mean_mps() > 2.0);
}

void check_generated(const std::string& name, std::vector<std::string> options) {
  if (!has_sumo()) return;
  CAPTURE(name);
  const TemporaryFolder folder;
  options.insert(options.end(), {"--no-turnarounds", "--default.junctions.radius", "8", "-o", name + ".net.xml"});
  run("netgenerate", options, folder.path());
  run("netconvert", {"-s", name + ".net.xml", "--no-turnarounds", "--opendrive-output", name + ".xodr"}, folder.path());
  check_drivable(folder.path() / (name + ".xodr"));
}

}  // namespace

TEST_CASE(
    "a swarm drives grids, spiders and random networks of netgenerate for five minutes, and none overlaps another") {
  check_generated("grid", {"--grid", "--grid.number", "4", "--grid.length", "120"});
  check_generated("grid-of-lights", {"--grid", "--grid.number", "4", "--grid.length", "150", "-j", "traffic_light"});
  check_generated("grid-of-two-lanes", {"--grid", "--grid.number", "4", "--grid.length", "150", "-L", "2"});
  check_generated("spider", {"--spider", "--spider.arm-number", "6", "--spider.circle-number", "3",
                             "--spider.space-radius", "100"});
  for (const char* seed : {"1", "2"})
    check_generated(std::string("random-") + seed, {"--rand", "--rand.iterations", "60", "--seed", seed});
}

TEST_CASE("ten routes of 5 km hold together in a grid of netgenerate with two lanes each way") {
  if (!has_sumo()) return;
  const TemporaryFolder folder;
  run("netgenerate", {"--grid", "--grid.number", "6", "--grid.length", "180", "-L", "2", "-o", "grid.net.xml"},
      folder.path());
  run("netconvert", {"-s", "grid.net.xml", "--opendrive-output", "grid.xodr"}, folder.path());
  const auto network = road::read_opendrive(text_of(folder.path() / "grid.xodr"), "grid.xodr");
  REQUIRE_MESSAGE(network.has_value(), why_not(network));
  traffic::drives_ten_routes(*network);
}

TEST_CASE("a swarm drives a map of OpenStreetMap for five minutes, and none overlaps another") {
  if (!has_sumo()) return;
  const TemporaryFolder folder;
  // Streets with and without lanes and limits, one-way, a roundabout, lights, a path and a house.
  std::ofstream(folder.path() / "map.osm") << R"(<?xml version="1.0" encoding="UTF-8"?>
<osm version="0.6">
  <node id="1" lat="52.5200" lon="13.4000"/>
  <node id="2" lat="52.5200" lon="13.4020"><tag k="highway" v="traffic_signals"/></node>
  <node id="3" lat="52.5200" lon="13.4045"/>
  <node id="4" lat="52.5200" lon="13.4070"/>
  <node id="5" lat="52.5215" lon="13.4020"/>
  <node id="6" lat="52.5216" lon="13.4045"/>
  <node id="7" lat="52.5215" lon="13.4071"/>
  <node id="8" lat="52.5228" lon="13.4021"/>
  <node id="9" lat="52.5229" lon="13.4046"/>
  <node id="10" lat="52.5185" lon="13.4020"/>
  <node id="11" lat="52.5185" lon="13.4046"/>
  <node id="12" lat="52.5186" lon="13.4072"/>
  <node id="13" lat="52.52075" lon="13.4033"/>
  <node id="20" lat="52.5230" lon="13.4069"/>
  <node id="21" lat="52.52315" lon="13.40715"/>
  <node id="22" lat="52.5230" lon="13.4074"/>
  <node id="23" lat="52.52285" lon="13.40715"/>
  <node id="24" lat="52.5230" lon="13.4095"/>
  <way id="100"><nd ref="1"/><nd ref="2"/><nd ref="3"/><nd ref="4"/><tag k="highway" v="secondary"/><tag k="lanes" v="2"/><tag k="maxspeed" v="50"/><tag k="name" v="Hauptstraße"/></way>
  <way id="101"><nd ref="10"/><nd ref="2"/><nd ref="5"/><nd ref="8"/><tag k="highway" v="tertiary"/><tag k="lanes" v="4"/></way>
  <way id="102"><nd ref="11"/><nd ref="3"/><nd ref="6"/><nd ref="9"/><tag k="highway" v="residential"/><tag k="maxspeed" v="30"/></way>
  <way id="103"><nd ref="12"/><nd ref="4"/><nd ref="7"/><nd ref="23"/><tag k="highway" v="residential"/><tag k="maxspeed" v="30"/></way>
  <way id="104"><nd ref="5"/><nd ref="6"/><nd ref="7"/><tag k="highway" v="residential"/><tag k="maxspeed" v="30"/></way>
  <way id="105"><nd ref="8"/><nd ref="9"/><tag k="highway" v="residential"/><tag k="oneway" v="yes"/></way>
  <way id="106"><nd ref="10"/><nd ref="11"/><nd ref="12"/><tag k="highway" v="unclassified"/></way>
  <way id="107"><nd ref="2"/><nd ref="13"/><nd ref="6"/><tag k="highway" v="footway"/></way>
  <way id="108"><nd ref="9"/><nd ref="20"/><tag k="highway" v="tertiary"/></way>
  <way id="109"><nd ref="20"/><nd ref="23"/><nd ref="22"/><nd ref="21"/><nd ref="20"/><tag k="highway" v="tertiary"/><tag k="junction" v="roundabout"/></way>
  <way id="110"><nd ref="22"/><nd ref="24"/><tag k="highway" v="tertiary"/></way>
  <way id="111"><nd ref="5"/><nd ref="13"/><nd ref="6"/><nd ref="5"/><tag k="building" v="yes"/></way>
</osm>
)";
  fs::copy_file(fs::path(source_folder()) / "scenarios/your-town/streets.typ.xml", folder.path() / "streets.typ.xml");
  run("netconvert",
      {"--osm-files", "map.osm", "--type-files", "streets.typ.xml", "--geometry.remove", "--roundabouts.guess",
       "--junctions.join", "--default.junctions.radius", "8", "--tls.discard-simple", "--no-turnarounds.except-deadend",
       "--opendrive-output", "map.xodr"},
      folder.path());
  check_drivable(folder.path() / "map.xodr");
}

TEST_CASE("a scenario beside a road is written once, and kept as somebody has changed it") {
  const TemporaryFolder folder;
  const fs::path road = folder.path() / "town.xodr";
  fs::copy_file(fs::path(source_folder()) / "scenarios/town/town.xodr", road);
  const auto first = scenario_beside(road);
  REQUIRE_MESSAGE(first.has_value(), why_not(first));
  CHECK(*first == folder.path() / "town.xosc");
  const auto scenario =
      scenario::read_scenario(text_of(*first), "town.xosc", scenario::files_in(folder.path().string()));
  REQUIRE_MESSAGE(scenario.has_value(), why_not(scenario));
  CHECK(scenario->road_file == "town.xodr");
  CHECK_FALSE(scenario->signals.empty());
  std::ofstream(*first) << "changed";
  const auto second = scenario_beside(road);
  REQUIRE(second.has_value());
  CHECK(text_of(*second) == "changed");
}

}  // namespace septet::server
