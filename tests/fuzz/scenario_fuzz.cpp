// The OpenSCENARIO reader on any bytes; an accepted scenario is checked against a road and driven for a while.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "engine/road/opendrive_reader.hpp"
#include "engine/scenario/read/scenario_reader.hpp"
#include "engine/scenario/run/storyboard_runtime.hpp"
#include "tests/engine/road/road_text.hpp"

namespace {

using namespace septet;

/// 2 km straight with two lanes each way: the road of the corpus' scenarios.
const road::RoadNetwork& straight_road() {
  static const auto network = road::read_opendrive(
      road::SmallRoad{
          .length_m = 2000.0, .sections = road::lane_section(road::left_lanes(2), road::right_lanes(2)), .id = "R"}
          .xml(),
      "road");
  if (!network) std::abort();
  return *network;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace septet::scenario;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  parse_parameter(text.substr(0, 200));
  // A catalog that a scenario names is the same text again.
  const ScenarioFiles files{
      .read = [&](const std::string&) { return Expected<std::string>(std::string(text)); },
      .list = [](const std::string&) { return Expected<std::vector<std::string>>({"fuzz.xosc"}); }};
  check_scenario(text, "fuzz.xosc", files);
  const auto scenario = read_scenario(text, "fuzz.xosc", files);
  if (!scenario) return 0;
  StepResult start;
  auto state = start_scenario(*scenario, straight_road(), no_entity, start);
  if (!state) return 0;
  for (int step = 0; step < 60; ++step) advance_scenario(*scenario, straight_road(), 0.05, *state);
  std::vector<Participant> participants;
  append_participants(*scenario, *state, 1, participants);
  // A number gone bad is reset and reported, and never handed on.
  for (const Participant& participant : participants)
    if (!std::isfinite(participant.world_from_vehicle.position_m.x) ||
        !std::isfinite(participant.world_from_vehicle.position_m.y))
      std::abort();
  return 0;
}
