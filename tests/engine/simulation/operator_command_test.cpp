#include <algorithm>
#include <limits>

#include <doctest/doctest.h>

#include "engine/simulation/car_faults.hpp"
#include "engine/simulation/operator_command.hpp"

namespace septet::simulation {

TEST_CASE("an operator's command comes back from its text to the last bit") {
  SetConditions set;
  for (const Condition& condition : conditions())
    set.values.emplace_back(&condition, condition.least + (condition.most - condition.least) * (1.0 / 3.0));
  for (const OperatorCommand& command :
       {OperatorCommand(set), OperatorCommand(SetTraffic{3000}),
        OperatorCommand(TriggerElement{"a story::its act = x"}),
        OperatorCommand(PlacePart{"traffic-cone", 1.0 / 3.0, -1e6 / 7.0}), OperatorCommand(RemovePiece{4294967295u}),
        OperatorCommand(ShowEntity{"a b = c", false}), OperatorCommand(ShowEntity{"place", true}),
        OperatorCommand(SetFault{0, true}), OperatorCommand(SetFault{fault_names().size() - 1, false}),
        OperatorCommand(PutCar{1.0 / 3.0, -1e6 / 7.0, -0.1, 13.7}),
        OperatorCommand(Call{"lift", "a b = c", {{"words", "please wait"}}, "lab"}), OperatorCommand(OverlookWish{}),
        OperatorCommand(OverlookWish{1007, "a b = c"}), OperatorCommand(SetHazard{"a b = c", 1.0 / 3.0, -1e6 / 7.0}),
        OperatorCommand(PeopleErrorRates{{1.0 / 3.0, 0.0, 2.0, 1000.0}})}) {
    const auto read = parse_operator_command(text_of(command));
    REQUIRE(read.has_value());
    CHECK(*read == command);
  }
}

TEST_CASE("what is no command, or asks for what is out of range, is refused") {
  for (const char* text : {"",
                           "conditions",
                           "conditions ",
                           "conditions rain_mm_per_h",
                           "conditions rain_mm_per_h=",
                           "conditions rain_mm_per_h=1x",
                           "conditions rain_mm_per_h=-1",
                           "conditions rain_mm_per_h=1e9",
                           "conditions rain_mm_per_h=nan",
                           "conditions rain_mm_per_h=inf",
                           "conditions rain_mm_per_h=1 rain_mm_per_h=2",
                           "conditions  road_wetness=1",
                           "conditions sun=1",
                           "traffic vehicles=-1",
                           "traffic vehicles=3001",
                           "traffic vehicles=",
                           "traffic vehicles=99999999999999",
                           "traffic",
                           "trigger element=",
                           "trigger",
                           "TRAFFIC vehicles=1",
                           "place x_m=1 y_m=2 part=house",
                           "place x_m=1 y_m=2 part=",
                           "place x_m=nan y_m=2 part=traffic-cone",
                           "place x_m=1 y_m=1e300 part=traffic-cone",
                           "place x_m=1 part=traffic-cone y_m=2",
                           "place y_m=1 x_m=2 part=traffic-cone",
                           "hazard x_m=1 y_m=2",
                           "hazard x_m=1 y_m=2 name=",
                           "hazard x_m=nan y_m=2 name=a",
                           "hazard y_m=1 x_m=2 name=a",
                           "remove thing=",
                           "remove thing=-1",
                           "remove thing=4294967296",
                           "remove thing=1 ",
                           "hide entity=",
                           "show",
                           "fault what=",
                           "fault what=engine",
                           "fault what=0",
                           "repair what=tyre",
                           "repair",
                           "put x_m=1 y_m=2",
                           "put x_m=1 y_m=2 heading_rad=0 speed_mps=-1",
                           "put x_m=1 y_m=2 heading_rad=0 speed_mps=71",
                           "put x_m=1 y_m=2 heading_rad=nan speed_mps=0",
                           "put x_m=1 y_m=2 heading_rad=0 speed_mps=0 x",
                           "put x_m=inf y_m=2 heading_rad=0 speed_mps=0",
                           "put y_m=1 x_m=2 heading_rad=0 speed_mps=0",
                           "call",
                           "call ",
                           "call lift",
                           "call node=x",
                           "overlook ",
                           "overlook me",
                           "overlook whom=",
                           "errors",
                           "errors ",
                           "errors red=1001",
                           "conditions friction_scale=0"})
    CHECK_MESSAGE(!parse_operator_command(text).has_value(), text);
}

TEST_CASE("every condition's bounds hold what the environment is by default") {
  const scenario::ScenarioState state;
  for (const Condition& condition : conditions()) {
    CHECK_MESSAGE(value_of(condition, state) >= condition.least, condition.name);
    CHECK_MESSAGE(value_of(condition, state) <= condition.most, condition.name);
  }
}

}  // namespace septet::simulation
